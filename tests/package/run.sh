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

# README shows this very program, and docs/library.md begins with it.
sed 1d "$here/main.cpp" >program.txt
for document in README.md docs/library.md; do
  awk '/^```cpp/ { on = 1; next } on && /^```/ { exit } on' "$here/../../$document" >shown.txt
  diff program.txt shown.txt || { echo "$document's program differs from tests/package/main.cpp"; exit 1; }
done

