#!/usr/bin/env bash
# The whole test suite of a commit under the address and undefined-behaviour sanitizers, division by zero and casts out of
# range of floats included: no report, and every test passes.
#   suite.bash [PROGRAM...]   only these of the programs in tests/, e.g. unit_volume threads
#   TYNDALL_SOURCE_DIR        the checkout [this one]
#   TYNDALL_JOBS              compilers at once [one a core]
#   TYNDALL_SANITIZE_LEVEL    of -O [1]; 0 compiles in 0.6 of the time and runs several times as long
#   CXX                       as CMake takes it
# The build stays in the current folder, so that the next run is short; so do the reports, in reports/.
set -uo pipefail
source_dir=${TYNDALL_SOURCE_DIR:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)}
unset TYNDALL_NIGHTLY  # a commit's cases, and less: support/sanitized.h says how much and why
here=$PWD
# Lines of a stack are all that a report needs: the rest of what -g writes costs 40 % of the compiler's time.
options=(--preset asan-ubsan -B "$here/build" "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O${TYNDALL_SANITIZE_LEVEL:-1} -g1 -D_GLIBCXX_ASSERTIONS")
# The whole suite is built source by source, which shows what a precompiled header hides; a few programs of it quickly.
[ $# -gt 0 ] && options+=(-DTYNDALL_FAST_BUILD=ON)
# GCC's shared libubsan reads no log_path when libasan is there, too.
"${CXX:-c++}" --version | grep -qi clang || options+=(-DCMAKE_EXE_LINKER_FLAGS=-static-libubsan)
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# Reports go to files: the process that reads a .vdb has no stderr, and its end would pass for a damaged file.
rm -rf reports && mkdir reports
export ASAN_OPTIONS="log_path=$here/reports/asan:${ASAN_OPTIONS-}"
export UBSAN_OPTIONS="print_stacktrace=1:log_path=$here/reports/ubsan:${UBSAN_OPTIONS-}"

(cd "$source_dir" && cmake "${options[@]}") >configure.log 2>&1 || { cat configure.log; exit 1; }
cmake --build build --target "${@:-all}" -j "${TYNDALL_JOBS:-$(nproc)}" >build.log 2>&1 || { tail -n 40 build.log; exit 1; }
code=0
tests() { ctest --test-dir build --no-tests=error --output-on-failure -LE nightly -j "$(nproc)" "$@" || code=1; }
if [ $# -gt 0 ]; then
  names=$(printf '|%s' "$@")
  tests -R "^(${names:1})(\.|$)"
else
  tests -R '^(statistical|regression)\.'
  # Variables that outlive their function are looked for too: renders take twice as long then.
  export ASAN_OPTIONS="detect_stack_use_after_return=1:$ASAN_OPTIONS"
  tests -E '^(statistical|regression|mutation|architecture|package)'  # the last three build Tyndall anew, or do not run it
fi
for report in reports/*; do
  [ -e "$report" ] || break
  # What damaged files ask for, a terabyte and more or beyond the reader's limit, is std::bad_alloc without a sanitizer, and
  # here the end.
  grep -qE 'AddressSanitizer: (allocation-size-too-big|out-of-memory)' "$report" && continue
  echo "FAILED: $report:"
  head -n 15 "$report"
  code=1
done
exit $code
