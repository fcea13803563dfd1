# A CPU without what the build uses: one clear line, not a bare SIGILL. The C library is told to see no AVX2 in this one.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
build=$(dirname "$TYNDALL_BIN")
if ! grep -q '^TYNDALL_ARCH:.*=x86-64-v3$' "$build/CMakeCache.txt"; then
  echo "skipped: the build is not for x86-64-v3"
  exit 0
fi
expect 0 "$TYNDALL_BIN" --version
GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2 expect 1 "$TYNDALL_BIN" --version
says 'this CPU has no AVX2' err.txt
[ "$(wc -l <err.txt)" = 1 ] || fail "not one line: $(cat err.txt)"
[ ! -s out.txt ] || fail "it went on: $(cat out.txt)"

# On such a CPU the check itself must run, and run first.
object=$build/src/CMakeFiles/tyndall_cli.dir/cli/cpu_check.cpp.o
objdump -d "$object" >code.txt || fail "no $object"
grep -q '<.*require_cpu' code.txt || fail "the check is not in $object"
modern=$(grep -E $'\t(v[a-z]|andn|bzhi|blsr|pext|pdep|rorx|sarx|shlx|shrx|mulx|lzcnt|tzcnt|movbe)' code.txt)
[ -z "$modern" ] || fail "the check itself is built for modern CPUs: $modern"
objdump -h "$object" | grep -q '\.init_array\.00101' || fail "the check is no constructor of the first priority"
finish
