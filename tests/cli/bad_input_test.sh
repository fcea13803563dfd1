# Files that are missing, empty, cut off, folders, of another kind or without rights: exit code 3, at most three lines that
# name the file, soon. And scenes that would not fit into memory.
. "$TYNDALL_SOURCE_DIR/tests/cli/support.bash"
T=$TYNDALL_BIN
U=$TYNDALL_SOURCE_DIR/tests
rm -rf ./* && mkdir folder
small_scene >good.pbrt
"$T" render good.pbrt --quiet -o good.exr
"$T" render good.pbrt --quiet -o good.png
cp "$U/data/pointgrid.vdb" good.vdb
cp "$U/data/ball_fp4_zip.nvdb" good.nvdb
cp "$U/unit/io/data/halves.jpg" good.jpg
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >good.ply

# A scene that uses the file of each kind.
scene_with() {
  echo 'Film "rgb" "integer xresolution" 4 "integer yresolution" 4 WorldBegin'
  case $1 in
    *.exr | *.png | *.jpg) echo "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"$1\" Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"" ;;
    *.vdb | *.nvdb) echo "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"$1\" MediumInterface \"m\" \"\" Shape \"sphere\"" ;;
    *.ply) echo "Shape \"plymesh\" \"string filename\" \"$1\"" ;;
    *.pbrt) echo "Include \"$1\"" ;;
  esac
}

# refused FILE WHY: by render, through a scene, and by info.
refused() {
  scene_with "$1" >uses.pbrt
  local start=$SECONDS
  expect 3 "$T" render uses.pbrt --spp 1 --quiet -o none.exr
  says "$1" err.txt
  [ "$(wc -l <err.txt)" -le 3 ] || fail "$2 $1: more than three lines"
  [ $((SECONDS - start)) -le 10 ] || fail "$2 $1 took $((SECONDS - start)) s"
  case $1 in *.ply) return ;; esac  # not described
  expect 3 "$T" info "$1"
  says "$1" err.txt
  [ "$(wc -l <err.txt)" -le 3 ] || fail "$2 $1, described: more than three lines"
}

for kind in pbrt exr png jpg vdb nvdb ply; do
  refused missing.$kind missing
  : >empty.$kind
  [ $kind = pbrt ] || refused empty.$kind empty  # nothing may be included
  head -c $(($(stat -c %s good.$kind) * 2 / 3)) good.$kind >cut.$kind
  [ $kind = pbrt ] || refused cut.$kind "cut off"
  mkdir folder.$kind
  refused folder.$kind "a folder named"
  head -c 3000 "$T" >foreign.$kind
  refused foreign.$kind foreign
  if [ "$(id -u)" != 0 ]; then
    cp good.$kind closed.$kind && chmod 000 closed.$kind
    refused closed.$kind closed
  fi
done
cp "$U/unit/io/data/deep.exr" .
refused deep.exr deep
ln -s /dev/zero endless.exr
refused endless.exr "a device"

# Memory: what cannot fit is refused with the estimate, before anything is built.
expect 3 "$T" render good.pbrt --quiet --max-memory 0.001 -o none.exr
says 'estimated to need' err.txt
expect 3 "$T" render good.pbrt --quiet --resolution 65536x65536 --max-memory 4 -o none.exr
says 'film' err.txt
expect 3 "$T" compare good.pbrt --quiet --max-memory 0.001 -o report
says 'estimated to need' err.txt
scene_with "$TYNDALL_SOURCE_DIR/volumes/plume_hall/plume.vdb" >volume.pbrt
expect 0 "$T" render volume.pbrt --quiet --spp 1 --max-memory 1 -o none.exr
finish
