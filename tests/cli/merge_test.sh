# `tyndall merge` as a user meets it: slices of one scene joined, everything else refused with a reason.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
render() { "$T" render "$@" --reproducible --quiet || fail "render $*"; }
hash_of() { "$T" info "$1" | sed -n 's/.*tyndall\/sceneHash *//p'; }

# Two crops of one seed are the whole picture, and the summary says what was joined.
render s.pbrt -o whole.exr --aov SampleCount,Z,P,Zvol,Albedo,Variance
render s.pbrt --crop 0,17,0,24 -o left.exr --aov SampleCount,Z,P,Zvol,Albedo,Variance
render s.pbrt --crop 17,40,0,24 -o right.exr --aov SampleCount,Z,P,Zvol,Albedo,Variance
expect 0 "$T" merge left.exr right.exr -o joined.exr
says '40 x 24 pixels at 0, 0 from 2 image(s), 4 samples a pixel, seed 0' err.txt
[ -s out.txt ] && fail "merge writes to stdout: $(cat out.txt)"
pixels_of() { "$T" info "$1" | grep -E 'min |^    (data|display) window'; }
pixels_of whole.exr >whole.txt
pixels_of joined.exr | grep -v 'min 1, max 1, mean 1$' >joined.txt  # Dof, which a render has not
grep -v 'min 1, max 1, mean 1$' whole.txt | diff - joined.txt || fail "two halves are not the whole"

# Seeds: any order gives the same bytes, and the merged image can be merged again.
for seed in 1 2 3; do render s.pbrt --seed $seed --spp $((seed * 4)) -o s$seed.exr; done
expect 0 "$T" merge s1.exr s2.exr s3.exr -o a.exr
expect 0 "$T" merge s3.exr s1.exr s2.exr -o b.exr --quiet
[ -s err.txt ] && fail "--quiet is not quiet: $(cat err.txt)"
cmp a.exr b.exr || fail "the order of slices changes the bytes"
expect 0 "$T" merge s1.exr s2.exr -o s12.exr
expect 0 "$T" merge s12.exr s3.exr -o c.exr
expect 0 "$T" info c.exr
says 'seed 1 samples 4 crop 0,40,0,24; seed 2 samples 8 crop 0,40,0,24; seed 3 samples 12 crop 0,40,0,24' out.txt
grep -E 'tyndall/samples +24$' out.txt >/dev/null || fail "samples of three slices are not 24"
[ "$(hash_of c.exr)" = "$(hash_of s1.exr)" ] || fail "merging changes the scene hash"

# Slices of one seed: whatever their order they give the bytes of the render that was not sliced.
parts=(--spp 100 --aov Z,P,Zvol,Albedo,SurfaceDirect)
render s.pbrt "${parts[@]}" -o whole.exr
for i in 1 2 3 4; do render s.pbrt "${parts[@]}" --slice $i/4 -o slice$i.exr; done
expect 0 "$T" merge slice3.exr slice1.exr slice4.exr slice2.exr -o joined.exr --error 1e-9
cmp whole.exr joined.exr || fail "four slices are not the whole"
says 'from 4 image(s), 100 samples a pixel, seed 0' err.txt
says 'all 4 slices are there' err.txt
grep -E 'for 1e-09 about [0-9]+ samples a pixel more are needed' err.txt >/dev/null || fail "not said what is needed: $(cat err.txt)"
says 'the first: tyndall render s.pbrt --aov Z,P,Zvol,Albedo,SurfaceDirect --slice 1/4 -o seed1-slice1.exr' err.txt
grep -E -- ' --spp [0-9]+ --seed 1$' err.txt >/dev/null || fail "no command for more samples: $(cat err.txt)"
# One is missing, one is cut in half, one has a changed byte: what is there is merged, and the others are named.
head -c $(($(wc -c <slice2.exr) / 2)) slice2.exr >cut.exr
expect 7 "$T" merge slice1.exr cut.exr slice4.exr -o some.exr
says '2 of 4 slices are there; missing or not complete: 2, 3' err.txt
says 'left out: cut.exr: ' err.txt
says "tyndall render s.pbrt ${parts[*]} --slice 3/4 -o slice3.exr" err.txt
for i in 2 3; do render s.pbrt "${parts[@]}" --slice $i/4 -o slice$i.exr; done
expect 0 "$T" merge slice?.exr -o again.exr
cmp whole.exr again.exr || fail "slices that were rendered again are not the whole"
expect 7 "$T" merge slice1.exr missing.exr slice4.exr -o other.exr --quiet
cmp some.exr other.exr || fail "what is missing and what is damaged make different pictures of the rest"
# A folder stands for the images in it. Who watches writes what has come, until all have.
mkdir -p come && rm -f come/* && cp slice1.exr come/
timeout 300 "$T" merge come -o come/grows.exr --watch 0.1 2>watch.txt &
watcher=$!
soon test -s come/grows.exr
"$T" info come/grows.exr | grep -E 'tyndall/samples +32$' >/dev/null || fail "one slice that came is not there: $(cat watch.txt)"
cp slice2.exr slice3.exr slice4.exr come/
wait $watcher || fail "the watcher ended with $?: $(cat watch.txt)"
cmp whole.exr come/grows.exr || fail "what came one by one is not the whole"
says '1 of 4 slices are there' watch.txt
rm come/grows.exr
expect 0 "$T" merge come -o folder.exr
cmp whole.exr folder.exr || fail "a folder of slices is not the whole"
# A slice that is there is not rendered again; a damaged one, or one of other options, is.
cp slice2.exr kept.exr && touch -d 2001-01-01 kept.exr
expect 0 "$T" render s.pbrt "${parts[@]}" --reproducible --slice 2/4 --resume -o kept.exr
says 'is there already' err.txt
[ "$(date -r kept.exr +%Y)" = 2001 ] || fail "a slice that was there was written again"
head -c 2000 slice2.exr >kept.exr
expect 0 "$T" render s.pbrt "${parts[@]}" --reproducible --quiet --slice 2/4 --resume -o kept.exr
expect 0 "$T" merge slice1.exr kept.exr slice3.exr slice4.exr -o joined.exr
cmp whole.exr joined.exr || fail "a damaged slice was not rendered again"
for other in '--slice 3/4' '--slice 2/4 --seed 1' '--slice 2/4 --max-depth 2' '--slice 2/4 --lights power' \
  '--slice 2/4 --crop 0,40,0,12'; do
  cp slice2.exr kept.exr && touch -d 2001-01-01 kept.exr
  expect 0 "$T" render s.pbrt "${parts[@]}" --quiet $other --resume -o kept.exr
  [ "$(date -r kept.exr +%Y)" = 2001 ] && fail "taken for a slice with $other"
done
# A slice that comes twice counts once; slices of two seeds are merged as other renders are.
cp slice2.exr copy.exr
expect 3 "$T" merge slice1.exr slice2.exr copy.exr -o no.exr
says 'the same samples would count twice' err.txt
render s.pbrt "${parts[@]}" --seed 1 --slice 1/4 -o seed1.exr
expect 7 "$T" merge slice1.exr seed1.exr -o seeds.exr
says '64 samples a pixel, seed 0, 1' err.txt
[ "$(grep -c '1 of 4 slices are there; missing or not complete: 2, 3, 4' err.txt)" = 2 ] ||
  fail "what two renders lack is not said: $(cat err.txt)"
# Of these as well a damaged one is left out.
render s.pbrt "${parts[@]}" --seed 2 --slice 1/4 -o seed2.exr
head -c $(($(wc -c <seed2.exr) / 2)) seed2.exr >cut.exr
expect 7 "$T" merge slice1.exr seed1.exr slice2.exr cut.exr -o some.exr
says 'left out: cut.exr: ' err.txt
# The next seed is none that was rendered; names with quotes and what looks like an option stay what they are.
render s.pbrt --spp 32 --seed 7 --slice 1/2 -o "my-o it's 1.exr"
expect 7 "$T" merge "my-o it's 1.exr" -o half.exr --error 1e-9
says "--seed 7 --slice 2/2 -o 'my-o it'\\''s 2.exr'" err.txt
says "-o 'seed8-my-o it'\\''s 1.exr'" err.txt
grep -E -- ' --seed 8$' err.txt >/dev/null || fail "no command of another seed: $(cat err.txt)"
render s.pbrt --seed 5 --denoise --aov Denoise -o clean.exr
expect 3 "$T" merge clean.exr -o no.exr
says 'clean.exr: is denoised' err.txt
# What cannot be sliced.
for wrong in 0/4 5/4 1 a/b 1/4/2; do expect 2 "$T" render s.pbrt --spp 64 --slice $wrong -o no.exr; done
expect 2 "$T" render s.pbrt --spp 16 --slice 1/4 -o no.exr
says 'is empty' err.txt
expect 2 "$T" render s.pbrt --spp 64 --slice 1/4 --error 0.1 -o no.exr
says 'give it to merge' err.txt
expect 2 "$T" render s.pbrt --spp 64 --slice 1/4 -o no.png
says 'a slice holds exact sums' err.txt

# The scene hash: the same in another folder and with other methods; another one for another picture.
mkdir -p elsewhere && cp s.pbrt elsewhere/t.pbrt
render elsewhere/t.pbrt --seed 9 --spp 1 --lights power --transmittance ratio --crop 0,8,0,8 --threads 1 -o moved.exr
[ "$(hash_of moved.exr)" = "$(hash_of s1.exr)" ] || fail "the folder or the method changes the scene hash"
[ "$(hash_of s1.exr | tr -d '0-9a-f\n' | wc -c)$(hash_of s1.exr | wc -c)" = 017 ] || fail "the hash is not 16 hex digits"
sed 's/sigma_s" \[1 1 1\]/sigma_s" [1 1 1.01]/' s.pbrt >denser.pbrt
render denser.pbrt --seed 4 -o denser.exr
render s.pbrt --max-depth 4 --seed 4 -o deeper.exr
for other in denser deeper; do
  expect 3 "$T" merge s1.exr $other.exr -o no.exr
  says "$other.exr: scene hash $(hash_of $other.exr) differs from $(hash_of s1.exr) of s1.exr" err.txt
done

# What cannot be merged: exit code, one line that says why, and no file.
expect 3 "$T" merge s1.exr ./s1.exr -o no.exr
says 'the same samples would count twice' err.txt
expect 3 "$T" merge s1.exr s1.exr -o no.exr
says 's1.exr: is given twice; name it once' err.txt
render s.pbrt --seed 5 --resolution 20x12 -o small.exr
expect 3 "$T" merge s1.exr small.exr -o no.exr
says 'frame is 20x12' err.txt
render s.pbrt --seed 5 --aov Z -o z.exr
expect 3 "$T" merge s1.exr z.exr -o no.exr
says 'only z.exr has SurfaceCount, Z' err.txt
render s.pbrt --seed 5 --spp 1 --aov Variance -o one.exr
expect 3 "$T" merge one.exr -o no.exr
says '1 sample a pixel' err.txt
render s.pbrt --seed 5 --crop 0,8,0,8 -o corner.exr
render s.pbrt --seed 5 --crop 12,40,0,8 -o band.exr
expect 3 "$T" merge corner.exr band.exr -o no.exr
says 'leave 32 pixels within 8,12,0,8 empty' err.txt
expect 0 "$T" merge corner.exr band.exr -o filled.exr --fill-black
says '0..4 samples a pixel' err.txt
render s.pbrt -o picture.png
expect 3 "$T" merge s1.exr picture.png -o no.exr
says 'picture.png: is not an OpenEXR file' err.txt
head -c 900 s2.exr >cut.exr
expect 3 "$T" merge s1.exr cut.exr -o no.exr
expect 3 "$T" merge s1.exr missing.exr -o no.exr
expect 3 "$T" merge s1.exr "$TYNDALL_SOURCE_DIR/tests/regression/pbrt/shapes.exr" -o no.exr
says 'has no attribute tyndall/sceneHash' err.txt
expect 2 "$T" merge s1.exr s2.exr -o no.png
expect 2 "$T" merge -o no.exr
expect 2 "$T" merge s1.exr
expect 4 "$T" merge s1.exr s2.exr -o no/folder/out.exr
[ -e no.exr ] && fail "a refused merge left a file"
[ "$(ls -A | grep -cE "tmp|part")" = 0 ] || fail "a temporary file is left: $(ls -A)"
finish
