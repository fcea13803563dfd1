# Renders that are cut off: killed at any moment, interrupted, resumed; what must not be resumed is refused.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf ./*.exr ./*.checkpoint ./.*.part
small_scene >s.pbrt
options="--resolution 80x48 --spp 512 --reproducible --aov Albedo,Z,Variance --quiet"
expect 0 "$T" render s.pbrt $options --threads 1 -o whole.exr
[ ! -e whole.exr.checkpoint ] || fail "a checkpoint nobody asked for"
RANDOM=${TYNDALL_SEED:-1}
kills=20
sanitized && kills=5
[ -z "${TYNDALL_NIGHTLY-}" ] || kills=200

# Killed again and again, with any number of threads: the picture is never half a file, and in the end the unbroken one.
"$T" render s.pbrt --spp 1 --quiet -o old.exr
cp old.exr a.exr
stamp() { stat -c %y.%i a.exr.checkpoint 2>&1; }
killed=0 resumed=0
longest=500  # milliseconds from a new checkpoint to the kill; less where the render is complete by then
for attempt in $(seq $((3 * kills))); do
  [ $killed -lt $kills ] || break
  before=$(stamp)
  "$T" render s.pbrt $options --threads $((RANDOM % 3 + 1)) --checkpoint 0.01 --resume -o a.exr 2>err.txt &
  render=$!
  soon eval '[ "$(stamp)" != "$before" ] || ! kill -0 $render'
  sleep "0.$(printf %03d $((RANDOM % longest)))"
  if kill -KILL $render 2>/dev/null; then killed=$((killed + 1)); else longest=$((longest * 3 / 4 + 1)); fi
  wait $render 2>/dev/null
  [ -e a.exr.checkpoint ] && resumed=$((resumed + 1))
  cmp -s a.exr old.exr || cmp -s a.exr whole.exr || fail "kill $killed left a picture that is neither the old nor the new one"
  cmp -s a.exr whole.exr && { cp old.exr a.exr; rm -f a.exr.checkpoint; }
done
[ $resumed -ge 3 ] || fail "only $resumed of $killed kills left a checkpoint: the test shows nothing"
host=$(uname -n | tr -c "[:alnum:]\n" - | cut -c1-40)
touch .a.exr.checkpoint.$host.$render.7.part .a.exr.$host.$render.7.part .a.exr.$host.$$.7.part  # what the killed leave; and what one who lives needs
expect 0 "$T" render s.pbrt $options --checkpoint 60 --resume -o a.exr
cmp a.exr whole.exr || fail "the resumed picture is not the unbroken one"
[ ! -e a.exr.checkpoint ] || fail "the checkpoint of a finished render is left"
[ "$(ls -A | grep 'part$')" = ".a.exr.$host.$$.7.part" ] || fail "temporary files of the dead are left, or one of the living is gone: $(ls -A | grep part)"
rm -f ./.*.part

# Interrupted, then resumed with another end.
endless=("$T" render s.pbrt --resolution 80x48 --reproducible --time 600 --progress json)
interrupted INT "rendering 4" "${endless[@]}" --checkpoint 60 -o b.exr  # more than the 4 that are too few for it below
[ $code = 130 ] || fail "an interrupted render does not exit with 130"
[ -s b.exr.checkpoint ] || fail "an interrupted render leaves no checkpoint"
held=$(samples_of b.exr)
cp b.exr.checkpoint kept.checkpoint
# --resume alone goes on for as long as it likes, and keeps what it has when it is interrupted again.
interrupted INT "rendering $held" "${endless[@]}" --resume -o b.exr
[ $code = 130 ] || fail "an interrupted, resumed render does not exit with 130"
samples=$(samples_of b.exr)
[ "$samples" -gt $held ] || fail "a resumed render did not go on: $held, then $samples samples"
expect 0 "$T" render s.pbrt --resolution 80x48 --reproducible --spp $((samples + 3)) --resume --progress none -o b.exr
says "going on from $samples samples" err.txt
expect 0 "$T" render s.pbrt --resolution 80x48 --reproducible --spp $((samples + 3)) --quiet -o c.exr
cmp b.exr c.exr || fail "an interrupted and resumed picture is not the unbroken one"

# Less time than the checkpoint has taken is refused, and the checkpoint kept; as much is complete.
interrupted INT 'grep -E "\"samples\":[0-9]{2,},.*\"seconds\":([3-9]|[0-9]{2,})\." err.txt' "${endless[@]}" --checkpoint 60 -o t.exr
cp t.exr.checkpoint t.kept
expect 3 "$T" render s.pbrt --resolution 80x48 --reproducible --time 0.1 --quiet --resume -o t.exr
says "seconds of rendering, more than the 0.1 asked for; give --time" err.txt
cmp t.exr.checkpoint t.kept || fail "a refused checkpoint is gone or another one"

# The error log goes on too: a line for each power of two, none from after the checkpoint.
expect 0 "$T" render s.pbrt --resolution 80x48 --seed 77 --spp 4 --quiet -o reference.exr
logged="--resolution 80x48 --reproducible --reference reference.exr --error-log log.jsonl -o e.exr"
interrupted INT rendering "$T" render s.pbrt $logged --time 600 --progress json --checkpoint 60
samples=$(samples_of e.exr)
cp log.jsonl before.jsonl
echo '{"seconds":9,"samples":1000000000,"mse":0}' >>log.jsonl
expect 0 "$T" render s.pbrt $logged --spp $((samples + 3)) --resume
head -n "$(wc -l <before.jsonl)" log.jsonl | cmp - before.jsonl || fail "the lines before the interrupt are not the first of the log"
sed 's/.*"samples"://; s/,.*//' log.jsonl >counts.txt
sort -nu counts.txt | cmp - counts.txt || fail "the log does not count up: $(cat counts.txt)"
[ "$(tail -n 1 counts.txt)" = $((samples + 3)) ] || fail "the log does not end with the render"

# Refused with both values: another seed, scene, options, frame, build; and what is no whole checkpoint.
refuses() {  # TEXT OPTION...
  local text=$1
  shift
  cp kept.checkpoint d.exr.checkpoint
  expect 3 "$T" render s.pbrt --resolution 80x48 --reproducible --spp 4 --quiet --resume -o d.exr "$@"
  says "$text" err.txt
  [ "$(wc -l <err.txt)" -le 3 ] || fail "more than three lines: $*"
  [ ! -e d.exr ] || fail "a refused checkpoint gave a picture: $*"
}
refuses '--seed 7 here' --seed 7
refuses '--seed 0' --seed 7
refuses "holds $held samples a pixel, more than the 4 asked for"
[ -s d.exr.checkpoint ] || fail "a checkpoint that was refused is gone"
refuses 'of another scene' --max-depth 2
refuses 'of another options' --lights power
refuses 'of another crop' --crop 0,10,0,10
refuses 'of another aov' --aov Albedo
# A library with the identity of another content, which the linker writes 16 bytes into this section.
read -r name path < <(ldd "$T" | awk '/libImath/ { print $1, $3 }')
section=$(readelf -SW "$path" | sed -n 's/.*\.note\.gnu\.build-id *NOTE *[0-9a-f]* *\([0-9a-f]*\) .*/\1/p')
rm -rf upgraded && mkdir upgraded && cp "$path" "upgraded/$name"
printf '\x55\xaa\x55' | dd of="upgraded/$name" bs=1 seek=$((16#$section + 16)) conv=notrunc status=none
LD_LIBRARY_PATH=$PWD/upgraded refuses 'of another build'
sed -i 's/\[9 9 9\]/[9 9 8]/' s.pbrt
refuses 'of another scene'
sed -i 's/\[9 9 8\]/[9 9 9]/' s.pbrt
head -c 1000 kept.checkpoint >cut && cp kept.checkpoint whole.checkpoint && cp cut kept.checkpoint
refuses 'damaged'
cp whole.checkpoint kept.checkpoint
printf '\x55' | dd of=kept.checkpoint bs=1 seek=30000 conv=notrunc status=none
refuses 'checksum'
echo "no checkpoint" >kept.checkpoint
refuses 'no checkpoint'
expect 0 "$T" render s.pbrt --spp 2 --resume -o none.exr
says 'no such file' err.txt
finish
