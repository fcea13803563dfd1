#!/usr/bin/env bash
# Builds tests/threads with a thread sanitizer and runs it: no race may be reported, but for one that is planted.
#   TYNDALL_SOURCE_DIR   the checkout [this one]
#   CXX                  as CMake takes it
# The build stays in the current folder, so that the next run is short.
set -uo pipefail
source_dir=${TYNDALL_SOURCE_DIR:-$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)}
options=(-DCMAKE_BUILD_TYPE=RelWithDebInfo "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1 -g1" -DTYNDALL_SANITIZE=thread)
command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
[ -e build/CMakeCache.txt ] || ! command -v ninja >/dev/null || options+=(-G Ninja)

cmake -S "$source_dir" -B build "${options[@]}" >configure.log 2>&1 || { cat configure.log; exit 1; }
cmake --build build --target threads -j "${TYNDALL_JOBS:-$(nproc)}" >build.log 2>&1 || { tail -n 40 build.log; exit 1; }

program=build/tests/threads
# The libraries beneath are not instrumented: what goes on within them is not looked at.
export TSAN_OPTIONS="halt_on_error=0 exitcode=66 ignore_noninstrumented_modules=1 ${TSAN_OPTIONS-}"
failures=0
if ! "$program" >clean.log 2>&1; then
  echo "FAILED: races, or a failed test:"
  head -c 6000 clean.log
  failures=1
fi
"$program" --no-skip --test-case='a planted race' >planted.log 2>&1
if [ $? != 66 ] || ! grep -q 'WARNING: ThreadSanitizer: data race' planted.log; then
  echo "FAILED: the planted race was not reported:"
  head -c 2000 planted.log
  failures=1
fi
[ $failures = 0 ] && echo "no race but the planted one"
exit $failures
