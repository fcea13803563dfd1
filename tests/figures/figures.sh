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

# Figure 1: glossy metal among many lights. One sample of the paper's tree; the paper's splitting, every candidate with its
# shadow ray; ours.
compare glossy-lights figure1 "power:--lights power, binary tree:--lights tree-binary --candidates 1 --splitting 0, split and all traced:--splitting 0.5 --candidates 16 --shadow-rays 0, ours:--lights tree"

# Figure 2: smoke among many lights. A light for each tracked collision; the paper's closest point, split, every candidate
# with its shadow ray; the integral of 1/r^2 with equi-angular and tracked distances, alone and with averaged bounds; ours.
compare smoke-lights figure2 "collision:--lights tree-binary --media vertex --candidates 1 --splitting 0, closest split and all traced:--media closest --distance equiangular --splitting 0.5 --candidates 16 --shadow-rays 0, integral:--lights tree-binary --media integral --distance both --candidates 1 --splitting 0, cycles rule:--lights cycles-rule --media integral --distance both --candidates 1 --splitting 0, ours:--media product"

# Figure 3: a Cornell box under many small lights, by the number of lights. The paper's tree, walked without splitting,
# against simpler choices and against our wide tree.
for lights in 1000 100000; do
  compare ceiling "figure3_$lights" "uniform:--lights uniform, power:--lights power, binary tree:--lights tree-binary, wide tree:--lights tree" --lights $lights
done

echo "reports:"
ls "$folder"/*/index.html
