#!/usr/bin/env bash
# Mattes as a user meets them: asked for, listed, taken out, sliced, resumed, cropped, merged, and what cannot be.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
{
  lit_floor 40 24 4
  ball_of '"string type" "homogeneous"'
  echo 'MakeNamedMaterial "clay" "string type" "diffuse"'
  echo 'AttributeBegin Translate 0.9 0.3 0.4 NamedMaterial "clay" Shape "sphere" "string name" "pot" "float radius" 0.3 AttributeEnd'
} >s.pbrt
render() { "$T" render "$@" --reproducible --quiet || fail "render $*"; }
layers=(CryptoObject CryptoMaterial CryptoMedium)
crypto=$(for layer in "${layers[@]}"; do for n in 00 01 02; do for c in R G B A; do printf '%s%s.%s,' "$layer" "$n" "$c"; done; done; done)
same_mattes() { "$T" diff "$1" "$2" --exact --no-flip --channels "${crypto%,}" >diff.txt 2>&1 || fail "$3: $(head -c 400 diff.txt)"; }
mean_of() { "$T" matte "$1" | awk -v layer="$2" -v name="$3" '$1 == layer && $2 == name { print $4 }'; }
near() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > b * 0.98 && a < b * 1.02) }'; }

render s.pbrt --aov Cryptomatte -o all.exr
[ "$("$T" info all.exr | grep -cE '^ +Crypto(Object|Material|Medium)0[012]\.[RGBA]')" = 36 ] || fail "channels: $("$T" info all.exr | grep Crypto)"
"$T" info all.exr | grep -E 'cryptomatte/[0-9a-f]{7}/conversion +uint32_to_float32$' >/dev/null || fail "no conversion in the header"
"$T" info all.exr | grep -E 'cryptomatte/[0-9a-f]{7}/manifest +\{.*"pot":"[0-9a-f]{8}"' >/dev/null || fail "no manifest in the header"
expect 0 "$T" matte all.exr
says 'pot' out.txt
says 'clay' out.txt
grep -E '^CryptoMedium +m +[0-9a-f]{8} +0\.[0-9]+$' out.txt >/dev/null || fail "the list does not tell how much the smoke covers"
expect 0 "$T" matte all.exr --layer CryptoMedium
[ "$(wc -l <out.txt)" = 1 ] || fail "a layer alone is not listed alone"
expect 0 "$T" matte all.exr pot -o pot.exr
expect 0 "$T" matte all.exr pot shape.1 -o both.png
expect 0 "$T" matte all.exr m --layer CryptoMedium -o smoke.exr
expect 2 "$T" matte all.exr pott -o none.exr
says 'it has' err.txt
says 'pot' err.txt
expect 2 "$T" matte all.exr pot
expect 2 "$T" matte all.exr pot --layer CryptoMedium -o none.exr
[ ! -e none.exr ] || fail "a matte of nobody was written"

# The picture does not know of them, and no thread matters.
render s.pbrt -o plain.exr
"$T" diff all.exr plain.exr --exact --no-flip --channels R,G,B,A >diff.txt 2>&1 || fail "mattes change the picture: $(cat diff.txt)"
expect 3 "$T" matte plain.exr
says 'has no mattes; render it with --aov Cryptomatte' err.txt
render s.pbrt --aov Cryptomatte --threads 1 -o one.exr
cmp all.exr one.exr || fail "mattes depend on the number of threads"

# Slices, and a render that was interrupted, are the whole, byte for byte.
parts=(--spp 48 --aov Cryptomatte,Albedo)
render s.pbrt "${parts[@]}" -o whole.exr
for i in 1 2 3; do render s.pbrt "${parts[@]}" --slice $i/3 -o slice$i.exr; done
expect 0 "$T" merge slice2.exr slice1.exr slice3.exr -o joined.exr
cmp whole.exr joined.exr || fail "three slices are not the whole"
expect 0 "$T" render s.pbrt "${parts[@]}" --slice 1/3 -o slice1.exr --reproducible --resume
says 'this slice is there already' err.txt
sed 's/"pot"/"vase"/' s.pbrt >other.pbrt
expect 0 "$T" render other.pbrt "${parts[@]}" --slice 1/3 -o slice1.exr --reproducible --resume --progress none
! grep -q 'this slice is there already' err.txt || fail "a slice with other names was taken for this one"
expect 3 "$T" merge slice1.exr slice2.exr -o no.exr
says 'has other names' err.txt
broken_off broken.exr s.pbrt --aov Cryptomatte
more=$(($(samples_of broken.exr) + 3))
expect 3 "$T" render other.pbrt --spp $more --aov Cryptomatte -o broken.exr --resume --quiet
says 'is of another set of matte names' err.txt
render s.pbrt --spp $more --aov Cryptomatte -o straight.exr
render s.pbrt --spp $more --aov Cryptomatte -o broken.exr --resume
cmp straight.exr broken.exr || fail "a resumed render has other mattes"

# Crops make the whole, seeds the mean.
render s.pbrt --aov Cryptomatte --crop 0,17,0,24 -o left.exr
render s.pbrt --aov Cryptomatte --crop 17,40,0,24 -o right.exr
expect 0 "$T" merge left.exr right.exr -o crops.exr
same_mattes crops.exr all.exr "two crops are not the whole"
for seed in 1 2; do render s.pbrt --seed $seed --aov Cryptomatte -o seed$seed.exr; done
expect 0 "$T" merge seed1.exr seed2.exr -o seeds.exr
expect 0 "$T" merge seed2.exr seed1.exr -o sdees.exr
cmp seeds.exr sdees.exr || fail "the order of seeds matters"
for name in "CryptoObject pot" "CryptoMedium m" "CryptoMaterial clay"; do
  # shellcheck disable=SC2086
  set -- $name
  mean=$(awk -v a="$(mean_of seed1.exr "$1" "$2")" -v b="$(mean_of seed2.exr "$1" "$2")" 'BEGIN { print (a + b) / 2 }')
  near "$(mean_of seeds.exr "$1" "$2")" "$mean" || fail "$2 of two seeds covers $(mean_of seeds.exr "$1" "$2"), not $mean"
done

# Where pixels differ in their samples, in frames, and beside halves and parts.
render s.pbrt --aov Cryptomatte --error 0.02 --spp 256 -o adaptive.exr
near "$(mean_of adaptive.exr CryptoObject pot)" "$(mean_of whole.exr CryptoObject pot)" || fail "adaptive: pot covers $(mean_of adaptive.exr CryptoObject pot)"
render s.pbrt --aov Cryptomatte --frames 1-2 -o f%d.exr
expect 0 "$T" render s.pbrt --aov Cryptomatte --frames 1-2 -o f%d.exr --resume --reproducible --progress none
[ "$(grep -c 'is there already' err.txt)" = 2 ] || fail "frames that are there are rendered again: $(cat err.txt)"
render s.pbrt --aov Cryptomatte --half --parts -o half.exr
"$T" diff half.exr all.exr --exact --no-flip --channels CryptoObject00.R,CryptoObject00.G >diff.txt 2>&1 || fail "halves: $(cat diff.txt)"
expect 0 "$T" matte half.exr pot -o pot_of_half.exr
cmp pot.exr pot_of_half.exr || fail "the matte of an image of parts is another one"
expect 2 "$T" render s.pbrt --aov Cryptomatte --compression dwaa -o none.exr
says 'mattes are ids, which lossy --compression would change' err.txt
expect 0 "$T" render s.pbrt --aov CryptoObject,Denoise --spp 8 --denoise --quiet -o denoised.exr
expect 0 "$T" matte denoised.exr pot -o pot_of_denoised.exr
render s.pbrt --aov CryptoObject,Denoise --spp 8 -o noisy.exr
expect 2 "$T" denoise noisy.exr --quiet --compression dwaa -o none.exr
says 'has mattes' err.txt
[ ! -e none.exr ] || fail "ids were packed with loss"

sed 's/"string name" "pot"/"string name" ""/' s.pbrt >nameless.pbrt
expect 3 "$T" render nameless.pbrt -o none.exr
grep -E 'nameless.pbrt:[0-9]+:[0-9]+: .*the name is empty; name the object, or leave it out' err.txt >/dev/null || fail "an empty name: $(cat err.txt)"
finish
