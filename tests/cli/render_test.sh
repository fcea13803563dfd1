# `tyndall render` as a user meets it: files, streams, exit codes.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt

# JSON alone on stdout; a healthy summary.
expect 0 "$T" render s.pbrt --json -o a.exr
says '"non_finite": 0' out.txt
says '"majorant_violations": 0' out.txt
[ "$(head -c 1 out.txt)" = "{" ] || fail "stdout does not start with JSON"
says 'health' err.txt
expect 0 "$T" render s.pbrt --quiet -o a.exr
[ -s err.txt ] && fail "--quiet is not quiet: $(cat err.txt)"

# The same bits for any number of threads, and for half the picture rendered as a crop.
for threads in 1 2 4; do expect 0 "$T" render s.pbrt --threads $threads --reproducible -o t$threads.exr; done
cmp t1.exr t2.exr || fail "one thread and two differ"
cmp t1.exr t4.exr || fail "one thread and four differ"
expect 0 "$T" render s.pbrt --seed 1 --reproducible -o other.exr
cmp -s t1.exr other.exr && fail "another seed gives the same picture"
expect 0 "$T" render s.pbrt --crop 8,20,4,12 -o crop.exr
expect 0 "$T" info crop.exr
says '12 x 8' out.txt
says '40 x 24' out.txt

# Every channel, nothing left over from the temporary file.
expect 0 "$T" render s.pbrt --aov Albedo,N,P,Z,Zvol,Variance,SampleCount,Transmittance,SurfaceDirect,SurfaceIndirect,VolumeDirect,VolumeIndirect,Emission -o aov.exr
expect 0 "$T" info aov.exr
for channel in Albedo.R N.X P.Z Z Zvol Variance.G SampleCount Transmittance.B VolumeIndirect.R; do says "$channel" out.txt; done
expect 0 "$T" render s.pbrt -o a.png
[ "$(ls -A | grep -cE "tmp|part")" = 0 ] || fail "a temporary file is left: $(ls -A)"

# Time and samples as limits: whichever comes first.
expect 0 "$T" render s.pbrt --time 0.5 --json -o time.exr
expect 0 "$T" render s.pbrt --spp 3 --time 60 --json -o time.exr
says '"samples": 3' out.txt

# Channels on the side leave the picture as it is; the parts of the light are there.
expect 0 "$T" render s.pbrt --aov Transmittance,Albedo,Variance --threads 1 --reproducible -o side.exr
"$T" info side.exr | grep -E "^ +[RGB] " >side.txt
"$T" info t1.exr | grep -E "^ +[RGB] " >plain.txt
cmp side.txt plain.txt || fail "--aov changes R G B"

# What is worth knowing of a scene reads the same wherever it is told.
{ small_scene; echo TransformBegin; echo TransformEnd; } >warned.pbrt
expect 0 "$T" check warned.pbrt
grep ': warning: ' out.txt >checked.txt
says 'warned.pbrt:17:1: warning: TransformBegin' checked.txt
expect 0 "$T" render warned.pbrt --progress none -o warned.exr
grep ': warning: ' err.txt | cmp - checked.txt || fail "render warns otherwise than check"
expect 0 "$T" compare warned.pbrt --resolution 8x8 --spp 1 --reference-time 0.1 --progress none -o warned
grep '^warned.*: warning: ' err.txt | cmp - checked.txt || fail "compare warns otherwise than check"

# A closed or full stderr costs no render.
("$T" render s.pbrt --progress json -o pipe.exr 2>&1 >/dev/null | head -c 1 >/dev/null)
"$T" render s.pbrt -o full.exr 2>/dev/full || fail "a full stderr fails the render"
[ -s full.exr ] || fail "a full stderr costs the image"
"$T" info s.pbrt >/dev/full 2>/dev/null
[ $? = 4 ] || fail "results that cannot be written are not an error"

# What cannot be done gets its exit code, one clear line, and leaves an old file alone.
expect 2 "$T" render s.pbrt --no-such-option
expect 2 "$T" render s.pbrt --lights brightest
says 'tree-binary' err.txt
expect 2 "$T" render s.pbrt --aov Depth
expect 2 "$T" render s.pbrt --crop 50,60,0,10 -o a.exr
expect 2 "$T" render s.pbrt --crop 30,41,0,10 -o a.exr
expect 2 "$T" render s.pbrt -o a.jpg
expect 0 "$T"
expect 3 "$T" render missing.pbrt
says 'missing.pbrt' err.txt
expect 4 "$T" render s.pbrt -o no/such/folder/a.exr
says 'no/such/folder' err.txt
cp t1.exr keep.exr
(ulimit -f 1; "$T" render s.pbrt --resolution 400x240 --spp 1 -o keep.exr >out.txt 2>err.txt)
[ $? = 4 ] || fail "a full disk does not give exit code 4"
cmp t1.exr keep.exr || fail "a failed write harmed the old file"

# Ctrl-C writes what there is.
interrupted INT rendering "$T" render s.pbrt --time 600 --progress json -o int.exr
[ $code = 130 ] || fail "an interrupted render does not exit with 130"
expect 0 "$T" info int.exr
interrupted TERM rendering "$T" render s.pbrt --time 600 --progress json -o term.exr
[ $code = 143 ] || fail "a terminated render does not exit with 143"
[ -s term.exr ] || fail "a terminated render wrote nothing"
finish
