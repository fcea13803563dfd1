#!/usr/bin/env bash
# What slices cost: processor time of N slices, reading and building and writing included, over that of one, and that of merging.
# Usage: farm_scaling.sh TYNDALL SCENE "OPTIONS" N...        prints a row of a table for each N
set -eu
program=$1 scene=$2 options=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT='%U %S %R'

# processor COMMAND...: seconds of user and system.
processor() { { time "$@" >/dev/null 2>&1; } 2>&1 | tail -n 1 | awk '{ print $1 + $2 }'; }

echo "| slices | processor time, s | efficiency | merge, s |"
echo "|---|---|---|---|"
one=
for n in "$@"; do
  rm -f "$folder"/*
  sum=0
  for ((i = 1; i <= n; ++i)); do
    # shellcheck disable=SC2086
    sum=$(echo "$sum $(processor "$program" render "$scene" $options --threads 1 --quiet --slice "$i/$n" -o "$folder/slice-$i.exr")" |
      awk '{ print $1 + $2 }')
  done
  merge=$(processor "$program" merge "$folder" -o "$folder/../whole-$$.exr")
  rm -f "$folder/../whole-$$.exr"
  one=${one:-$sum}
  awk -v n="$n" -v sum="$sum" -v one="$one" -v merge="$merge" \
    'BEGIN { printf "| %d | %.1f | %.3f | %.2f |\n", n, sum, one / sum, merge }'
done
