# Sequences: render --frames, killed and resumed; what frames share is read once; what is missing is said before anything is rendered.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf ./*.exr ./*.checkpoint ./.*.part smoke job* shots
smoke_of=$TYNDALL_SOURCE_DIR/volumes/mantaflow_smoke
mkdir smoke shots
# Two frames of smoke, again and again.
for frame in 1 2 3 4 5 6 7 8; do
  number=$((frame % 2 ? 25 : 50))
  cp "$smoke_of/mantaflow_smoke_00$number.vdb" smoke/smoke.000$frame.vdb
done
for frame in {009..200}; do ln -s smoke.0001.vdb smoke/smoke.0$frame.vdb; done  # more than are rendered before a kill
cp "$smoke_of/thumbnail.png" map.png
shot() {
  lit_floor "$1" "$2" "$3" | sed 's/^Material .*/Texture "t" "spectrum" "imagemap" "string filename" "map.png"\nMaterial "diffuse" "texture reflectance" "t"/'
  cat <<SCENE
AttributeBegin
  Scale 0.2 0.2 0.2
  Rotate -90 1 0 0
  Translate -2.9 -2.2 0
  MakeNamedMedium "hot" "string type" "nanovdb" "string filename" "smoke/smoke.$4.vdb" "rgb sigma_s" [6 6 6]
  Material "interface"
  MediumInterface "hot" ""
  Shape "sphere" "float radius" 9
AttributeEnd
SCENE
}
shot 40 24 16 %04d >shot.pbrt
count() { sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p" out.txt | head -1; }

# ------------------------------------------------------------------------------------- frames are pictures like others
expect 0 "$T" render shot.pbrt --frames 1-8 --reproducible --json --progress line -o 'shots/a.%04d.exr'
[ "$(ls shots | wc -l)" = 8 ] || fail "8 frames are $(ls shots | wc -l) files"
says '"builds": 8' out.txt
# Smoke: a hash and a medium a frame. The map: a size, a hash and a texture, once.
[ "$(sed -n '/"files"/,$s/.*"read": \([0-9]*\).*/\1/p' out.txt)" = 19 ] || fail "19 uses of files are $(sed -n '/"files"/,$p' out.txt)"
[ "$(sed -n '/"files"/,$s/.*"kept": \([0-9]*\).*/\1/p' out.txt)" = 21 ] || fail "21 times not read again are $(sed -n '/"files"/,$p' out.txt)"
says "8 of 8 frames rendered" err.txt
[ "$(grep -c 'frames rendered' err.txt)" = 1 ] || fail "not one summary"
shot 40 24 16 0003 >third.pbrt
expect 0 "$T" render third.pbrt --seed 3 --reproducible --quiet -o third.exr
expect 0 "$T" diff third.exr shots/a.0003.exr
[ "$(tail -c 2000 third.exr | cksum)" = "$(tail -c 2000 shots/a.0003.exr | cksum)" ] || fail "frame 3 is not the picture of its scene with seed 3"
cmp -s shots/a.0001.exr shots/a.0003.exr && fail "frames 1 and 3 have the same noise"
expect 0 "$T" render shot.pbrt --frames 1,3 --seed 5 --reproducible --quiet -o 'shots/s.$F.exr'
cmp shots/s.1.exr shots/s.3.exr || fail "with a seed, frames of the same smoke differ"

# Where the smoke does not change there is one build.
sed 's/%04d/0001/' shot.pbrt >still.pbrt
expect 0 "$T" render still.pbrt --frames 1-3 --reproducible --json --quiet -o 'shots/still.%d.exr'
says '"builds": 1' out.txt
expect 0 "$T" render still.pbrt --seed 2 --reproducible --quiet -o still.exr
cmp still.exr shots/still.2.exr || fail "a frame of a scene that was built for another differs from the picture with its seed"

# Backwards, with steps, one frame twice.
expect 0 "$T" render still.pbrt --frames 5-1x2,3,7 --json --quiet --spp 1 -o 'shots/order.%d.exr'
[ "$(grep '"frame":' out.txt | tr -dc '0-9\n' | tr '\n' ' ')" = "5 3 1 7 " ] || fail "5-1x2,3,7 are $(grep '"frame":' out.txt)"

# ---------------------------------------------------------------------------------------------------- killed, resumed
shot 80 48 48 '$F4' >long.pbrt
expect 0 "$T" render long.pbrt --frames 1-8 --reproducible --quiet -o 'shots/whole.%04d.exr'
for frames in 1 2 3; do  # until as many are there, and some of the next
  interrupted KILL "[ \$(ls shots/b.*.exr | wc -l) -ge $frames ] && ls shots/b.*.checkpoint" \
    "$T" render long.pbrt --frames 1-200 --reproducible --checkpoint 0.02 --resume --progress none -o 'shots/b.%04d.exr'
done
stamp=$(stat -c %Y.%i shots/b.0001.exr)
pending=$(ls shots/b.000[1-8].exr.checkpoint 2>/dev/null | wc -l)
expect 0 "$T" render long.pbrt --frames 1-8 --reproducible --checkpoint 60 --resume --progress none -o 'shots/b.%04d.exr'
says "there before" err.txt
[ "$pending" = 0 ] || says "going on from" err.txt
[ "$(grep -c 'is there already' err.txt)" -ge 1 ] || fail "finished frames were not skipped"
[ "$(stat -c %Y.%i shots/b.0001.exr)" = "$stamp" ] || fail "a finished frame was rendered again"
for frame in 1 2 3 4 5 6 7 8; do
  cmp shots/whole.000$frame.exr shots/b.000$frame.exr || fail "frame $frame of the resumed sequence is not that of the unbroken one"
done
[ ! -e shots/b.0008.exr.checkpoint ] || fail "checkpoints of finished frames are left"
# Of another scene, seed or number of samples a frame is not finished.
expect 0 "$T" render long.pbrt --frames 1-2 --seed 9 --reproducible --resume --progress none -o 'shots/b.%04d.exr'
says "2 of 2 frames rendered" err.txt
cp smoke/smoke.0002.vdb smoke/smoke.0001.vdb
expect 0 "$T" render long.pbrt --frames 1-2 --seed 9 --reproducible --resume --progress none -o 'shots/b.%04d.exr'
says "1 of 2 frames rendered, 1 there before (2)" err.txt
expect 0 "$T" render long.pbrt --frames 1-2 --seed 9 --reproducible --aov Z --resume --progress none -o 'shots/b.%04d.exr'
says "2 of 2 frames rendered" err.txt
# Nor where more samples are asked for beside a limit, where mattes have other names, or where it was relit.
expect 0 "$T" render still.pbrt --frames 1 --time 60 --spp 2 --quiet -o 'shots/c.%d.exr'
expect 0 "$T" render still.pbrt --frames 1 --time 60 --spp 2 --resume --progress none -o 'shots/c.%d.exr'
says "1 there before" err.txt
expect 0 "$T" render still.pbrt --frames 1 --time 60 --spp 4 --resume --progress none -o 'shots/c.%d.exr'
says "1 of 1 frames rendered" err.txt
expect 0 "$T" render still.pbrt --frames 1 --aov CryptoMedium --spp 2 --quiet -o 'shots/m.%d.exr'
expect 0 "$T" render still.pbrt --frames 1 --aov CryptoMedium --spp 2 --resume --progress none -o 'shots/m.%d.exr'
says "1 there before" err.txt
sed 's/"hot"/"warm"/' still.pbrt >warm.pbrt
expect 0 "$T" render warm.pbrt --frames 1 --aov CryptoMedium --spp 2 --resume --progress none -o 'shots/m.%d.exr'
says "1 of 1 frames rendered" err.txt
sed 's/^LightSource .*/& "string lightgroup" "key"/' still.pbrt >groups.pbrt
expect 0 "$T" render groups.pbrt --frames 1 --spp 2 --quiet -o 'shots/g.%d.exr'
expect 0 "$T" relight shots/g.1.exr key=3 -o shots/g.1.exr
expect 0 "$T" render groups.pbrt --frames 1 --spp 2 --resume --progress none -o 'shots/g.%d.exr'
says "1 of 1 frames rendered" err.txt
# A frame that cannot be rendered: those before it are told of, and which one it was.
head -c 300 smoke/smoke.0002.vdb >smoke/broken.0002.vdb
cp smoke/smoke.0003.vdb smoke/broken.0001.vdb && cp smoke/smoke.0003.vdb smoke/broken.0003.vdb
sed 's/smoke\.%04d/broken.%04d/' shot.pbrt >broken.pbrt
expect 3 "$T" render broken.pbrt --frames 1-3 --spp 1 --progress none --json -o 'shots/e.%d.exr'
says "1 of 3 frames rendered" err.txt
says "(frame 2)" err.txt
says '"frame": 1' out.txt
[ -s shots/e.1.exr ] && [ ! -e shots/e.2.exr ] || fail "not frame 1 alone is there"
# Interrupted: what is there stays, and the code says so.
interrupted INT rendering "$T" render long.pbrt --frames 1-8 --time 600 --checkpoint 60 --progress json -o 'shots/i.%d.exr'
[ $code = 130 ] || fail "an interrupted sequence does not exit with 130"
says "stopped early" err.txt
says "not begun" err.txt
[ ! -e shots/i.2.exr ] || fail "a frame was begun after the interrupt"

# ------------------------------------------------------------------------------------------------- what is refused
rm -f smoke/smoke.0007.vdb shots/*
expect 3 "$T" render shot.pbrt --frames 1-8 --quiet -o 'shots/a.%04d.exr'
says 'shot.pbrt:15:' err.txt
says 'file "smoke/smoke.0007.vdb" does not exist' err.txt
[ -z "$(ls shots)" ] || fail "frames were rendered although one lacks its file"
expect 3 "$T" render shot.pbrt --quiet -o shots/a.exr
says "filled by --frames" err.txt
expect 2 "$T" render shot.pbrt --frames 1-3 -o shots/a.exr
says "give -o shots/a.%04d.exr" err.txt
for frames in 1- -5 1-3x0 1-3x a 1,,2 "" 1-99999999; do
  expect 2 "$T" render shot.pbrt "--frames=$frames" -o 'shots/a.%d.exr'
done
says "give frames such as" err.txt
expect 2 "$T" render shot.pbrt --frames 1-3 --reference third.exr --error-log log.jsonl -o 'shots/a.%d.exr'
says "give --error-log log.%04d.jsonl" err.txt
[ -z "$(ls shots)" ] || fail "a refused sequence wrote $(ls shots)"

# ------------------------------------------------------------------------------------------------------------ check
expect 0 "$T" check shot.pbrt --frames 1-3
says "shot.pbrt, frame 3: ok" out.txt
expect 3 "$T" check shot.pbrt --frames 6-8 --json
says "smoke/smoke.0007.vdb" out.txt
says '"frame": 8' out.txt
expect 0 "$T" check still.pbrt --frames 1-100
[ "$(grep -c ': ok' out.txt)" = 1 ] || fail "a scene without a place for the frame was checked more than once"

# ------------------------------------------------------------------------------------------------------- merge, farm
expect 0 "$T" farm slurm shot.pbrt --frames 1,5,6 --spp 64 --slices 4 --no-trial --folder job -o 'shots/f.%04d.exr'
says "3 frames of 4 slices" out.txt
says "#SBATCH --array=1-12" job/render.sbatch
says "#SBATCH --array=1-3" job/merge.sbatch
expect 3 "$T" farm slurm shot.pbrt --frames 5-8 --spp 64 --slices 4 --no-trial --folder job2 -o 'shots/f.%04d.exr'
says "smoke.0007.vdb" err.txt
expect 2 "$T" farm slurm shot.pbrt --frames 5,6 --spp 64 --slices 4 --no-trial --folder job2 -o shots/f.exr
expect 2 "$T" farm slurm still.pbrt --spp 64 --slices 1 --no-trial --folder job2 -o shots/f.exr
rm -rf job
expect 0 "$T" farm parallel shot.pbrt --frames 2,5-6 --spp 32 --slices 2 --no-trial --reproducible --folder job --submit \
  --engine-option=--jobs=2 -o 'shots/f.%04d.exr'
expect 0 "$T" render "$PWD/shot.pbrt" --frames 2,5-6 --spp 32 --reproducible --quiet -o 'shots/one.%04d.exr'
for frame in 2 5 6; do
  cmp shots/one.000$frame.exr shots/f.000$frame.exr || fail "GNU parallel's slices of frame $frame do not add up to it"
done
finish
