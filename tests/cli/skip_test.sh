# What a scene does not need is not executed: callgrind lists every function of a render, the libraries of the build say
# whose they are. Each case that must be absent has one beside it in which it is there.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
libraries=$(dirname "$TYNDALL_BIN")/src
command -v valgrind >/dev/null || { echo "FAILED: valgrind is not installed; install the package of that name"; exit 1; }

# functions_of MODULE: its own, not those of headers, which any module may hold a copy of.
functions_of() {
  nm -C --defined-only "$libraries/libtyndall_$1.a" 2>nm.err | awk '$2 ~ /^[Tt]$/ { sub(/^[^ ]+ [Tt] /, ""); print }' |
    grep 'tyndall::' | grep -v '^_GLOBAL_' | LC_ALL=C sort -u
}
functions_of volume >volume.txt
[ -s volume.txt ] || fail "no functions of src/volume in $libraries"

# ran NAME: what rendering NAME.pbrt executes goes to NAME.txt.
ran() {
  valgrind --tool=callgrind --callgrind-out-file=$1.cg "$TYNDALL_BIN" render $1.pbrt -o $1.exr --threads 1 --quiet >$1.out 2>&1 ||
    fail "$1.pbrt under callgrind: $(tail -3 $1.out)"
  grep -oE '^c?fn=\([0-9]+\) .*' $1.cg | sed -E "s/^c?fn=\([0-9]+\) //; s/'[0-9]+$//" | LC_ALL=C sort -u >$1.txt
  [ "$(grep -c 'tyndall::' $1.txt)" -gt 50 ] || fail "$1: callgrind names too few functions of Tyndall; is the program stripped?"
}
of_volume() { LC_ALL=C comm -12 volume.txt $1.txt; }  # its functions that ran
absent() { [ -z "$1" ] || fail "$2: $(echo "$1" | head -3)"; }
present() { [ -n "$1" ] || fail "nothing to compare with: $2"; }

# scene PARAMETERS: with a ball of the medium that they say; without any, the floor alone.
scene() { lit_floor 8 6 2; [ -z "$1" ] || ball_of "$1"; }
grid='"string type" "uniformgrid" "point3 p0" [-0.5 -0.5 -0.5] "point3 p1" [0.5 0.5 0.5] "integer nx" 2 "integer ny" 2 "integer nz" 2'
scene "" >bare.pbrt
scene '"string type" "homogeneous"' >fog.pbrt
scene "$grid \"float density\" [1 2 3 4 5 6 7 8]" >smoke.pbrt
scene "$grid \"float density\" [1 2 3 4 5 6 7 8] \"float temperature\" [900 900 2000 900 900 900 900 900]" >fire.pbrt
{ scene ""; echo 'LightSource "point" "point3 from" [0 2 0] "rgb I" [1 1 1]'; } >two.pbrt
{ scene '"string type" "homogeneous"'; echo 'LightSource "point" "point3 from" [0 0.6 0] "rgb I" [1 1 1]'; } >within.pbrt
{ scene ""; echo 'AttributeBegin Translate 0 0.6 0 AreaLightSource "diffuse" "rgb L" [9 9 9] Shape "sphere" "float radius" 0.05 AttributeEnd'; } >bulb.pbrt
for name in bare two fog smoke fire within bulb; do ran $name; done

absent "$(of_volume bare)" "a scene without media executes"
present "$(of_volume fog)" "a scene with fog executes nothing of src/volume"

tree='LightTree|WideSelector|TreeSelector|WideNode|wide_cut|CutBuilder|child_importance'
absent "$(grep -E "$tree" bare.txt fog.txt smoke.txt)" "one light is sought in a tree"
present "$(grep -E "$tree" two.txt)" "two lights are not sought in a tree"

tracking='with_walk|MediumWalk|MergedWalk|BrickReader|GridRay|BrickGrid::lookup'
absent "$(grep -E "$tracking" fog.txt)" "homogeneous media are tracked"
present "$(grep -E "$tracking" smoke.txt)" "a grid is not tracked"

joint='aim_near|joint_estimate'
absent "$(grep -E "$joint" bare.txt two.txt fog.txt smoke.txt)" "rays are drawn near point lights that no medium holds"
present "$(grep -E 'tyndall::joint_estimate' within.txt)" "collisions are not drawn near a point light in fog"
present "$(grep -E 'tyndall::camera_joint_estimate' within.txt)" "film positions are not drawn near a point light in fog"

emitters='visible_emitters|tyndall::image_of'
absent "$(grep -E "$emitters" two.txt fog.txt smoke.txt within.txt)" "emitters are aimed at where there are none"
present "$(grep -E "$emitters" bulb.txt)" "a small emitter that is seen is not aimed at"

emission='EmissionField::at|BlackbodyTable|blackbody|emission_and_transmittance'
absent "$(of_volume smoke | grep -E "$emission")" "smoke that does not emit is asked for its emission"
present "$(of_volume fire | grep -E "$emission")" "hot smoke is not asked for its emission"
finish
