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

# A folder: a table of the scenes below it. What is only included, or speaks of WorldBegin in a comment, is none.
rm -rf "$scratch/scenes" "$scratch/empty"
mkdir -p "$scratch/scenes/rooms"
cat >"$scratch/scenes/rooms/good.pbrt" <<'SCENE'
Include "camera.pbrt"
Film "gbuffer" "string coordinatesystem" "world"
WorldBegin
Shape "sphere"
SCENE
printf '# before WorldBegin\nCamera "perspective"\n' >"$scratch/scenes/rooms/camera.pbrt"
printf 'Integrator "bdpt"\nWorldBegin\n' | gzip >"$scratch/scenes/packed.pbrt.gz"
expect 0 "$T" check "$scratch/scenes"
[ "$(grep -cE "(good.pbrt|packed.pbrt.gz) +ok$" "$scratch/out.txt")" = 2 ] || fail "not two scenes: $(cat "$scratch/out.txt")"
says "2 scenes: 2 ok, 0 not" "$scratch/out.txt"
says "    1 with warning: parameter \"coordinatesystem\" is ignored" "$scratch/out.txt"
printf 'WorldBegin\nShape "ball"\nMaterial "shiny"\n' >"$scratch/scenes/bad.pbrt"
expect 3 "$T" check "$scratch/scenes"
grep -qE "^$scratch/scenes/bad.pbrt +$scratch/scenes/bad.pbrt:2:1: .* \(and 1 more\)$" "$scratch/out.txt" ||
  fail "first error without its place: $(cat "$scratch/out.txt")"
says "3 scenes: 2 ok, 1 not" "$scratch/out.txt"
expect 3 "$T" check --json "$scratch/scenes"
command -v python3 >/dev/null && { python3 - "$scratch/out.txt" || fail "check --json: $(cat "$scratch/out.txt")"; } <<'PYTHON'
import json, sys
told = json.load(open(sys.argv[1]))
assert told["ok"] == 2 and told["not ok"] == 1
bad, packed, good = told["scenes"]
assert not bad["ok"] and len(bad["errors"]) == 2 and "bad.pbrt:2:1: " in bad["errors"][0]
assert packed["ok"] and "bdpt" in packed["warnings"][0]["message"] and "packed.pbrt.gz:1:" in packed["warnings"][0]["where"]
assert good["ok"] and good["errors"] == [] and "rooms/good.pbrt:2:" in good["warnings"][0]["where"]
PYTHON
mkdir "$scratch/empty"
expect 3 "$T" check "$scratch/empty"

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
