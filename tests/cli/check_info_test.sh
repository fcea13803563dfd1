# `tyndall check` and `tyndall info`.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
cd "$TYNDALL_SOURCE_DIR" || exit 1
scratch=$OLDPWD
expect() {
  local code=$1
  shift
  "$@" >"$scratch/out.txt" 2>"$scratch/err.txt"
  local got=$?
  [ "$got" = "$code" ] || fail "exit code $got, not $code: $* ($(head -c 300 "$scratch/err.txt"))"
}

# Each bad scene: file:line:column, exit code 3, nothing else.
for scene in tests/scenes/bad/*.pbrt; do
  expect 3 "$T" check "$scene"
  grep -qE "^tests/scenes/bad/[a-z_]+\.[a-z]+(:[0-9]+:[0-9]+)?: .+" "$scratch/out.txt" || fail "$scene: $(cat "$scratch/out.txt")"
  grep -qE ":[0-9]+:[0-9]+: " "$scratch/out.txt" || fail "$scene: no line and column: $(cat "$scratch/out.txt")"
done
expect 3 "$T" check tests/scenes/bad/*.pbrt
expect 3 "$T" check tests/scenes/bad/several.pbrt
[ "$(wc -l <"$scratch/out.txt")" -ge 3 ] || fail "several.pbrt: not every problem is listed"

# The examples are sound, and info shows what they hold.
for scene in volumes/*/*.pbrt; do
  [ "$scene" = volumes/plume_hall/bulbs.pbrt ] && continue  # included by another
  expect 0 "$T" check "$scene"
  expect 0 "$T" info "$scene"
done
expect 0 "$T" info volumes/mantaflow_smoke/*.vdb volumes/plume_hall/plume.vdb volumes/teapot_cloud/teapot_cloud.nvdb
for text in density temperature flame velocity "voxel size" "world bounds" "active voxels" minimum maximum memory; do
  says "$text" "$scratch/out.txt"
done
expect 0 "$T" info --json volumes/mantaflow_smoke/*.vdb
expect 3 "$T" info README.md
expect 3 "$T" info no_such_file.vdb
finish
