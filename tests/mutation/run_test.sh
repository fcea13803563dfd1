#!/usr/bin/env bash
# run.bash itself, on a project of one function: each of its verdicts, and what they make of the exit code.
set -u
here=$(cd "$(dirname "$0")" && pwd)
toy=$PWD/toy
patches=$toy/tests/mutation/patches
failures=0
rm -rf "$toy" run && mkdir -p "$toy/src" "$patches" run

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

cat >"$toy/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(Toy LANGUAGES CXX)
add_executable(toy src/toy.cpp)
CMAKE
cat >"$toy/src/toy.cpp" <<'TOY'
#include <cstdio>
#include <string>
int twice(int x) { return 2 * x; }
int unused(int x) { return x; }
int main(int argc, char** argv) {
  const std::string test = argc > 1 ? argv[1] : "";
  if (test == "-tc=nothing") std::puts("[doctest] test cases:  0 |  0 passed");
  if (test == "-tc=fails") return 1;
  while (twice(1) < 0) {
  }
  return test.find(',') != std::string::npos || twice(2) != 4;
}
TOY

# bug NAME OLD NEW TEST: a patch of one line.
bug() {
  local line
  line=$(grep -nF -- "$2" "$toy/src/toy.cpp" | cut -d: -f1)
  printf 'Bug: planted\nSeen: here\nTest: %s\n--- a/src/toy.cpp\n+++ b/src/toy.cpp\n@@ -%d +%d @@\n-%s\n+%s\n' \
    "$4" "${line:-1}" "${line:-1}" "$2" "$3" >"$patches/$1.patch"
}

# verdict EXIT_CODE TEXT [PATTERN...]: a run of the patches that match.
verdict() {
  local code=$1 text=$2
  shift 2
  (cd run && TYNDALL_SOURCE_DIR=$toy TYNDALL_MUTATION_JOBS=1 bash "$here/run.bash" "$@") >out.txt 2>err.txt
  local got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code, of $*: $(tail -n 3 err.txt out.txt)"
  [ -z "$text" ] || grep -qE -- "$text" out.txt || fail "not said of $*: $text: $(cat err.txt out.txt)"
}

function='int twice(int x) { return 2 * x; }'
bug caught "$function" 'int twice(int x) { return 3 * x; }' 'toy -tc=twice'
bug hangs "$function" 'int twice(int x) { return -x; }' 'toy -tc=twice'
bug missed1 'int unused(int x) { return x; }' 'int unused(int x) { return -x; }' 'toy -tc=twice'
bug missed2 'int unused(int x) { return x; }' 'int unused(int x) { return 1 + x; }' 'toy -tc=twice'
bug breaks "$function" 'int twice(int x) { return 2 * y; }' 'toy -tc=twice'
bug strays 'int thrice(int x) { return 3 * x; }' 'int thrice(int x) { return x; }' 'toy -tc=twice'
bug fails "$function" 'int twice(int x) { return 4 * x; }' 'toy -tc=fails'
bug empty "$function" 'int twice(int x) { return 4 * x; }' 'toy -tc=nothing'
bug comma "$function" 'int twice(int x) { return 5 * x; }' 'toy -tc=a, comma'

verdict 0 '^caught +caught +[0-9]+ +toy -tc=twice$' caught
verdict 0 '^1 bugs: 0 caught, 1 NOT CAUGHT, 0 without' missed1
verdict 1 '^2 bugs: 0 caught, 2 NOT CAUGHT, 0 without' missed1 missed2
verdict 0 '^2 bugs: 1 caught, 1 NOT CAUGHT, 0 without' caught missed1
verdict 1 '^breaks +does not build' breaks
verdict 1 '^strays +does not apply' strays
verdict 1 '^fails +no sound test' fails
verdict 1 '^empty +no sound test' empty
verdict 0 '^comma +caught' comma
verdict 2 '' nothing-like-it
verdict 0 '^caught +caught' caught  # nothing is left of the others
cmp -s "$toy/src/toy.cpp" run/copy/src/toy.cpp || fail "a bug was left in the copy"
[ "${TYNDALL_NIGHTLY:-}" ] && verdict 0 '^hangs +caught' hangs  # a minute

# A run that was killed leaves its bug in the copy, and what was built of it.
sed -i 's/return 2 \* x/return 7 * x/' run/copy/src/toy.cpp
cmake --build run/build >build.log 2>&1
echo 'int left_behind;' >run/copy/src/gone.cpp
verdict 0 '^caught +caught' caught
[ ! -e run/copy/src/gone.cpp ] || fail "a file that the source no longer has is still in the copy"

[ "$failures" = 0 ] && echo ok
