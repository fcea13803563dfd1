# Targets for people: `tidy` reads every source with .clang-tidy, `format` rewrites them with .clang-format.
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy run-clang-tidy-14)
find_program(CLANG_FORMAT NAMES clang-format clang-format-14)
mark_as_advanced(RUN_CLANG_TIDY CLANG_FORMAT)

if(RUN_CLANG_TIDY)
  add_custom_target(tidy
    COMMAND ${RUN_CLANG_TIDY} -quiet -p ${PROJECT_BINARY_DIR} "${PROJECT_SOURCE_DIR}/(src|tests)/"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} USES_TERMINAL)
endif()
if(CLANG_FORMAT)
  add_custom_target(format
    COMMAND find include src python tests -name "*.h" -o -name "*.cpp" | xargs ${CLANG_FORMAT} -i
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()
