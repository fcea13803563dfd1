# The libraries of the program, each from the distribution; nothing is vendored or downloaded.
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenVDB 10 REQUIRED)
find_package(embree 3 REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PNG REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

# Header-only, without CMake files: found here so that an absent one is named now and not by the compiler.
find_path(NANOVDB_INCLUDE_DIR nanovdb/NanoVDB.h REQUIRED)
find_path(STB_INCLUDE_DIR stb/stb_image.h REQUIRED)
find_library(BLOSC_LIBRARY blosc REQUIRED)  # compressed .nvdb files
find_path(MICROHTTPD_INCLUDE_DIR microhttpd.h REQUIRED)
find_library(MICROHTTPD_LIBRARY microhttpd REQUIRED)
mark_as_advanced(NANOVDB_INCLUDE_DIR STB_INCLUDE_DIR BLOSC_LIBRARY MICROHTTPD_INCLUDE_DIR MICROHTTPD_LIBRARY)
