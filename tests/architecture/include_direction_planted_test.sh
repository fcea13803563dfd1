#!/bin/sh
# The include-direction test must fail for each wrong include planted here, and pass for each right one.
set -eu
test=$(dirname "$0")/include_direction_test.sh
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

expect() {  # pass|fail FILE INCLUDE
  rm -rf "$tree/src" "$tree/include" "$tree/python"
  mkdir -p "$tree/src" "$tree/include" "$tree/$(dirname "$2")"
  printf '#include <vector>\n#include %s\n' "$3" >"$tree/$2"
  if sh "$test" "$tree" >/dev/null; then result=pass; else result=fail; fi
  [ "$result" = "$1" ] || { echo "$2 with #include $3: expected $1, got $result"; failures=1; }
}

expect fail src/volume/grid.h '"surface/bsdf.h"'
expect fail src/volume/grid.h '"light/lights.h"'
expect fail src/surface/bsdf.h '"volume/grid.h"'
expect fail src/light/tree.cpp '"surface/bsdf.h"'
expect fail src/light/tree.cpp '<surface/bsdf.h>'
expect fail src/math/rng.h '"texture/textures.h"'
expect fail src/texture/textures.h '"io/exr.h"'
expect fail src/io/read.cpp '"volume/grid.h"'
expect fail src/transport/path/path.cpp '"io/exr.h"'
expect fail src/report/html.cpp '"session/world_parts.h"'
expect fail src/cli/main.cpp '"volume/grid.h"'
expect fail src/example/ceiling.cpp '"io/atomic_file.h"'
expect fail src/example/plume.cpp '<openvdb/openvdb.h>'
expect fail src/report/html.cpp '"example/example.h"'
expect fail src/report/html.cpp '"farm/farm_job.h"'
expect fail src/transport/path/path.cpp '"../volume/grid.h"'
expect fail src/transport/path/path.cpp '"path.h"'
expect fail src/transport/path/path.cpp '"session/film_buffer.h"'
expect fail src/transport/media/span.cpp '"transport/path/path.h"'
expect fail src/transport/media/span.cpp '"session/film_buffer.h"'
expect fail src/transport/media/span.cpp '"transport/planned_memory.h"'
expect fail src/transport/world/suns.h '"transport/sample/light_context.h"'
expect fail src/transport/techniques/joint.cpp '"transport/pixel/point_images.h"'
expect fail src/session/render_job.cpp '"volume/grid.h"'
expect fail src/session/render_job.cpp '"light/lights.h"'
expect fail src/volume/grid.h '"transport/media/span.h"'
expect fail src/cli/main.cpp '"transport/media/span.h"'
expect fail src/newcomer/file.cpp '"math/rng.h"'
expect fail include/tyndall/scene.h '"math/rng.h"'
expect fail include/tyndall/scene.h '<openvdb/openvdb.h>'
expect fail src/volume/grid.cpp '<openvdb/openvdb.h>'
expect fail src/io/describe.cpp '"nanovdb/NanoVDB.h"'
expect fail src/surface/shape.cpp '<embree3/rtcore.h>'
expect fail src/io/png.cpp '<OpenEXR/ImfHeader.h>'
expect fail src/io/png.cpp '<ImfHeader.h>'
expect fail src/light/build.cpp '<oneapi/tbb/parallel_for.h>'
expect fail src/math/rng.h '<tbb/tbb.h>'
expect fail src/transport/path/path.cpp '<some_library/thing.h>'
expect fail src/report/page.cpp '<zlib.h>'

expect fail src/io/tev_message.cpp '<netdb.h>'
expect fail python/bindings/scene.cpp '"io/exr.h"'
expect fail python/bindings/scene.cpp '<openvdb/openvdb.h>'
expect fail src/io/exr.cpp '<pybind11/pybind11.h>'

expect pass python/bindings/scene.cpp '"tyndall/io.h"'
expect pass python/bindings/scene.cpp '"convert.h"'
expect pass python/bindings/scene.cpp '<pybind11/numpy.h>'
expect pass src/transport/path/path.cpp '"volume/grid.h"'
expect pass src/transport/path/path.cpp '"transport/media/span.h"'
expect pass src/transport/media/span.cpp '"transport/media/span.h"'
expect pass src/transport/media/span.cpp '"volume/grid.h"'
expect pass src/transport/sharing/find_link.cpp '"transport/path/path_offer.h"'
expect pass src/transport/planned_memory.cpp '"transport/pixel/film_emitters.h"'
expect pass src/session/render_job.cpp '"transport/pixel/film_search.h"'
expect pass src/session/render_job.cpp '"transport/path/path.h"'
expect pass src/session/render_job.cpp '"math/parallel.h"'
expect pass src/surface/bsdf.h '"texture/textures.h"'
expect pass src/light/tree.cpp '"tyndall/math.h"'
expect pass src/volume/vdb_read.cpp '<openvdb/openvdb.h>'
expect pass src/surface/geometry_embree.cpp '<embree3/rtcore.h>'
expect pass src/io/exr_write.cpp '<OpenEXR/ImfHeader.h>'
expect pass src/math/parallel.h '<oneapi/tbb/parallel_for.h>'
expect pass src/cli/main.cpp '"report/html.h"'
expect pass src/report/page_picture.cpp '<zlib.h>'
expect pass src/cli/main.cpp '"example/example.h"'
expect pass src/cli/farm_command.cpp '"farm/farm_job.h"'
expect pass src/example/ceiling.cpp '"math/rng.h"'
expect pass include/tyndall/scene.h '<vector>'

exit $failures
