#!/usr/bin/env bash
# `tyndall status` as a user meets it: slices of every state, told from their files alone.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf slices other && mkdir slices other
small_scene >s.pbrt
render() { "$T" render s.pbrt --spp 96 --quiet "$@" || fail "render $*"; }

# state NUMBER WORD SAMPLES: what is said of a slice.
state() { grep -E "^ +$1 +$2 +$3( |\$)" out.txt >/dev/null || fail "slice $1 is not $2 with $3: $(cat out.txt)"; }

expect 3 "$T" status slices
says 'slices: holds no slice and no checkpoint of one' err.txt
expect 3 "$T" status nowhere
says 'nowhere: cannot be read' err.txt
expect 2 "$T" status

# Slice 1 is there; 2 runs; 3 was killed an hour ago; 4 has not begun.
render --slice 1/4 -o slices/1.exr
sed 's/xresolution" 40/xresolution" 640/; s/yresolution" 24/yresolution" 360/' s.pbrt >large.pbrt
checkpoint_of() {
  interrupted KILL "test -s slices/$1.exr.checkpoint" \
    "$T" render large.pbrt --spp 1000000 --slice "$1/4" --quiet --checkpoint 0.1 -o "slices/$1.exr"
}
mv slices/1.exr other/
for i in 2 3; do checkpoint_of $i; done
expect 7 "$T" status slices
state 2 running '[0-9]+ of 250000'
state 1 missing '0 of 250000'
touch -d '1 hour ago' slices/3.exr.checkpoint
expect 7 "$T" status slices
state 3 lost '[0-9]+ of 250000'
says 'there 0, running 1, lost 1, missing 2; 0 samples a pixel can be merged' out.txt
says 'what runs takes about' out.txt
expect 7 "$T" status slices --lost-after 100000
state 3 running '[0-9]+ of 250000'
cp other/1.exr slices/1.exr
expect 7 "$T" status slices
says 'is a slice of another render' err.txt
render --slice 2/4 --seed 1 -o other/2.exr
mkdir -p seeds && cp other/1.exr other/2.exr seeds/
expect 7 "$T" status seeds
says '2.exr: is a slice of another render' err.txt
# A damaged checkpoint is named, and the rest is told.
head -c 5000 slices/3.exr.checkpoint >slices/cut && mv slices/cut slices/3.exr.checkpoint
expect 7 "$T" status slices
says 'slices/3.exr.checkpoint: is a damaged checkpoint' err.txt

# All are there.
rm -rf slices/* && for i in 1 2 3 4; do render --slice $i/4 -o slices/$i.exr; done
expect 0 "$T" status slices --error
state 4 there '16 of 16'
state 1 there '32 of 32'
says 'there 4, running 0, lost 0, missing 0; 96 samples a pixel can be merged' out.txt
says 'estimated relMSE of what is there: ' out.txt
finish
