#!/usr/bin/env bash
# What Tyndall writes opens in OpenImageIO's tools, with the channels, types, packing and parts that were asked for. Needs Debian's
# openimageio-tools.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
command -v oiiotool >/dev/null || { echo "oiiotool is not there; install openimageio-tools"; exit 1; }
small_scene >s.pbrt

# opens FILE TEXT...: oiiotool reads it to its last pixel and says each text of it.
opens() {
  local file=$1 text
  shift
  expect 0 oiiotool -a --info -v --stats "$file"
  for text in "$@"; do says "$text" out.txt; done
  [ ! -s err.txt ] || fail "oiiotool complains of $file: $(head -c 300 err.txt)"
}

for compression in none rle zips zip piz dwaa dwab; do
  for type in half float; do
    flag=--half
    [ $type = half ] || flag=
    expect 0 "$T" render s.pbrt --quiet --aov Albedo,Z,Variance $flag --compression $compression -o a.exr
    opens a.exr "40 x   24, 12 channel" "compression: \"$compression\"" "tyndall/samples: 4"
    [ $type = float ] || says "channel list: R (half), G (half), B (half), A (half)" out.txt
    [ $type = half ] || says "12 channel, float openexr" out.txt
  done
done
expect 0 "$T" render s.pbrt --quiet --aov Albedo,Z --parts --half -o parts.exr
opens parts.exr "4 subimages: 40x24 [h,h,h,h], 40x24 [h,h,h], 40x24 [f], 40x24 [f]" 'name: "rgba"' 'name: "Albedo"' 'name: "Z"'

# The same values as in the file of one part.
expect 0 "$T" render s.pbrt --quiet -o whole.exr
expect 0 "$T" render s.pbrt --quiet --aov Z --parts -o several.exr
oiiotool several.exr --subimage 0 --ch R,G,B,A -o first.exr >/dev/null
expect 0 "$T" diff first.exr whole.exr --channels RGB,A --exact --no-flip

for view in srgb filmic agx; do
  expect 0 "$T" render s.pbrt --quiet --view $view -o a.png
  opens a.png "3 channel, uint8 png" 'oiio:ColorSpace: "sRGB"'
done
expect 0 "$T" render s.pbrt --quiet -o a.pfm
opens a.pfm "3 channel, float pnm"
oiiotool a.pfm -o from_pfm.exr >/dev/null
expect 0 "$T" diff from_pfm.exr whole.exr --channels RGB --exact --no-flip
finish
