#!/usr/bin/env bash
# Deep images as a user meets them: laid flat again, sliced, resumed, cropped, in frames, and what cannot be.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
{
  lit_floor 40 24 4
  ball_of '"string type" "homogeneous"'
  echo 'LightSource "infinite" "rgb L" [0.1 0.1 0.2]'
} >s.pbrt
render() { "$T" render "$@" --reproducible --quiet || fail "render $*"; }
# laid_flat DEEP FLAT: the one laid flat is the other, to rounding.
laid_flat() {
  expect 0 "$T" flatten "$1" -o laid.exr --quiet
  expect 0 "$T" diff laid.exr "$2" --channels R,G,B,A --max-error 0.00001 --no-flip
}

render s.pbrt --deep deep.exr -o flat.exr
laid_flat deep.exr flat.exr
render s.pbrt -o plain.exr
"$T" diff flat.exr plain.exr --exact --no-flip --channels R,G,B >diff.txt 2>&1 || fail "the deep image changes the picture: $(cat diff.txt)"
expect 0 "$T" info deep.exr
says 'deep OpenEXR image' out.txt
grep -E 'in a pixel +at most ([5-9]|1[0-9])$' out.txt >/dev/null || fail "samples in a pixel: $(grep 'in a pixel' out.txt)"
says 'tyndall/sceneHash' out.txt
render s.pbrt --deep few.exr --deep-bins 2 -o few_flat.exr
laid_flat few.exr few_flat.exr
[ "$(stat -c %s few.exr)" -lt "$(stat -c %s deep.exr)" ] || fail "two bins take as much as sixteen"
render s.pbrt --deep one.exr --threads 1 -o one_flat.exr
cmp deep.exr one.exr || fail "the deep image depends on the number of threads"

# Slices, and a render that was interrupted, are the whole, byte for byte.
render s.pbrt --spp 48 --deep whole.exr -o whole_flat.exr
mkdir -p slices
for i in 1 2 3; do render s.pbrt --spp 48 --slice $i/3 --deep slices/d$i.exr -o slices/s$i.exr; done
laid_flat slices/d2.exr slices/s2.exr
expect 0 "$T" merge slices -o joined_flat.exr --deep joined.exr
cmp whole_flat.exr joined_flat.exr || fail "three slices are not the whole"
cmp whole.exr joined.exr || fail "three slices are not the whole in depth"
expect 0 "$T" status slices
says 'there 3, running 0, lost 0, missing 0' out.txt
expect 0 "$T" merge slices -o joined_flat.exr
cmp whole_flat.exr joined_flat.exr || fail "without --deep three slices are not the whole"
expect 0 "$T" render s.pbrt --spp 48 --slice 1/3 --deep slices/d1.exr -o slices/s1.exr --resume --reproducible
says 'this slice is there already' err.txt
# Slices of fewer depths, or of others, make no deep image.
mkdir -p others && cp slices/s[12].exr others/
for bins in '' '--deep others/d3.exr --deep-bins 4'; do
  render s.pbrt --spp 48 --slice 3/3 $bins -o others/s3.exr
  refused 2 '--deep is for slices that were rendered with --deep' merge others -o none/b.exr --deep none/a.exr
  expect 0 "$T" merge others/s1.exr others/s2.exr others/s3.exr -o joined_flat.exr
  rm others/*3.exr
done
broken_off broken_flat.exr s.pbrt --deep broken.exr
more=$(($(samples_of broken_flat.exr) + 3))
laid_flat broken.exr broken_flat.exr
"$T" info broken.exr | grep -E 'tyndall/stopped +1$' >/dev/null || fail "the deep image does not tell that it was stopped"
expect 3 "$T" render s.pbrt --spp $more --deep broken.exr --deep-bins 8 -o broken_flat.exr --resume --quiet
says 'is of another deep image' err.txt
render s.pbrt --spp $more --deep straight.exr -o straight_flat.exr
render s.pbrt --spp $more --deep broken.exr -o broken_flat.exr --resume
cmp straight.exr broken.exr || fail "a resumed render has another deep image"

# A crop has the pixels of the whole; frames have a file each; where pixels differ in their samples.
render s.pbrt --crop 5,17,3,24 --deep crop.exr -o crop_flat.exr
laid_flat crop.exr crop_flat.exr
"$T" flatten crop.exr -o a.exr --quiet
render s.pbrt --crop 17,40,0,24 --deep right.exr -o right_flat.exr
render s.pbrt --crop 0,17,0,24 --deep left.exr -o left_flat.exr
expect 0 "$T" merge left_flat.exr right_flat.exr -o crops.exr
"$T" diff crops.exr flat.exr --exact --no-flip --channels R,G,B,A >diff.txt 2>&1 || fail "two crops are not the whole: $(cat diff.txt)"
render s.pbrt --frames 1-2 --deep d%d.exr -o f%d.exr
laid_flat d2.exr f2.exr
rm d1.exr
expect 0 "$T" render s.pbrt --frames 1-2 --deep d%d.exr -o f%d.exr --resume --reproducible --progress none
[ "$(grep -c 'is there already' err.txt)" = 1 ] && [ -f d1.exr ] || fail "a frame without its deep image was skipped: $(cat err.txt)"
render s.pbrt --error 0.02 --spp 256 --deep adaptive.exr -o adaptive_flat.exr
laid_flat adaptive.exr adaptive_flat.exr
# A denoised picture has what the deep one makes in noisy.
render s.pbrt --spp 8 --denoise --deep noisy.exr -o denoised.exr
"$T" flatten noisy.exr -o laid.exr --quiet
! "$T" diff laid.exr denoised.exr --channels R,G,B --max-error 0.00001 --no-flip >diff.txt 2>&1 || fail "the deep image is denoised"

refused() {  # CODE MESSAGE ARGUMENT...
  local code=$1 message=$2
  shift 2
  rm -rf none && mkdir none
  expect "$code" "$T" "$@"
  says "$message" err.txt
  [ -z "$(ls none)" ] || fail "$* wrote $(ls none)"
}
refused 2 'give a name that ends in .exr' render s.pbrt --deep none/a.png -o none/b.exr
refused 2 "is the flat image's name too" render s.pbrt --deep none/a.exr -o none/../none/a.exr
refused 2 '--deep-bins' render s.pbrt --deep none/a.exr --deep-bins 0 -o none/b.exr
refused 2 '--deep-bins' render s.pbrt --deep none/a.exr --deep-bins 257 -o none/b.exr
refused 2 'requires --deep' render s.pbrt --deep-bins 8 -o none/b.exr
refused 4 'missing does not exist' render s.pbrt --deep missing/a.exr -o none/b.exr
refused 2 '--deep' render s.pbrt --frames 1-2 --deep none/a.exr -o none/b%d.exr
refused 2 '--deep is for slices that were rendered with --deep' merge left_flat.exr right_flat.exr --deep none/a.exr -o none/b.exr
refused 3 'flat.exr: is a flat image' flatten flat.exr -o none/a.exr
refused 3 'tyndall flatten' diff deep.exr flat.exr
refused 2 'exr, .png or .pfm' flatten deep.exr -o none/a.tif
expect 0 "$T" flatten deep.exr -o flat.png --quiet
finish
