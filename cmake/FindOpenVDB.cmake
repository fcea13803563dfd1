# OpenVDB as the distribution packages it: OpenVDB::openvdb.
# The finder that comes with OpenVDB 10 also asks for Boost.Iostreams' development files and forces BUILD_SHARED_LIBS;
# linking with the shared library needs neither.
find_path(OpenVDB_INCLUDE_DIR openvdb/version.h)
find_library(OpenVDB_LIBRARY openvdb)
find_path(OpenVDB_BOOST_INCLUDE_DIR boost/any.hpp)
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY OpenVDB_BOOST_INCLUDE_DIR)

if(OpenVDB_INCLUDE_DIR)
  file(STRINGS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h _versions REGEX "#define OPENVDB_LIBRARY_[A-Z]+_VERSION_NUMBER [0-9]+")
  string(REGEX REPLACE "[^0-9;]" "" _versions "${_versions}")
  list(JOIN _versions "." OpenVDB_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB
  REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_BOOST_INCLUDE_DIR VERSION_VAR OpenVDB_VERSION)

if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  include(CMakeFindDependencyMacro)
  find_dependency(TBB)
  find_dependency(Imath)
  find_dependency(Threads)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES
    IMPORTED_LOCATION ${OpenVDB_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR};${OpenVDB_BOOST_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "TBB::tbb;Imath::Imath;Threads::Threads")
endif()
