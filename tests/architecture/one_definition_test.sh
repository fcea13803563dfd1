#!/bin/sh
# Every type of a header has a name of its own: two of one name in one namespace are undefined behaviour that compiles and
# links without a word (a Vec3d of arrays beside a Vec3d of x, y, z shared their inline functions).
# Usage: one_definition_test.sh [CHECKOUT]
set -eu
cd "${1:-$(dirname "$0")/../..}"

twice() {
  find include src -name '*.h' -exec grep -HnE '^(struct|class|enum class|enum|union) [A-Za-z0-9_]+( final)?( : [^;]*)? \{' {} + | awk -F: '
  {
    split($3, word, " ")
    name = word[1] == "enum" && word[2] == "class" ? word[3] : word[2]
    # One for builds that a thread sanitizer watches, one for all others.
    if (name == "ThreadPool") next
    if (name in file && file[name] != $1) print file[name] " and " $1 " both define " name "; rename one"
    file[name] = $1
  }'
}

found=$(twice)
[ -z "$found" ] || { echo "$found"; exit 1; }
[ $# -eq 0 ] || exit 0

# It must notice one that is planted.
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/include" "$tree/src/a" "$tree/src/b"
echo 'struct Once {' >"$tree/src/a/once.h"
echo 'class Twice : Once {' >"$tree/src/a/twice.h"
sh "$0" "$tree" >/dev/null || { echo "complains of nothing"; exit 1; }
echo 'struct Twice {' >"$tree/src/b/twice.h"
! sh "$0" "$tree" >/dev/null || { echo "a type defined twice was not noticed"; exit 1; }
