# How images are written: types, packing, parts, views; options that a file has no use for.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
render() { expect 0 "$T" render s.pbrt --quiet --reproducible "$@"; }
# tells FILE SUBJECT NAME VALUE: info says so of the file.
tells() {
  "$T" info "$1" | awk -v subject="$2" -v name="$3" '/^  [^ ]/ { here = $1 } /^    / && here == subject && $1 == name { sub(/^ +[^ ]+ +/, ""); print }' >told.txt
  grep -qxF -- "$4" told.txt || fail "$1: $2 $3 is not $4 but $(head -c 200 told.txt)"
}

rm -f ./*.exr ./*.png ./*.pfm
render --aov Albedo,Z -o float.exr
tells float.exr image compression zip
tells float.exr R type float
render --aov Albedo,Z --half --compression piz --parts -o half.exr
tells half.exr image compression piz
tells half.exr image parts 4
tells half.exr Albedo.G type half
tells half.exr Z type float
expect 0 "$T" diff half.exr float.exr --max-error 0.001 --no-flip
expect 5 "$T" diff half.exr float.exr --exact --no-flip
expect 0 "$T" diff half.exr float.exr --exact --no-flip --channels Z

# Without options the bytes are those of before: floats, ZIP, one part.
render --compression zip -o a.exr
render -o b.exr
cmp -s a.exr b.exr || fail "the default is not zip"

render -o a.pfm
expect 0 "$T" diff a.pfm b.exr --channels RGB --exact --no-flip
tells a.pfm image stored "32-bit float RGB"
sed 's/Film "rgb"/Film "rgb" "string filename" "named.pfm"/' s.pbrt >named.pbrt
expect 0 "$T" render named.pbrt --quiet
[ -s named.pfm ] || fail "the Film's name was not taken"

for view in srgb filmic agx; do render --view $view -o $view.png; done
render -o default.png
cmp -s srgb.png default.png || fail "the default view is not srgb"
! cmp -s srgb.png agx.png && ! cmp -s filmic.png agx.png && ! cmp -s srgb.png filmic.png || fail "views are alike"
render --exposure 3 -o bright.png
! cmp -s bright.png srgb.png || fail "the exposure changes nothing"
tells agx.png image stored "8-bit RGB, taken as sRGB"

# The other commands that write an image.
render --aov Denoise --spp 8 -o noisy.exr
expect 0 "$T" denoise noisy.exr --quiet --half --parts --compression dwaa -o clean.exr
tells clean.exr image compression dwaa
tells clean.exr R type half
expect 0 "$T" denoise noisy.exr --quiet --view filmic -o clean.png
sed 's/LightSource "point"/LightSource "point" "string lightgroup" "key"/' s.pbrt >groups.pbrt
expect 0 "$T" render groups.pbrt --quiet -o groups.exr
expect 0 "$T" relight groups.exr key=2 --quiet --half -o relit.exr
tells relit.exr R type half

# What cannot be is said before anything is rendered, and nothing is written.
refused() {  # MESSAGE ARGUMENT...
  local message=$1
  shift
  rm -rf none && mkdir none
  expect 2 "$T" "$@"
  says "$message" err.txt
  [ -z "$(ls none)" ] || fail "$* wrote $(ls none)"
}
refused '--half is for .exr files' render s.pbrt --half -o none/a.png
refused '--parts is for .exr files' render s.pbrt --parts -o none/a.pfm
refused '--compression is for .exr files' render s.pbrt --compression piz -o none/a.png
refused '--aov makes channels of .exr images' render s.pbrt --aov Z -o none/a.png
refused '--view is for .png files' render s.pbrt --view agx -o none/a.exr
refused '--exposure is for .png files' denoise noisy.exr --exposure 1 -o none/a.pfm
refused '--view is for .png files' relight groups.exr --view agx -o none/a.exr
refused 'a name that ends in .exr, .png or .pfm' render s.pbrt -o none/a.tif
refused 'jpeg not in' render s.pbrt --compression jpeg -o none/a.exr
for option in --half --parts '--compression dwab'; do
  # shellcheck disable=SC2086
  refused '--slice keeps exact sums' render s.pbrt --spp 32 --slice 1/2 $option -o none/a.exr
done
refused 'a slice holds exact sums' render s.pbrt --spp 32 --slice 1/2 -o none/a.pfm
finish
