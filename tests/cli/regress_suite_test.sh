# Tyndall's own suite agrees with its references. A sanitizer makes a render ten times as long and no more exact: there a
# handful of cases has to do.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
filter=''
grep -qE '__(asan|tsan)_init' "$TYNDALL_BIN" && filter='[bc]*'
"$TYNDALL_BIN" regress "$TYNDALL_SOURCE_DIR/tests/regression/suite" --filter "$filter" -o report --junit junit.xml || fail "exit code $?"
finish
