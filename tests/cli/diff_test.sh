# `tyndall diff`: exit codes, what it prints, criteria.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
sed 's/"rgb I" \[9 9 9\]/"rgb I" [9.4 9.4 9.4]/' s.pbrt >brighter.pbrt
render() { "$T" render "$@" --quiet || fail "render $*"; }
render s.pbrt --spp 64 --seed 1 --aov Variance -o a.exr
render s.pbrt --spp 64 --seed 2 --aov Variance -o b.exr
render s.pbrt --spp 64 --seed 3 --aov Variance,Z -o z.exr
render brighter.pbrt --spp 64 --seed 4 --aov Variance -o brighter.exr
render s.pbrt --spp 64 --seed 1 --reproducible -o plain.exr
render s.pbrt --spp 64 --seed 5 -o plain5.exr
render s.pbrt --spp 1 --crop 8,20,4,12 -o crop.exr

# word VALUE: four bytes, little-endian. exr RED: a picture of 2 x 1 pixels, G = B = 1, R = 1 and the float of bits RED.
word() { printf "\\x$(printf %02x $(($1 & 255)))\\x$(printf %02x $(($1 >> 8 & 255)))\\x$(printf %02x $(($1 >> 16 & 255)))\\x$(printf %02x $(($1 >> 24 & 255)))"; }
attribute() { printf '%s\0%s\0' "$1" "$2"; word "$3"; }
exr() {
  word 0x01312f76; word 2
  attribute channels chlist 55
  for name in B G R; do printf "$name"'\0'; word 2; word 0; word 1; word 1; done
  printf '\0'
  attribute compression compression 1; printf '\0'
  for window in dataWindow displayWindow; do attribute $window box2i 16; word 0; word 0; word 1; word 0; done
  attribute lineOrder lineOrder 1; printf '\0'
  attribute pixelAspectRatio float 4; word 0x3f800000
  attribute screenWindowCenter v2f 8; word 0; word 0
  attribute screenWindowWidth float 4; word 0x3f800000
  printf '\0'
}
picture() {
  exr >header.bin
  { cat header.bin; word $(($(stat -c %s header.bin) + 8)); word 0; word 0; word 24
    for i in 1 2 3 4 5; do word 0x3f800000; done; word "$1"; } >"$2"
}
picture 0x3f800000 one.exr
picture 0x40000000 two.exr
picture 0x7fc00000 nan.exr
picture 0xff800000 inf.exr

# Two seeds are the same picture, a light 4 % brighter is not; the words and the numbers are there.
expect 0 "$T" diff a.exr b.exr
says 'same by --test' out.txt
for text in relMSE trimmed MAPE SMAPE 'FLIP' '95 % interval' '0.01'; do says "$text" out.txt; done
expect 5 "$T" diff brighter.exr b.exr
says 'differs by --test' out.txt
says 'mean R' out.txt
[ "$(grep -c 'mean R' out.txt)" = 1 ] || fail "the verdict of the test is printed twice: $(cat out.txt)"
expect 0 "$T" diff brighter.exr b.exr --max-relmse 0.5
expect 5 "$T" diff a.exr b.exr --exact
expect 0 "$T" diff a.exr a.exr --exact --no-flip
grep -q FLIP out.txt && fail "--no-flip prints FLIP"
expect 0 "$T" diff a.exr b.exr --reference-noise
says "without the reference's noise" out.txt

# Without variances: equality unless something else is asked for.
expect 0 "$T" diff plain.exr plain.exr
says 'same by --exact' out.txt
expect 5 "$T" diff plain.exr plain5.exr
expect 0 "$T" diff plain.exr plain5.exr --max-error 10 --max-flip 0.9
expect 2 "$T" diff plain.exr plain5.exr --test
says '--aov Variance' err.txt
expect 2 "$T" diff plain.exr plain5.exr --reference-noise

# One value off by one.
expect 5 "$T" diff two.exr one.exr --max-error 0.5
says 'channel R is off by 1 at (1, 0)' out.txt
expect 0 "$T" diff two.exr one.exr --max-error 1

# NaN and infinity differ by every criterion, even from themselves.
for bad in nan inf; do
  expect 5 "$T" diff $bad.exr one.exr --max-error 1e30
  expect 5 "$T" diff one.exr $bad.exr --max-relmse 1e30
  expect 5 "$T" diff $bad.exr $bad.exr -o bad.png
  says '1 value of R in the image not finite, first at (1, 0)' out.txt
done

# A channel on one side, another data window.
expect 5 "$T" diff z.exr a.exr
says 'channel Z is in the image only' out.txt
expect 0 "$T" diff z.exr a.exr --channels RGB
expect 5 "$T" diff crop.exr plain.exr
says '12 x 8 pixels from (8, 4)' out.txt
expect 2 "$T" diff a.exr b.exr --channels Depth

rm -f none.png
expect 5 "$T" diff crop.exr plain.exr -o none.png
says 'none.png: no error picture is made' err.txt
[ -e none.png ] && fail "an error picture of images that have nothing in common"

# JSON alone on stdout, with numbers that are not finite as null.
expect 5 "$T" diff brighter.exr b.exr --json
[ "$(head -c 1 out.txt)" = "{" ] || fail "stdout does not start with JSON"
for text in '"same": false' '"criterion": "--test"' '"relmse_trimmed"' '"bias_low"' '"hdr"' '"alarms"' '"eps": 0.01'; do says "$text" out.txt; done
expect 5 "$T" diff nan.exr one.exr --json
says '"mse": null' out.txt
says '"in": "image"' out.txt

# The error picture, and what cannot be read or written.
expect 0 "$T" diff a.exr b.exr -o error.png
expect 0 "$T" info error.png
says '40 x 24' out.txt
expect 2 "$T" diff a.exr b.exr -o error.exr
expect 4 "$T" diff a.exr b.exr -o no/such/folder/error.png
says 'no/such/folder' err.txt
expect 3 "$T" diff missing.exr b.exr
says 'missing.exr' err.txt
expect 3 "$T" diff a.exr s.pbrt
"$T" diff a.exr b.exr >/dev/full 2>err.txt
[ $? = 4 ] || fail "results that cannot be written are not an error"
for command in "diff a.exr b.exr --json" "diff z.exr z.exr --no-flip" "info z.exr" "info --json a.exr b.exr z.exr" "check s.pbrt" "example --list"; do
  "$T" $command >/dev/full 2>err.txt
  [ $? = 4 ] || fail "$command to a full disk does not exit with 4"
  says 'stdout could not be written' err.txt
done
expect 2 "$T" diff a.exr
expect 2 "$T" diff a.exr b.exr --level 0
expect 2 "$T" diff a.exr b.exr --block 0
expect 2 "$T" diff a.exr b.exr --max-error -1
expect 2 "$T" diff a.exr b.exr --ppd 0
for number in nan inf -1 0.1x 1e400 ''; do
  for option in --max-error --max-relmse --max-flip --level --ppd; do expect 2 "$T" diff a.exr b.exr $option "$number"; done
done
expect 2 "$T" diff a.exr b.exr --level 1
says '--level: must be a number above 0 and below 1, not 1' err.txt
expect 0 "$T" diff a.exr b.exr --max-error +1e3
# Numbers of other primaries are compared as they are, which is said.
{ echo 'ColorSpace "rec2020"'; cat s.pbrt; } >wide.pbrt
render wide.pbrt --spp 1 -o wide.exr
expect 5 "$T" diff wide.exr crop.exr
says 'warning: chromaticities of red, green, blue and white are 0.708 0.292,' out.txt
expect 5 "$T" diff wide.exr plain.exr --json
says '"chromaticities_differ": "chromaticities of red' out.txt
expect 0 "$T" diff a.exr a.exr --json
says '"chromaticities_differ": null' out.txt
expect 0 "$T" diff --help
says '--max-relmse' out.txt
finish
