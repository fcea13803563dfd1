# Functions of tests/CMakeLists.txt.

# A static library, or an interface library as long as it has no sources.
function(tyndall_library_or_interface name sources)
  if(sources)
    add_library(${name} STATIC ${sources})
    target_link_libraries(${name} PUBLIC ${ARGN})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARGN})
  endif()
endfunction()

# One ctest entry: add_test with the environment, the time limit and the label of its kind.
function(tyndall_add_test name)
  cmake_parse_arguments(arg "NIGHTLY" "PROCESSORS" "COMMAND" ${ARGN})
  set(environment TYNDALL_SOURCE_DIR=${PROJECT_SOURCE_DIR})
  if(TARGET tyndall_cli)
    list(APPEND environment TYNDALL_BIN=$<TARGET_FILE:tyndall_cli>)
  endif()
  set(timeout 1200)  # against what hangs: entries share cores, with each other and with whatever else the machine does
  if(TYNDALL_SANITIZE)
    set(timeout 6000)  # all is ten times as slow
  endif()
  if(arg_NIGHTLY)
    list(APPEND environment TYNDALL_NIGHTLY=1)
    set(timeout 36000)
  endif()
  set(scratch ${PROJECT_BINARY_DIR}/scratch/${name})
  file(MAKE_DIRECTORY ${scratch})

  add_test(NAME ${name} COMMAND ${arg_COMMAND} WORKING_DIRECTORY ${scratch})
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${environment}" TIMEOUT ${timeout})
  if(arg_PROCESSORS)
    set_tests_properties(${name} PROPERTIES PROCESSORS ${arg_PROCESSORS})
  endif()
  if(arg_NIGHTLY)
    set_tests_properties(${name} PROPERTIES LABELS nightly)
  endif()
endfunction()

# *_test.cpp under <folder> as one doctest program `name`, each test working in a scratch folder of its own.
#   EACH_FILE    one ctest entry "<name>.<file>" for each source, instead of one for the program
#   NIGHTLY      each entry once more as "nightly.<entry>", with TYNDALL_NIGHTLY=1 and the label nightly
#   PROCESSORS   how many cores ctest is to reserve for a nightly entry
function(tyndall_test_program name folder)
  cmake_parse_arguments(arg "EACH_FILE;NIGHTLY" "PROCESSORS" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*_test.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE test_support ${arg_LINK})

  set(processors ${arg_PROCESSORS})
  if(processors)
    list(PREPEND processors PROCESSORS)
  endif()
  if(arg_EACH_FILE)
    foreach(source IN LISTS sources)
      get_filename_component(file ${source} NAME)
      string(REGEX REPLACE "_test\\.cpp$" "" entry ${name}.${file})
      tyndall_add_test(${entry} COMMAND ${name} --source-file=*/${file})
      if(arg_NIGHTLY)
        tyndall_add_test(nightly.${entry} NIGHTLY COMMAND ${name} --source-file=*/${file} ${processors})
      endif()
    endforeach()
  else()
    tyndall_add_test(${name} COMMAND ${name})
  endif()
  if(arg_NIGHTLY)
    set_property(GLOBAL APPEND PROPERTY TYNDALL_NIGHTLY_PROGRAMS ${name})
  endif()
endfunction()

# <folder>/*.sh as one ctest entry "<folder>.<script>" each; exit code 0 passes.
function(tyndall_script_tests folder)
  file(GLOB scripts CONFIGURE_DEPENDS ${folder}/*.sh)
  foreach(script IN LISTS scripts)
    get_filename_component(entry ${script} NAME_WE)
    string(REGEX REPLACE "_test$" "" entry ${entry})
    tyndall_add_test(${folder}.${entry} COMMAND bash ${script} ${ARGN})
  endforeach()
endfunction()
