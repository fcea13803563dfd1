#!/bin/sh
# Usage: run.sh CMAKE BUILD_DIR GENERATOR
# Installs BUILD_DIR to a scratch prefix; configures, builds and runs the project beside this script against it.
set -eu
cmake=$1 build=$2 generator=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
"$cmake" -S "$here" -B "$scratch/build" -G "$generator" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$scratch/build"

cd "$scratch"
build/uses_tyndall
[ -s ball.exr ] || { echo "the outside program wrote no picture"; exit 1; }

# README shows this very program.
sed 1d "$here/main.cpp" >program.txt
awk '/^```cpp/ { on = 1; next } /^```/ { on = 0 } on' "$here/../../README.md" >readme.txt
diff program.txt readme.txt || { echo "README's program differs from tests/package/main.cpp"; exit 1; }

