#!/usr/bin/env bash
# Do the tests bite? Plants each bug of patches/ in a copy of the source, builds the tests that the patch names, and says
# whether one of them notices.
#   run.bash [PATTERN...]   the patches whose names match a pattern; all without one
# The copy and its build are kept in the current folder, so that the next run is short: copy/, build/, results.tsv.
# Exit code 0: at most one bug went unnoticed, all patches apply and build, and every test passes without them.
#   TYNDALL_SOURCE_DIR      the checkout [this one]
#   TYNDALL_MUTATION_JOBS   compilers at once [one a core]
#   CXX, CXXFLAGS           as CMake takes them
set -uo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$here/mutations.bash"

source_dir=${TYNDALL_SOURCE_DIR:-$(cd "$here/../.." && pwd)}
patches=$source_dir/tests/mutation/patches
jobs=${TYNDALL_MUTATION_JOBS:-$(nproc)}
work=$PWD
copy=$work/copy
build=$work/build
planted=  # the patch that is in the copy now
declare -A sound seconds_of  # by Test line: whether it passes without a bug, and in how long

say() { printf '%s\n' "$*" >&2; }

# Brings the copy up to date. Only files that differ are written, so that their times tell the build what to do: also after
# a run that was killed with a bug in the copy.
refresh_copy() {
  mkdir -p "$copy"
  local name
  for name in "$source_dir"/*; do  # what the tests only read
    [ -d "$name" ] && case ${name##*/} in cmake | include | src | tests | build) continue ;; esac
    [ -f "$name" ] && [ "${name##*/}" = CMakeLists.txt ] && continue
    ln -sfn "$name" "$copy/${name##*/}"
  done
  remove_gone
  (cd "$source_dir" && find CMakeLists.txt cmake include src tests -type f 2>/dev/null) | while read -r name; do
    cmp -s "$source_dir/$name" "$copy/$name" && continue
    mkdir -p "$copy/$(dirname "$name")"
    cp "$source_dir/$name" "$copy/$name"
  done
}

remove_gone() {
  (cd "$copy" && find . -type f) | while read -r name; do
    [ -e "$source_dir/$name" ] || rm -f "$copy/$name"
  done
}

configure() {
  local launcher=() generator=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  command -v ninja >/dev/null && [ ! -e "$build/CMakeCache.txt" ] && generator=(-G Ninja)
  cmake -S "$copy" -B "$build" "${generator[@]}" -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" >"$work/configure.log" 2>&1
}

build_target() { cmake --build "$build" --target "$1" -j "$jobs" </dev/null >"$work/build.log" 2>&1; }

# run_test TEST SECONDS: 0 if it passes, 2 if no test case has that name. Its output is in test.log. Bugs may hang, or ask
# for all memory there is.
run_test() {
  local filter
  filter=$(filter_of "$1")
  mkdir -p "$work/scratch" && cd "$work/scratch" || return 1
  (
    ulimit -c 0 -v 12000000
    export TYNDALL_SOURCE_DIR=$copy
    case $(program_of "$1") in
      regress) timeout "$2" "$build/tyndall" regress "$copy/tests/regression/suite" --filter "$filter" ;;
      *) timeout "$2" "$(find "$build" -type f -name "$(program_of "$1")" -perm -u+x | head -n 1)" "${filter//,/?}" ;;
    esac
  ) </dev/null >"$work/test.log" 2>&1
  local code=$?
  cd "$work" || return 1
  [ "$code" = 0 ] && grep -qE 'test cases: +0 ' "$work/test.log" && return 2
  return "$code"
}

# A test that fails without a bug, or runs nothing, proves nothing.
check_unbroken() {
  local test=$1 begin=$SECONDS
  [ -n "${sound[$test]:-}" ] && return
  sound[$test]=no
  if ! build_target "$(target_of "$test")"; then
    say "cannot build $(target_of "$test") without a bug:" "$(tail -n 5 "$work/build.log")"
  elif begin=$SECONDS && ! run_test "$test" 1200; then
    say "fails, or runs nothing, without a bug: $test" "$(tail -n 5 "$work/test.log")"
  else
    sound[$test]=yes
    seconds_of[$test]=$((SECONDS - begin))
  fi
}

plant() { planted=$1 && patch_tree "$copy" "$1" >"$work/patch.log" 2>&1; }

take_back() {
  [ -n "$planted" ] && patch_tree "$copy" "$planted" -R >>"$work/patch.log" 2>&1
  planted=
}

# judge PATCH: sets `result` and `noticed_by`.
judge() {
  local test
  result="NOT CAUGHT" noticed_by=
  if ! patch_tree "$copy" "$1" --dry-run >"$work/patch.log" 2>&1; then
    result="does not apply"
    return
  fi
  plant "$1"
  while read -r test; do
    if [ "${sound[$test]:-no}" = no ]; then
      result="no sound test"
    elif ! build_target "$(target_of "$test")"; then
      result="does not build"
    elif run_test "$test" $((60 + 10 * seconds_of[$test])); then
      continue
    else
      result=caught noticed_by=$test
    fi
    break
  done < <(field Test "$1")
  take_back
}

selected() {  # NAME PATTERN...
  local name=$1 pattern
  shift
  [ $# = 0 ] && return
  for pattern in "$@"; do
    # shellcheck disable=SC2053
    [[ $name == $pattern ]] && return
  done
  return 1
}

# One line for each patch as it comes, then the totals.
main() {
  local all=() file name test begin
  while read -r file; do
    name=$(basename "$file" .patch)
    selected "$name" "$@" && all+=("$file")
  done < <(mutation_files "$patches")
  [ ${#all[@]} -gt 0 ] || { say "$patches: no such patch"; exit 2; }

  refresh_copy
  configure || { say "cannot configure:" "$(tail -n 5 "$work/configure.log")"; exit 1; }
  while read -r test; do check_unbroken "$test"; done < <(for file in "${all[@]}"; do field Test "$file"; done)

  declare -A total
  printf '%-40s %-15s %4s  %s\n' patch result s "noticed by"
  : >"$work/results.tsv"
  for file in "${all[@]}"; do
    begin=$SECONDS
    judge "$file"
    total[$result]=$((${total[$result]:-0} + 1))
    printf '%-40s %-15s %4d  %s\n' "$(basename "$file" .patch)" "$result" $((SECONDS - begin)) "$noticed_by"
    printf '%s\t%s\t%s\t%s\n' "$(basename "$file" .patch)" "$result" $((SECONDS - begin)) "$noticed_by" >>"$work/results.tsv"
  done
  local caught=${total[caught]:-0} missed=${total[NOT CAUGHT]:-0}
  local broken=$((${#all[@]} - caught - missed))
  echo "${#all[@]} bugs: $caught caught, $missed NOT CAUGHT, $broken without a verdict"
  [ "$missed" -le 1 ] && [ "$broken" = 0 ]
}

trap take_back EXIT
trap 'exit 130' INT TERM
main "$@"
