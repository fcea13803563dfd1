# `tyndall compare`, and what render shares with it: --error, --reference, --error-log.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
small_scene >s.pbrt
small="--resolution 24x16 --spp 16 --reference-error 0.003"

# Every preset, each with the strategies that exist.
expect 0 "$T" compare s.pbrt --variants lights $small -o report
for file in index.html results.json error.csv reference.exr uniform.exr tree-binary.exr; do [ -s report/$file ] || fail "no report/$file"; done
for key in scene reference machine variants name options samples seconds relmse slope efficiency efficiency_trimmed relative low high mean_rgb checkpoints mse work paths shadow_rays error_parts SurfaceIndirect; do
  says "\"$key\"" report/results.json
done
for name in uniform power exhaustive tree tree-binary cycles-rule lightcuts cells; do says "\"name\": \"$name\"" report/results.json; done
says 'variant,seconds,samples,mse' report/error.csv
[ "$(grep -c '^power,' report/error.csv)" = 5 ] || fail "error.csv has no point at 1, 2, 4, 8, 16 samples"
says 'tree-binary' out.txt
for preset in media distance transmittance techniques all; do
  expect 0 "$T" compare s.pbrt --variants $preset --resolution 8x8 --spp 4 --reference-time 0.2 -o preset --quiet
done
says '"name": "ratio"' preset/results.json
says '"name": "power"' preset/results.json

# Samples where the error is, where a variant asks for it and not where the scene does; with the samples of each pixel.
sed 's/^Integrator "volpath"/& "bool adaptive" true/' s.pbrt >asks.pbrt
expect 0 "$T" compare asks.pbrt --variants "adaptive,own:--adaptive --lights power" --resolution 72x48 --spp 96 --reference-error 0.003 -o where
for name in 'not adaptive' adaptive own; do says "\"name\": \"$name\"" where/results.json; done
awk '/"name"/ { name = $0 } /"(least|most)_samples"/ { gsub(/[^0-9]/, ""); n[name] = n[name] " " $0 }
  END { for (v in n) { split(n[v], r, " "); if ((v ~ /not adaptive/) != (r[1] == r[2])) { print v n[v]; exit 1 } } }' where/results.json ||
  fail "samples differ where nobody asked, or do not where somebody did"
[ "$(grep -o 'data-name="[a-z ]*" data-kind="samples"' where/index.html)" = 'data-name="adaptive samples" data-kind="samples"
data-name="own samples" data-kind="samples"' ] || fail "the page does not show the samples of each pixel"
"$T" info where/adaptive.exr >info.txt
says '  SampleCount' info.txt
"$T" info where/not_adaptive.exr >info.txt
grep -q '  SampleCount' info.txt && fail "a picture with as many samples everywhere holds numbers of them"

# Explicit variants; options for all; equal time; a reference that is given.
expect 0 "$T" render s.pbrt --resolution 24x16 --spp 256 --seed 77 --max-depth 1 --aov Variance -o ref.exr --quiet
expect 0 "$T" compare s.pbrt --variants "base:--lights power, sharp one:--lights tree-binary --transmittance ratio" --time 0.2 \
  --resolution 24x16 --max-depth 1 --reference ref.exr --json -o timed
says '"name": "sharp one"' out.txt
says '"options": "--lights tree-binary --transmittance ratio"' out.txt
says '"options": "--resolution 24x16 --max-depth 1"' out.txt
says '"noise_subtracted": true' out.txt
says '"budget": "0.2 s"' out.txt
[ -s timed/sharp_one.exr ] || fail "no picture of a variant with a blank in its name"
[ "$(head -c 1 out.txt)" = "{" ] || fail "stdout does not start with JSON"

# The command that the report states can be pasted into a shell, whatever is in it.
expect 0 "$T" compare s.pbrt --variants "it's:--lights power" --resolution 8x8 --spp 2 --reference-time 0.1 --json -o 'a # ~b'
sed -n 's/^ *"command": \(".*"\),*$/\1/p' out.txt | sed 's/\\\\/\\/g; s/^"//; s/"$//' >command.txt
(eval "set -- $(cat command.txt)"; [ "$1 $5" = "tyndall it's:--lights power" ] && [ "${14}" = 'a # ~b' ]) ||
  fail "cannot be pasted: $(cat command.txt)"

# Usage errors say what is known.
expect 2 "$T" compare s.pbrt --variants lamps -o r
says 'lights, media, distance, emission, guiding, joint, reuse, budget, transmittance, all, adaptive' err.txt
expect 2 "$T" compare s.pbrt --variants "a:--max-depth 2" -o r
says 'give it to compare itself' err.txt
expect 2 "$T" compare s.pbrt --variants "a:--lights magic" -o r
says 'tree-binary' err.txt
expect 2 "$T" compare s.pbrt --variants "a:--lights power,a:--lights uniform" -o r
expect 2 "$T" compare s.pbrt --spp 4 --time 1 -o r
expect 2 "$T" compare s.pbrt --seeds 2 -o r
expect 2 "$T" compare s.pbrt --variants "reference:--lights power" -o r
expect 2 "$T" compare s.pbrt --variants "a b:--lights power,A_b:--lights uniform" -o r
says 'share the file' err.txt
expect 2 "$T" compare s.pbrt --time nan -o r
expect 2 "$T" compare s.pbrt --reference-time nan -o r

# A reference must fit: size, place, scene, other samples, sound values.
expect 3 "$T" compare s.pbrt --variants lights --reference ref.exr --spp 2 -o r
says '0,24,0,16' err.txt
expect 3 "$T" compare s.pbrt --resolution 24x16 --reference ref.exr --spp 2 -o r
says 'of another scene' err.txt
expect 3 "$T" compare s.pbrt --resolution 24x16 --max-depth 1 --reference ref.exr --spp 2 --seed 74 -o r
says 'seed 77' err.txt
expect 0 "$T" render s.pbrt --crop 0,20,0,24 -o left.exr --quiet
expect 3 "$T" compare s.pbrt --crop 20,40,0,24 --reference left.exr --spp 2 -o r

# Given up: nothing to compare with. Stopped: no report, or one of the seeds that are complete.
expect 7 "$T" compare s.pbrt --time 1e-7 --reference-time 0.1 -o hurried
says 'given up' out.txt
interrupted INT 'grep -q variants err.txt' "$T" compare s.pbrt --spp 1000000 --reference-time 0.2 --progress json -o stopped
[ $code = 130 ] || fail "an interrupted compare does not exit with 130"
[ -e stopped ] && fail "an interrupted compare leaves an empty folder"
expect 3 "$T" compare absent.pbrt -o r
expect 3 "$T" compare s.pbrt --reference absent.exr --resolution 24x16 -o r
echo file >occupied
expect 4 "$T" compare s.pbrt $small -o occupied

# render: an error goal ends after 32 samples at the earliest, without decisions at a power of two from 64 on; the log has the same
# checkpoints as compare.
expect 0 "$T" render s.pbrt --resolution 24x16 --error 1000 --json -o goal.exr
says '"samples": 32' out.txt
expect 0 "$T" render s.pbrt --resolution 24x16 --error 1000 --no-adaptive --json -o goal.exr
says '"samples": 64' out.txt
expect 0 "$T" render s.pbrt --resolution 24x16 --max-depth 1 --spp 20 --reference ref.exr --error-log log.jsonl -o logged.exr
[ "$(grep -c relmse_trimmed log.jsonl)" = 6 ] || fail "not a line at 1, 2, 4, 8, 16 and 20 samples: $(cat log.jsonl)"
says '"samples":20' log.jsonl
expect 0 "$T" render s.pbrt --resolution 24x16 --max-depth 1 --spp 20 --reproducible -o plain.exr
expect 0 "$T" render s.pbrt --resolution 24x16 --max-depth 1 --spp 20 --reproducible --reference ref.exr --error-log log.jsonl -o logged.exr
cmp plain.exr logged.exr || fail "--error-log changes the picture"
expect 2 "$T" render s.pbrt --reference ref.exr -o a.exr
expect 2 "$T" render s.pbrt --error 0 -o a.exr
expect 3 "$T" render s.pbrt --reference ref.exr --error-log log.jsonl -o a.exr
expect 3 "$T" render s.pbrt --resolution 24x16 --max-depth 1 --seed 77 --reference ref.exr --error-log log.jsonl -o a.exr
expect 4 "$T" render s.pbrt --reference ref.exr --error-log nowhere/log.jsonl -o a.exr
# Each variant a second time, denoised.
expect 0 "$T" compare s.pbrt --variants "a:--lights power" --spp 4 --denoise --quiet -o denoised
grep -q '^a denoised,' denoised/error.csv || fail "no denoised variant in $(cat denoised/error.csv)"
says '"as_rendered": "a"' denoised/results.json
grep -q '"as_rendered"' timed/results.json && fail "as_rendered without --denoise"
# What it states of its errors, held against the reference; the picture as rendered states nothing.
[ "$(grep -c true_over_stated_trimmed denoised/results.json)" = 1 ] || fail "no stated errors, or of both, in results.json"
says '"within_two": 0.9' denoised/results.json
[ -s denoised/a_denoised.exr ] || fail "no denoised picture"
expect 2 "$T" compare s.pbrt --spp 1 --denoise -o x
says 'give --spp 2 or more' err.txt
expect 2 "$T" compare s.pbrt --variants "a:--lights power,A denoised:--lights uniform" --denoise -o x
says 'share the file' err.txt

finish
