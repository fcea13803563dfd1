#!/bin/sh
# The comparisons of Conty Estevez and Kulla (2018), each as a report of `tyndall compare` in a folder of its own.
# Usage: figures.sh PROGRAM FOLDER [SECONDS]    SECONDS: render time of each variant and seed [20]
set -eu
tyndall=$1 folder=$2 seconds=${3:-20}
mkdir -p "$folder"

# compare EXAMPLE REPORT VARIANTS OPTION...: writes the example's scene, compares on it.
compare() {
  example=$1 report=$2 variants=$3
  shift 3
  "$tyndall" example "$example" "$@" -o "$folder/$report/scene"
  "$tyndall" compare "$folder/$report/scene/$example.pbrt" --variants "$variants" --time "$seconds" -o "$folder/$report"
}

# Figure 3: a Cornell box under many small lights, by the number of lights. The paper's tree, walked without splitting,
# against simpler choices and against our wide tree.
for lights in 1000 100000; do
  compare ceiling "figure3_$lights" "uniform:--lights uniform, power:--lights power, binary tree:--lights tree-binary, wide tree:--lights tree" --lights $lights
done

echo "reports:"
ls "$folder"/*/index.html
