#!/bin/sh
# Who may include whom: reads every #include line of include/, src/ and python/, prints each that goes the wrong way, and fails if there is one.
# Usage: include_direction_test.sh [CHECKOUT]
set -eu
cd "${1:-$(dirname "$0")/../..}"

find include src $([ ! -d python ] || echo python) \( -name '*.h' -o -name '*.cpp' \) -exec grep -HnE '^[[:space:]]*#[[:space:]]*include' {} + | awk '
BEGIN {
  # A folder of src, and the folders it may include besides itself and include/tyndall.
  allow("math", "")
  allow("volume", "math")
  allow("texture", "math")
  allow("surface", "texture math")
  allow("light", "texture math")
  allow("io", "math")  # and no grid, surface or light: a reader fills the public Scene
  # Of the folders of transport each may include those before it; what stands beside them, all.
  count = split("media camera world sample vertex budget techniques pixel path sharing", folder_of_transport, " ")
  for (i = 1; i <= count; i++) {
    allow("transport/" folder_of_transport[i], transport " volume surface light texture math")
    transport = transport " transport/" folder_of_transport[i]
  }
  allow("transport", transport " volume surface light texture math")
  allow("session", "transport " transport " math")
  allow("denoise", "math")
  allow("report", "")  # io and session through include/tyndall
  allow("farm", "report")  # how words are quoted for a shell
  allow("example", "math")  # writes files through include/tyndall
  allow("serve", "report")  # the page and how it has its pictures
  allow("cli", "serve farm report denoise io session example")

  # A library as its include lines begin, and the files that may see it.
  door("^(openvdb|nanovdb)/", "^src/volume/vdb_")
  door("^embree[0-9]*/", "^src/surface/geometry")
  door("^(OpenEXR/|Imath/|Imf|Imath|Iex|half\\.h)", "^src/io/exr")
  door("^(tbb|oneapi)/", "^src/math/parallel\\.h$")
  door("^(png\\.h|stb/)", "^src/io/")
  # report: a page carries its pictures deflated, for the browser; that is no file format of io.
  door("^zlib\\.h", "^src/(io/|volume/vdb_|report/page_picture\\.cpp$)")
  door("^blosc\\.h", "^src/volume/vdb_")
  door("^(nlohmann|fmt)/", "^src/(report|farm|serve|cli)/")
  door("^microhttpd\\.h$", "^src/serve/http_server\\.cpp$")
  door("^(CLI|spdlog)/", "^src/cli/")
  # Not libraries: the compiler and the operating system.
  door("^[a-z]*intrin\\.h$", "^src/")
  door("^(elf|link)\\.h$", "^src/session/build_id\\.cpp$")
  door("^sys/platform/x86\\.h$", "^src/cli/cpu_")
  door("^netdb\\.h$", "^src/(cli/viewer_link|serve/listener)\\.cpp$")
  door("^experimental/simd$", "^src/math/simd\\.h$")
  door("^(unistd\\.h|fcntl\\.h|fnmatch\\.h|signal\\.h|sys/[a-z]*\\.h)$", "^src/")
}
function allow(folder, others,    n, i, list) {
  permitted[folder, folder] = known[folder] = 1
  n = split(others, list, " ")
  for (i = 1; i <= n; i++) permitted[folder, list[i]] = 1
}
function door(library, files) { library_of[++doors] = library; files_of[doors] = files }
function wrong(why) { print place ": " path ": " why; found = 1 }

{
  # "src/io/exr.cpp:3:#include <OpenEXR/ImfHeader.h>"
  split($0, part, ":")
  file = part[1]
  place = file ":" part[2]
  if (!match($0, /include[ \t]*[<"][^>"]*[>"]/)) { path = $0; wrong("cannot be read; write the path in <> or quotes"); next }
  path = substr($0, RSTART, RLENGTH)
  gsub(/^include[ \t]*[<"]|[>"]$/, "", path)

  split(file, step, "/")
  owner = step[1] == "include" ? "include" : step[2]
  if (step[2] "/" step[3] in known) owner = step[2] "/" step[3]
  split(path, into, "/")
  folder = path ~ /\// ? into[1] : ""
  if (into[1] "/" into[2] in known) folder = into[1] "/" into[2]

  if (path ~ /^\.\.?\// || path ~ /\/\.\.?\//) { wrong("write paths from src or include"); next }
  if (folder == "tyndall") next
  if (step[1] == "python") {  # the public headers, its own, and pybind11
    if (path !~ /^(pybind11\/)?[a-z_0-9]+(\.h)?$/) wrong("python/ sees tyndall/, pybind11/ and the standard library only")
    next
  }
  if (owner == "include") {
    if (path !~ /^[a-z_0-9]+$/) wrong("public headers see the standard library and tyndall/ only")
    next
  }
  if (!(owner in known)) { wrong("src/" owner " has no rule; add one to " "tests/architecture/include_direction_test.sh"); next }
  if (folder in known) {
    if (!((owner, folder) in permitted)) wrong("src/" owner " may not include " folder "/")
    next
  }
  if (path ~ /^[a-z_0-9]+$/) next  # the standard library
  for (i = 1; i <= doors; i++)
    if (path ~ library_of[i]) {
      if (file !~ files_of[i]) wrong("only " files_of[i] " may see this library")
      next
    }
  wrong("neither a path from src nor a library with a door")
}
END { exit found || NR == 0 }
'
