#!/usr/bin/env bash
# Memory that runs out once, at each place in turn while a scene is read, built, rendered and written, or for good at a limit:
# one message, an exit code, no half of a picture, no crash.
#   TYNDALL_FAILING_MALLOC   the library of failing_malloc.cpp
#   TYNDALL_NIGHTLY=1        at all places instead of 60
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"

{ small_scene; ball_of '"string type" "uniformgrid" "integer nx" 2 "integer ny" 1 "integer nz" 1 "float density" [1 2]' |
    sed 's/"m"/"grid"/g; s/Translate 0 0.6 0/Translate 1 0.6 0/'; } >scene.pbrt
render=("$TYNDALL_BIN" render scene.pbrt --threads 2 --reproducible -o out.exr)

# A render that hangs does not end at the first signal either: it is to wait for the pass.
patience=(timeout --kill-after 5 120)

# judged WHAT CODE: of the run that ended with CODE. One that got over it must have the whole picture.
judged() {
  local what=$1 code=$2
  case $code in
    0) cmp -s out.exr whole.exr || fail "$what: exit code 0 and another picture" ;;
    1 | 3 | 4)
      # Memory may run out when the picture is written and only its summary is to be printed.
      [ ! -e out.exr ] || cmp -s out.exr whole.exr || fail "$what: exit code $code, and another picture"
      [ "$(wc -l <err.txt)" -le 3 ] && [ -s err.txt ] || fail "$what: not one message: $(head -c 300 err.txt)"
      ;;
    124 | 137) fail "$what: no end after two minutes" ;;
    *) fail "$what: exit code $code: $(head -c 300 err.txt)" ;;
  esac
  [ -z "$(find . -maxdepth 1 -name 'out.exr?*' -o -maxdepth 1 -name '.out*')" ] || fail "$what: left $(ls -A | tr '\n' ' ')"
  rm -f out.exr
}

run_out() { "${patience[@]}" env "LD_PRELOAD=$TYNDALL_FAILING_MALLOC" "$@" "${render[@]}" >out.txt 2>err.txt; }

expect 0 "${patience[@]}" "${render[@]}"
mv out.exr whole.exr
run_out TYNDALL_COUNT_FILE=count.txt || fail "the library that counts allocations does not work: $(head -c 300 err.txt)"
cmp -s out.exr whole.exr || fail "counting allocations changes the picture"
rm -f out.exr
total=$(cat count.txt)
places=60
[ "${TYNDALL_NIGHTLY-}" = 1 ] && places=$total
[ "$total" -gt 2000 ] || fail "only $total allocations were counted"
got_over=0
for ((i = 0; i < places; ++i)); do
  at=$((1 + i * (total - 1) / places))
  run_out "TYNDALL_FAIL_AT=$at"
  code=$?
  [ $code = 0 ] && got_over=$((got_over + 1))
  judged "allocation $at of $total" $code
done
echo "$places of $total allocations failed, $got_over without harm"
[ $got_over -lt $((places / 2)) ] || fail "most failed allocations were not noticed: do they fail?"

refused=0
for megabytes in 64 96 128 160 192 224 256 320 384 512 1024 4096; do
  # Where the libraries do not get as far as main(), there is nothing to be judged.
  { (ulimit -v $((megabytes * 1024)); exec "${patience[@]}" "$TYNDALL_BIN" --version); } >out.txt 2>&1 || continue
  (ulimit -v $((megabytes * 1024)); exec "${patience[@]}" "${render[@]}" >out.txt 2>err.txt)
  code=$?
  [ $code = 0 ] || refused=$((refused + 1))
  judged "in $megabytes MB of addresses" $code
done
echo "refused at $refused limits of addresses"
finish
