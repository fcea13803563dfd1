#!/usr/bin/env bash
# `tyndall denoise` and `render --denoise` as a user meets them.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
channels() { "$T" info "$1" | sed -nE 's/^  ([A-Za-z.]+)$/\1/p' | grep -vE '^(image|attribute)$' | sort | tr '\n' ' '; }

# At the end of a render, or later: the same picture. The noisy one is that of a render that was not denoised.
expect 0 "$T" render s.pbrt --spp 16 --reproducible --denoise --aov Albedo -o now.exr
says 'as rendered in noisy.R .G .B' err.txt
expect 0 "$T" render s.pbrt --spp 4 --denoise -o now.png
grep -qE 'denoise .* after$' err.txt || fail "no line on denoising: $(cat err.txt)"
grep -q 'noisy.R' err.txt && fail "a PNG holds no noisy.R: $(cat err.txt)"
expect 0 "$T" render s.pbrt --spp 16 --reproducible --quiet --aov Denoise -o noisy.exr
expect 0 "$T" denoise noisy.exr -o later.exr
expect 0 "$T" diff now.exr later.exr --channels RGB --exact
expect 0 "$T" render s.pbrt --spp 16 --reuse off --reproducible --quiet -o plain.exr
expect 0 "$T" diff plain.exr noisy.exr --channels RGB --exact
[ "$(channels now.exr)" = "A Albedo.B Albedo.G Albedo.R B G Mse.B Mse.G Mse.R R noisy.B noisy.G noisy.R " ] ||
  fail "channels of a denoised render: $(channels now.exr)"
expect 0 "$T" info now.exr
says 'first-order regression of Emission SurfaceDirect SurfaceIndirect VolumeDirect VolumeIndirect' out.txt

# Any number of threads, an unbroken render or a resumed one, slices or the whole.
expect 0 "$T" denoise noisy.exr -o one.exr --threads 1 --quiet
[ -s err.txt ] && fail "--quiet is not quiet: $(cat err.txt)"
cmp later.exr one.exr || fail "threads change the picture"
for i in 1 2; do expect 0 "$T" render s.pbrt --spp 32 --reproducible --quiet --aov Denoise --slice $i/2 -o slice$i.exr; done
expect 0 "$T" merge slice1.exr slice2.exr -o merged.exr
expect 0 "$T" denoise merged.exr -o merged_clean.exr
expect 0 "$T" render s.pbrt --spp 32 --reproducible --quiet --denoise -o whole.exr
expect 0 "$T" diff whole.exr merged_clean.exr --channels RGB --exact
for seed in 1 2; do expect 0 "$T" render s.pbrt --spp 8 --seed $seed --quiet --aov Denoise -o seed$seed.exr; done
expect 0 "$T" merge seed1.exr seed2.exr -o seeds.exr
expect 0 "$T" denoise seeds.exr -o seeds.png
[ -s seeds.png ] || fail "no PNG"

# What is missing is named, with what that costs.
expect 0 "$T" render s.pbrt --spp 8 --quiet --aov Replicate,Albedo -o few.exr
expect 0 "$T" denoise few.exr -o few_clean.exr --json
says 'few.exr: has no Transmittance: edges of smoke are blurred' err.txt
says '"missing"' out.txt

# What cannot be.
expect 3 "$T" denoise plain.exr -o x.exr
says 'plain.exr: holds no replicates' err.txt
says '--aov Denoise' err.txt
expect 3 "$T" denoise later.exr -o x.exr
says 'is denoised already' err.txt
expect 3 "$T" denoise s.pbrt -o x.exr
expect 2 "$T" denoise noisy.exr -o x.tif
expect 4 "$T" denoise noisy.exr -o nowhere/x.exr
expect 2 "$T" render s.pbrt --spp 1 --denoise -o x.exr
says 'give --spp 2 or more' err.txt
expect 2 "$T" render s.pbrt --spp 32 --slice 1/2 --denoise -o x.exr
says 'tyndall merge' err.txt
expect 2 "$T" render s.pbrt --preview-every 1 -o x.exr
[ ! -e x.exr ] || fail "something was written"

# Pictures on the way.
expect 0 "$T" render s.pbrt --spp 16 --denoise --preview-every 0.000001 --quiet -o preview.exr
expect 0 "$T" diff preview.exr now.exr --channels RGB --exact
# A preview that cannot be written ends no render: the folder of the output is away for a while.
rm -rf there away  # of a run that was killed
mkdir there
"$T" render s.pbrt --time 600 --denoise --preview-every 0.000001 --progress none -o there/p.exr >out.txt 2>err.txt &
render=$!
soon test -s there/p.exr
mv there away
soon grep -q 'the render goes on without this preview' err.txt
mv away there
kill -INT $render
wait $render
[ $? = 130 ] || fail "exit code of a render whose previews failed, and that was interrupted: $(cat err.txt)"
expect 0 "$T" info there/p.exr
says 'tyndall/denoised' out.txt


# What is left does not include it.
expect 0 "$T" render s.pbrt --spp 4 --denoise --progress bar -o bar.exr
says 'left, then denoising' err.txt
expect 0 "$T" render s.pbrt --spp 4 --progress bar -o bar.exr
grep -q denoising err.txt && fail "a render that is not denoised speaks of denoising"
finish
