# `tyndall example`: every example is written, read, rendered; the furnace is white; what cannot be done says so.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf out again million

expect 0 "$T" example --list
names=$(cut -d' ' -f1 out.txt)
[ "$(echo "$names" | wc -l)" -ge 6 ] || fail "--list names too few: $names"

# Written twice alike, sound, and rendered without a bad sample.
for name in $names; do
  lights="--lights 400"
  [ "$name" = furnace ] && lights=
  expect 0 "$T" example "$name" $lights -o "out/$name"
  [ "$(cat out.txt)" = "out/$name/$name.pbrt" ] || fail "$name: the scene's path is not printed: $(cat out.txt)"
  expect 0 "$T" example "$name" $lights -o "again/$name"
  diff -r "out/$name" "again/$name" || fail "$name is not written alike twice"
  says "tyndall example $name $lights" "out/$name/$name.pbrt"
  expect 0 "$T" check "out/$name/$name.pbrt"
  expect 0 "$T" render "out/$name/$name.pbrt" --resolution 48x27 --spp 4 --json -o small.exr
  says '"non_finite": 0' out.txt
  says '"majorant_violations": 0' out.txt
  says '"caps_hit": 0' out.txt
  expect 0 "$T" info small.exr
  grep -A2 "^  G" out.txt | grep -q "mean 0$" && fail "$name is black"
done

# Every pixel of the furnace is 1: 1,000 samples leave a deviation of a few percent a pixel and of 0.1 % in the mean.
expect 0 "$T" render out/furnace/furnace.pbrt --resolution 48x27 --spp 1024 -o furnace.exr
expect 0 "$T" info furnace.exr
for channel in R G B; do
  values=$(grep -A2 "^  $channel\$" out.txt | grep values | tr -d ,)
  echo "$values" | awk '{ if ($3 < 0.8 || $5 > 1.2 || $7 < 0.995 || $7 > 1.005) exit 1 }' || fail "furnace, $channel: $values"
done

# Options reach the scene.
expect 0 "$T" example smoke-lights --lights 30 --shape point --density 0.25 --max-depth 3 --resolution 64x48 --seed 5 -o out/points
expect 2 "$T" example furnace --seed -1
says "--seed: must be a whole number from 0 to 18446744073709551615, not -1" err.txt
expect 2 "$T" example smoke-lights --density nan
[ "$(grep -c 'LightSource "point"' out/points/smoke-lights.pbrt)" = 30 ] || fail "not 30 point lights"
says '"float scale" 0.25' out/points/smoke-lights.pbrt
says '"integer maxdepth" 3' out/points/smoke-lights.pbrt
says '"integer xresolution" 64 "integer yresolution" 48' out/points/smoke-lights.pbrt

# A million lights, in one polygon file, within seconds.
start=$(date +%s)
expect 0 "$T" example ceiling --lights 1000000 -o million
[ $(($(date +%s) - start)) -le 60 ] || fail "a million lights take a minute to write"
[ "$(ls million | wc -l)" = 2 ] || fail "a million lights take more than a scene and a polygon file: $(ls million)"
expect 0 "$T" render million/ceiling.pbrt --resolution 48x27 --spp 1 --json -o million.exr
says '"lights": 1000000' out.txt
rm -rf million

# Files of others stay; one's own are replaced.
echo mine >out/ceiling/mine.txt
echo broken >out/ceiling/ceiling.pbrt
expect 0 "$T" example ceiling --lights 400 -o out/ceiling
cmp out/ceiling/ceiling.pbrt again/ceiling/ceiling.pbrt || fail "an old scene is not replaced"
[ "$(cat out/ceiling/mine.txt)" = mine ] || fail "a file of another is harmed"

# What cannot be done.
expect 2 "$T" example cieling -o out
says 'glossy-lights, mesh-light-fog, ceiling, smoke-lights, fog-street, furnace' err.txt
expect 2 "$T" example
expect 2 "$T" example ceiling --density 2 -o out
says 'takes no --density; it takes --lights' err.txt
expect 2 "$T" example ceiling --lights 0 -o out
expect 2 "$T" example ceiling --lights many -o out
expect 2 "$T" example ceiling --resolution 10 -o out
expect 2 "$T" example ceiling --colour blue -o out
expect 2 "$T" example smoke-lights --shape disc -o out
expect 4 "$T" example furnace -o small.exr/folder
says 'small.exr/folder' err.txt
expect 4 "$T" example furnace -o /proc/no
mkdir -p out/blocked/furnace.pbrt
expect 4 "$T" example furnace -o out/blocked
finish
