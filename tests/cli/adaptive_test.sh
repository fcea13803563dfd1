#!/usr/bin/env bash
# `tyndall render --adaptive` as a user meets it: the same bytes however it is run, numbers of samples in the file, errors in words.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
rm -rf ./*.exr ./*.checkpoint
small_scene >s.pbrt
options="--resolution 96x64 --reproducible --aov Variance,Z"

# An error is reached, with different numbers of samples, by any number of threads with the same bytes.
expect 0 "$T" render s.pbrt $options --error 6e-6 --threads 1 -o one.exr --json
grep -E 'one.exr: 96x64, [0-9]+ spp in work, [0-9]+ to [0-9]+ a pixel$' err.txt >/dev/null || fail "the summary does not tell the numbers: $(cat err.txt)"
grep -E 'estimated relMSE [0-9.e-]+, in the worst part of the picture' err.txt >/dev/null || fail "the summary does not tell the error: $(cat err.txt)"
grep -E '"(least|most)_samples": [0-9]+' out.txt >/dev/null || fail "the summary in JSON does not tell the numbers"
samples=$(sed -nE 's/.*"samples": ([0-9]+),/\1/p' out.txt)
[ "$samples" -gt 48 ] || fail "the test shows nothing: $samples samples a pixel"
expect 0 "$T" render s.pbrt $options --error 6e-6 --threads 3 --adaptive --spp 100000 -o three.exr
expect 0 "$T" diff --exact one.exr three.exr  # but for the limit in the header neither threads nor it change anything
expect 0 "$T" info one.exr
says '  SampleCount' out.txt
grep -E 'tyndall/samples +[0-9]+\.\.[0-9]+$' out.txt >/dev/null || fail "the header does not tell the numbers"
grep -E 'tyndall/options .* --adaptive$' out.txt >/dev/null || fail "the header does not tell that it is adaptive"

# Cut off, and taken up again: the unbroken picture.
interrupted INT "rendering 64" "$T" render s.pbrt $options --error 1e-9 --checkpoint 60 --progress json --json -o cut.exr
[ $code = 130 ] || fail "an interrupted render does not exit with 130: $(cat err.txt)"
half=$(sed -nE 's/.*"estimated": ([0-9.e-]+).*/\1/p' out.txt | awk '{ print $1 / 2 }')
expect 0 "$T" render s.pbrt $options --error "$half" -o whole.exr
expect 0 "$T" render s.pbrt $options --error "$half" --resume -o cut.exr
says 'going on from' err.txt
cmp cut.exr whole.exr || fail "the resumed picture is not the unbroken one"

# An error of the worst part: reached, alone and beside one of the mean; what was decided for it is no other's checkpoint.
worst() { sed -nE 's/.*"worst": ([0-9.e-]+).*/\1/p' "$1"; }
expect 0 "$T" render s.pbrt $options --spp 32 -o first.exr --json
goal=$(worst out.txt | awk '{ printf "%.17g", 2 ^ int(log($1 / 3) / log(2)) }')  # a float in the scene as well
expect 0 "$T" render s.pbrt $options --error-max "$goal" --threads 1 -o worst.exr --json
awk "BEGIN { exit !($(worst out.txt) < $goal) }" || fail "the worst part is above --error-max $goal: $(cat out.txt)"
mean=$(sed -nE 's/.*"estimated": ([0-9.e-]+),.*/\1/p' out.txt | awk '{ print $1 / 1.5 }')
grep -E 'worst.exr: 96x64, [0-9]+ spp in work, [0-9]+ to [0-9]+ a pixel$' err.txt >/dev/null || fail "--error-max is not adaptive: $(cat err.txt)"
expect 0 "$T" render s.pbrt $options --error-max "$goal" --threads 3 -o again.exr
cmp worst.exr again.exr || fail "threads change a picture with --error-max"
expect 0 "$T" render s.pbrt $options --error "$mean" --error-max "$goal" -o both.exr --json
awk "BEGIN { exit !($(worst out.txt) < $goal) }" || fail "--error and --error-max do not both hold: $(cat out.txt)"
sed "s/^Integrator \"volpath\"/& \"float error-max\" $goal/" s.pbrt >goal.pbrt
expect 0 "$T" render goal.pbrt $options --spp 100000 -o said.exr
expect 0 "$T" diff said.exr worst.exr --exact --channels RGB
expect 2 "$T" render s.pbrt --error-max 0 --resolution 8x8
says '--error-max' err.txt
expect 2 "$T" render s.pbrt --error-max 1 --slice 1/2 --spp 64 -o slice.exr
says 'slice 1/2 cannot stop at an error' err.txt
interrupted INT "rendering 64" "$T" render s.pbrt $options --error-max 1e-9 --checkpoint 60 --progress json -o other.exr
expect 3 "$T" render s.pbrt $options --error-max 1e-8 --resume -o other.exr
says '--error-max 1e-09' err.txt

# What cannot be.
expect 2 "$T" render s.pbrt --adaptive --resolution 8x8
says '--adaptive says where samples go, not how many; give --error, --error-max or --time with it' err.txt
expect 2 "$T" render s.pbrt --adaptive --time 1 --slice 1/2 --spp 64 -o slice.exr
says 'slice 1/2 cannot be adaptive' err.txt
expect 2 "$T" farm slurm s.pbrt --spp 64 --slices 4 --no-trial --adaptive -o farm.exr
says "a farm's slices cannot be adaptive" err.txt
sed 's/^Integrator "volpath"/& "bool adaptive" true/' s.pbrt >asks.pbrt
expect 2 "$T" farm slurm asks.pbrt --spp 64 --slices 4 --no-trial -o farm.exr
says 'slice 1/4 cannot be adaptive: where the error is only all slices together tell' err.txt
expect 0 "$T" render s.pbrt $options --adaptive --time 1 -o timed.exr
"$T" info timed.exr | grep -E 'tyndall/samples +[0-9]+(\.\.[0-9]+)?$' >/dev/null || fail "a timed adaptive render does not tell its samples"

# No pixel has more samples than the most.
expect 0 "$T" render s.pbrt $options --error 1e-9 --spp 80 -o most.exr --json
most=$(sed -nE 's/.*"most_samples": ([0-9]+),/\1/p' out.txt)
[ "$most" -le 80 ] || fail "a pixel has $most samples, more than --spp 80"
grep -E '"samples": 80,' out.txt >/dev/null || fail "a render that does not reach its error does not end at --spp: $(cat out.txt)"
expect 0 "$T" render s.pbrt $options --error 1e9 --no-adaptive -o plain.exr
"$T" info plain.exr | grep -E 'tyndall/samples +64$' >/dev/null || fail "--no-adaptive does not end at 64 samples"

# Merged, each pixel weighs as its render does, whatever number of samples it had.
expect 0 "$T" render s.pbrt $options --error 6e-6 --seed 1 -o other.exr
expect 0 "$T" merge one.exr other.exr -o both.exr
expect 0 "$T" info both.exr
mean_count() { "$T" info "$1" | sed -nE '/^  SampleCount/,/values/s/.*mean ([0-9.]+)$/\1/p'; }
awk "BEGIN { d = $(mean_count one.exr) + $(mean_count other.exr) - $(mean_count both.exr); exit !(d * d < 1e-3) }" ||
  fail "samples of merged adaptive renders do not add up"
mean_of() { "$T" info "$1" | sed -nE "/^  $2\$/,/values/s/.*mean ([0-9.]+)\$/\\1/p"; }
weight_one=$(mean_of one.exr SampleWeight) weight_other=$(mean_of other.exr SampleWeight)
awk "BEGIN { d = $weight_one + $weight_other - $(mean_of both.exr SampleWeight); exit !(d * d < 1e-3) }" ||
  fail "weights of merged adaptive renders do not add up"
awk "BEGIN { d = ($weight_one * $(mean_of one.exr G) + $weight_other * $(mean_of other.exr G)) / ($weight_one + $weight_other) - $(mean_of both.exr G)
  exit !(d * d < 1e-9) }" || fail "merged adaptive renders are not weighed by their weights"
expect 3 "$T" merge one.exr three.exr -o twice.exr
says 'the same samples would count twice' err.txt
finish
