# `cmake --install`: the program, the library and its headers, and what find_package(Tyndall) needs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tyndall)

if(TARGET tyndall_cli)
  install(TARGETS tyndall_cli RUNTIME)
endif()
install(TARGETS tyndall EXPORT TyndallTargets ARCHIVE)
install(DIRECTORY include/tyndall ${PROJECT_BINARY_DIR}/include/tyndall DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.h)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT TyndallTargets NAMESPACE Tyndall:: DESTINATION ${config_dir})
configure_package_config_file(cmake/TyndallConfig.cmake.in ${PROJECT_BINARY_DIR}/TyndallConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TyndallConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TyndallConfig.cmake ${PROJECT_BINARY_DIR}/TyndallConfigVersion.cmake cmake/FindOpenVDB.cmake
  DESTINATION ${config_dir})
