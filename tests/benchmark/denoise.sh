#!/usr/bin/env bash
# What denoising gains: relMSE as rendered over relMSE denoised, plain and without the worst 0.1 % of pixels, at SPP samples; and
# whether the errors that it states are right: true over stated relMSE, the same trimmed, values within two standard errors.
# Usage: denoise.sh TYNDALL SPP SCENE.pbrt... [-- OPTIONS OF COMPARE, such as --resolution 320x180]
set -eu
tyndall=$1 spp=$2
shift 2
scenes=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do scenes+=("$1"); shift; done
[ $# -eq 0 ] || shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
printf '%-28s %10s %10s %8s %8s %8s %8s %8s %8s\n' scene rendered denoised gain trimmed true/st. trimmed within2 seconds
for scene in "${scenes[@]}"; do
  "$tyndall" compare "$scene" --variants "tree:--lights tree" --spp "$spp" --denoise --quiet --json -o "$work/report" "$@" >"$work/results.json"
  # results.json has one value a line, the rendered variant before the denoised one.
  awk -v scene="$(basename "$scene" .pbrt)" '
    function value() { gsub(/[",]/, ""); return $2 }
    BEGIN { n = 0 }
    /"variants":/ { in_variants = 1 }
    in_variants && /^      "seconds":/ { seconds[n] = value() }
    in_variants && /^      "relmse":/ { relmse[n] = value() }
    in_variants && /^      "relmse_trimmed":/ { trimmed[n++] = value() }
    in_variants && /^        "true_over_stated":/ { stated = value() }
    in_variants && /^        "true_over_stated_trimmed":/ { stated_trimmed = value() }
    in_variants && /^        "within_two":/ { within = value() }
    END {
      printf "%-28s %10.2e %10.2e %8.1f %8.1f", scene, relmse[0], relmse[1], relmse[0] / relmse[1], trimmed[0] / trimmed[1]
      printf " %8.2f %8.2f %7.1f%% %8.2f\n", stated, stated_trimmed, 100 * within, seconds[1] - seconds[0]
    }
  ' "$work/results.json"
done
