# What becomes of an image that cannot be written: exit code 4, the file that was there intact, the render kept.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
rm -rf full unsaved folder.exr device.exr
mkdir unsaved
export TMPDIR=$PWD/unsaved HOME=$PWD/unsaved
expect 0 "$T" render s.pbrt --reproducible --quiet -o whole.exr
echo "what was there" >old

# refuses NAME MESSAGE: the render into NAME ends with 4 and the message; NAME still holds what was there.
refuses() {
  cp old "$1" 2>/dev/null
  expect 4 "$T" render s.pbrt --reproducible --quiet -o "$1"
  says "$2" err.txt
  [ "$(wc -l <err.txt)" -le 3 ] || fail "more than three lines for $1"
  [ ! -e "$1" ] || cmp -s old "$1" || fail "$1 was harmed"
}

# Before anything is rendered: no folder, a folder in place of a file, a device, no room.
refuses missing/a.exr 'missing'
mkdir -p folder.exr
expect 4 "$T" render s.pbrt -o folder.exr
ln -sf /dev/full device.exr
expect 4 "$T" render s.pbrt -o device.exr
says 'not a regular file' err.txt
if [ "$(id -u)" != 0 ]; then
  mkdir -p closed && chmod 555 closed
  refuses closed/a.exr 'not writable'
fi
for kilobytes in 1 2 5 9 40; do
  (failures=0; ulimit -f $kilobytes; refuses limit.exr 'can be written'; exit $failures) || fail "limit of $kilobytes KB"
done

(failures=0; ulimit -f 100; expect 4 "$T" render s.pbrt --quiet --checkpoint 60 -o limit.exr; says 'a checkpoint may take' err.txt; exit $failures) ||
  fail "a limit between the image and its checkpoint"

# A disk that fills up while the picture is rendered: the picture ends up elsewhere, whole. Needs a disk of our own.
cat >full_disk.sh <<'INNER'
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
mount -t tmpfs -o size=1m none full
cp old full/a.exr
interrupted INT 'rendering && ! cat /dev/zero >full/fill' \
  "$T" render s.pbrt --spp 1000000 --reproducible --progress json -o full/a.exr
[ $code = 4 ] || fail "exit code $code, not 4: $(cat err.txt)"
[ -s full/a.exr ] || fail "the old file is gone"
exit $failures
INNER
# The checkpoint of a complete render makes room for its image.
cat >checkpoint_disk.sh <<'INNER'
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
mount -t tmpfs -o size=200k none full
expect 4 "$T" render s.pbrt --quiet --checkpoint 60 -o full/a.exr
says 'a checkpoint and its successor may take' err.txt
mount -t tmpfs -o size=1m none full
# Stopped while the disk is filled, or it might be complete before.
interrupted CONT 'test -s full/a.exr.checkpoint && kill -STOP $pid && ! cat /dev/zero >full/fill' \
  "$T" render s.pbrt --time 5 --reproducible --quiet --checkpoint 0.0001 -o full/a.exr
[ $code = 0 ] || fail "exit code $code: $(cat err.txt)"
expect 0 "$T" info full/a.exr
[ ! -e full/a.exr.checkpoint ] || fail "the checkpoint of a complete render is left"
exit $failures
INNER
# Reports of compare and images of merge are kept too.
cat >other_disk.sh <<'INNER'
mount -t tmpfs -o size=64k none full
"$T" compare s.pbrt --variants lights --resolution 8x8 --spp 4 --reference-time 0.2 --quiet -o full/report 2>err.txt
[ $? = 4 ] || { echo "compare: $(cat err.txt)"; exit 1; }
grep -q 'The report is not lost: it is in ' err.txt || { echo "compare: $(cat err.txt)"; exit 1; }
mount -t tmpfs -o size=4k none full
"$T" merge s1.exr s2.exr -o full/merged.exr 2>err.txt
[ $? = 4 ] || { echo "merge: $(cat err.txt)"; exit 1; }
grep -q 'The image is not lost: it is in ' err.txt || { echo "merge: $(cat err.txt)"; exit 1; }
INNER
mkdir -p full
export T
if unshare -rm true 2>/dev/null && unshare -rm sh -c 'mount -t tmpfs none full' 2>/dev/null; then
  unshare -rm bash full_disk.sh || fail "a disk that fills up"
  says 'No space left' err.txt
  says 'is not lost' err.txt
  [ "$(ls unsaved/*.exr | wc -l)" = 1 ] || fail "the picture is not where it was said to be"
  expect 0 "$T" info unsaved/*.exr
  rm unsaved/*
  unshare -rm bash checkpoint_disk.sh || fail "the checkpoint on a disk that fills up"
  [ -z "$(ls unsaved)" ] || fail "copies of a picture that was written are left: $(ls unsaved)"
  for seed in 1 2; do "$T" render s.pbrt --seed $seed --quiet -o s$seed.exr; done
  unshare -rm bash other_disk.sh || fail "a report or a merged image without room"
  for file in results.json error.csv index.html reference.exr; do [ -s unsaved/report.unsaved-*/$file ] || fail "no $file is left of the report"; done
  expect 0 "$T" info unsaved/merged.unsaved-*.exr
else
  echo "skipped: no file system of our own can be mounted here"
fi
finish
