#!/usr/bin/env bash
# Light groups as a user meets them: rendered, sliced, resumed, cropped, denoised, and mixed anew by `tyndall relight`.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
{
  lit_floor 40 24 4
  ball_of '"string type" "homogeneous" "rgb Le" [0.5 0.2 0.1] "string lightgroup" "fire"'
  echo 'LightSource "infinite" "rgb L" [0.1 0.1 0.2] "string lightgroup" "sky"'
} >s.pbrt
render() { "$T" render "$@" --reproducible --quiet || fail "render $*"; }
channels_of() { "$T" info "$1" | grep -oE '^ +(Variance\.|Replicate\.)?LightGroup\.[^ ]+' | tr -d ' ' | tr '\n' ' '; }

# The light of the floor's scene has no group: it is in the one that collects what has none.
render s.pbrt -o all.exr
[ "$(channels_of all.exr)" = 'LightGroup.default.B LightGroup.default.G LightGroup.default.R LightGroup.fire.B LightGroup.fire.G LightGroup.fire.R LightGroup.sky.B LightGroup.sky.G LightGroup.sky.R ' ] ||
  fail "channels: $(channels_of all.exr)"
"$T" info all.exr | grep -E 'tyndall/lightGroups +fire,sky,default$' >/dev/null || fail "the header does not name the groups"
render s.pbrt -o few.exr --aov Variance
[ "$(channels_of few.exr | wc -w)" = 18 ] || fail "variance: $(channels_of few.exr)"

# The picture does not know of groups.
sed 's/"string lightgroup" "[a-z]*"//' s.pbrt >plain.pbrt
render plain.pbrt -o plain.exr
"$T" diff all.exr plain.exr --exact --channels R,G,B,A >diff.txt 2>&1 || fail "groups change the picture: $(cat diff.txt)"
[ -z "$(channels_of plain.exr)" ] || fail "groups where the scene has none"

# Slices, and a render that was interrupted, are the whole, byte for byte.
parts=(--spp 48 --aov Variance,Replicate)
render s.pbrt "${parts[@]}" -o whole.exr
for i in 1 2 3; do render s.pbrt "${parts[@]}" --slice $i/3 -o slice$i.exr; done
expect 0 "$T" merge slice2.exr slice1.exr slice3.exr -o joined.exr
cmp whole.exr joined.exr || fail "three slices are not the whole"
expect 3 "$T" relight slice1.exr -o no.exr
says 'is a slice of a render; merge all slices first' err.txt
broken_off broken.exr s.pbrt
more=$(($(samples_of broken.exr) + 3))
sed 's/"sky"/"dome"/' s.pbrt >other.pbrt
expect 3 "$T" render other.pbrt --spp $more -o broken.exr --resume --quiet
says 'is of another scene' err.txt
render s.pbrt --spp $more -o straight.exr
render s.pbrt --spp $more -o broken.exr --resume
cmp straight.exr broken.exr || fail "a resumed render has other groups"
# Crops and seeds.
render s.pbrt --crop 0,17,0,24 -o left.exr
render s.pbrt --crop 17,40,0,24 -o right.exr
expect 0 "$T" merge left.exr right.exr -o crops.exr
"$T" diff crops.exr all.exr --exact --channels LightGroup.sky.R,LightGroup.fire.G,LightGroup.default.B >diff.txt 2>&1 ||
  fail "two crops are not the whole: $(cat diff.txt)"
for seed in 1 2; do render s.pbrt --seed $seed --aov Variance -o seed$seed.exr; done
expect 0 "$T" merge seed1.exr seed2.exr -o seeds.exr
[ "$(channels_of seeds.exr | wc -w)" = 18 ] || fail "merged: $(channels_of seeds.exr)"
render s.pbrt --threads 1 -o one.exr
cmp all.exr one.exr || fail "groups depend on the number of threads"
expect 0 "$T" relight seeds.exr sky=0 fire=0 default=3 -o third.exr
expect 0 "$T" relight seeds.exr sky=0 fire=0 default=1 -o first.exr
# Of one group alone the variance is known: nine times as much.
variance() { "$T" info "$1" | grep -A2 -E '^ +Variance\.R' | sed -nE 's/.*mean ([^ ,]+).*/\1/p'; }
awk -v a="$(variance third.exr)" -v b="$(variance first.exr)" 'BEGIN { exit !(a > 0 && a / b > 8.99 && a / b < 9.01) }' ||
  fail "the variance of a group is $(variance third.exr), of a third of it $(variance first.exr)"

# Mixed anew: the same as a render whose light has another strength, to the noise that both share.
expect 0 "$T" relight whole.exr sky=0 default=0 -o fire.exr
says 'default=0,0,0 fire=1,1,1 sky=0,0,0' err.txt
"$T" info fire.exr | grep -E 'tyndall/relight +default=0,0,0 fire=1,1,1 sky=0,0,0$' >/dev/null || fail "the header does not tell the factors"
sed '/LightSource "infinite"/d; s/"rgb I" \[9 9 9\]/"rgb I" [0 0 0]/' s.pbrt >fire.pbrt
render fire.pbrt "${parts[@]}" -o fire_alone.exr
expect 0 "$T" diff fire.exr fire_alone.exr --test --channels RGB
expect 0 "$T" relight whole.exr -o same.exr --quiet
[ -s err.txt ] && fail "--quiet is not quiet: $(cat err.txt)"
"$T" diff same.exr whole.exr --exact >diff.txt 2>&1 || fail "no factor changes the picture: $(cat diff.txt)"
expect 0 "$T" relight whole.exr sky=2,1,0.5 -o evening.png
[ -s evening.png ] || fail "no .png"
render s.pbrt --aov SurfaceDirect,Albedo -o split.exr
expect 0 "$T" relight split.exr sky=2 -o mixed.exr
says 'SurfaceDirect is left out, since it is not known by light groups' err.txt
"$T" info mixed.exr | grep -q 'Albedo.R' || fail "what is no light is left out"
expect 3 "$T" merge mixed.exr split.exr -o no.exr
says 'its light groups are mixed otherwise than in' err.txt

# What cannot be.
expect 2 "$T" relight whole.exr sun=2 -o no.exr
says 'whole.exr has no light group "sun"; it has default, fire, sky' err.txt
expect 2 "$T" relight whole.exr sky -o no.exr
says '"sky" is no factor of a light group; give NAME=FACTOR or NAME=R,G,B, as key=1.5' err.txt
expect 2 "$T" relight whole.exr sky=2 sky=3 -o no.exr
expect 2 "$T" relight whole.exr sky=2 -o no.tif
expect 3 "$T" relight plain.exr sky=2 -o no.exr
says 'plain.exr: has no light groups' err.txt
expect 3 "$T" relight missing.exr sky=2 -o no.exr
expect 4 "$T" relight whole.exr sky=2 -o missing/no.exr
[ -e no.exr ] && fail "something was written"
expect 2 "$T" render s.pbrt --light-group 'key=lamp.*' -o no.exr
says 'lights have no names' err.txt
echo 'WorldBegin LightSource "point" "string lightgroup" "a.b"' >bad.pbrt
expect 3 "$T" render bad.pbrt -o no.exr
says 'bad.pbrt:1:32: light group "a.b" cannot name channels of an image' err.txt

# Denoised: groups as well, to the sum of what is left.
expect 0 "$T" render s.pbrt --spp 16 --denoise -o clean.exr --reproducible --quiet
[ "$(channels_of clean.exr | wc -w)" = 9 ] || fail "denoised: $(channels_of clean.exr)"
expect 0 "$T" relight clean.exr sky=0.5 -o dusk.exr
says 'noisy is left out' err.txt
expect 3 "$T" denoise dusk.exr -o no.exr
says 'is denoised already' err.txt
render s.pbrt --spp 16 --aov Denoise -o raw.exr
expect 0 "$T" relight raw.exr sky=0.5 -o dim.exr
expect 0 "$T" denoise dim.exr -o dim_clean.exr
finish
