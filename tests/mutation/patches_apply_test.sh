#!/usr/bin/env bash
# Each planted bug still fits the source, and the tests that are to notice it are there. Whether they do is a nightly run:
# run.bash.
set -u
here=$(cd "$(dirname "$0")" && pwd)
. "$here/mutations.bash"
source_dir=$TYNDALL_SOURCE_DIR
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# Names of all test cases; one that is too long for its line stands on the next.
test_cases() {
  find "$source_dir/tests" -name '*.cpp' -exec cat {} + | tr -s '\n ' ' ' | grep -oE 'TEST_CASE[A-Z_]*\( ?"[^"]*"' | sed -E 's/^[A-Z_]*\( ?"//; s/"$//'
}

is_test_case() {
  local name
  while read -r name; do
    # shellcheck disable=SC2053
    [[ $name == $1 ]] && return
  done <<<"$names"
  return 1
}

# exists TEST: something that it would run.
exists() {
  local filter
  filter=$(filter_of "$1")
  case $(program_of "$1"):$filter in
    regress:*) compgen -G "$source_dir/tests/regression/suite/*$filter*.pbrt" >/dev/null ;;
    *:-sf=*) find "$source_dir/tests" -path "${filter#-sf=}" | grep -q . ;;
    *:-tc=*) is_test_case "${filter#-tc=}" ;;
    *) false ;;
  esac
}

names=$(test_cases)
count=0
while read -r file; do
  count=$((count + 1))
  for name in Bug Seen Test; do
    [ -n "$(field "$name" "$file")" ] || fail "$file has no line $name:"
  done
  why=$(patch_tree "$source_dir" "$file" --dry-run 2>&1) || fail "$file does not apply: $(head -n 3 <<<"$why")"
  while read -r test; do
    exists "$test" || fail "$file: no test is $test"
  done < <(field Test "$file")
done < <(mutation_files "$here/patches")

[ "$count" -ge 30 ] || fail "$count bugs; 30 were promised"
echo "$count bugs"
[ "$failures" = 0 ]
