#!/usr/bin/env bash
# Every source is as clang-format 14 (Debian 12's) writes it by .clang-format; another version writes some lines otherwise, so that the
# test is skipped there. `cmake --build build/release --target format` mends.
set -u
here=$(cd "$(dirname "$0")/../.." && pwd)
program=$(command -v clang-format-14 || command -v clang-format) || { echo "clang-format is not there; install it"; exit 1; }
"$program" --version | grep -q 'version 14\.' || { echo "skipped: $("$program" --version)"; exit 0; }

# unformatted FOLDER: the sources in it that are not.
unformatted() {
  find "$1" \( -name '*.h' -o -name '*.cpp' \) -print0 |
    xargs -0 "$program" --style=file --dry-run -Werror --ferror-limit=1 2>&1 | sed -n 's/:[0-9]*:[0-9]*: error:.*//p' | sort -u
}

# It must notice one that is planted.
planted=$(mktemp -d)
trap 'rm -rf "$planted"' EXIT
cp "$here/.clang-format" "$planted"
printf 'int  twice(int a){return a+a;}\n' >"$planted/planted.cpp"
[ "$(unformatted "$planted")" = "$planted/planted.cpp" ] || { echo "a planted source that is not formatted was not noticed"; exit 1; }

found=$(for folder in include src python tests; do unformatted "$here/$folder"; done)
[ -z "$found" ] || { echo "$found"; echo "not formatted; build the target format"; exit 1; }
