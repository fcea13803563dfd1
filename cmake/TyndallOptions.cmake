# Options, compiler flags that every target of Tyndall shares, and the generated version header.
option(TYNDALL_TESTS "Build the tests and benchmarks" ON)
option(TYNDALL_WERROR "Treat warnings as errors" OFF)
option(TYNDALL_FAST_BUILD "Precompiled headers and united sources: half the time from nothing; OFF shows which source forgets an include" ON)
option(TYNDALL_PYTHON "Build the Python module, python/tyndall in the build folder" OFF)
option(TYNDALL_FUZZ "Build the libFuzzer targets of tests/fuzz; needs clang" OFF)
set(TYNDALL_SANITIZE "" CACHE STRING "-fsanitize= list, e.g. address,undefined; empty for none")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(_arch x86-64-v3)
endif()
set(TYNDALL_ARCH "${_arch}" CACHE STRING "-march=: x86-64-v3 needs AVX2, as Intel Core has since 2013 and AMD since 2015, but few Atom, Celeron and Pentium before 2021; x86-64 runs on all, native is for this CPU, empty is the compiler's own")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# Program and Python module are made of the same objects. -fno-semantic-interposition, below: no other library replaces our functions, so
# that they can be inlined as in a program.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g -D_GLIBCXX_ASSERTIONS")

configure_file(${PROJECT_SOURCE_DIR}/cmake/version.h.in ${PROJECT_BINARY_DIR}/include/tyndall/version.h @ONLY)

add_library(tyndall_options INTERFACE)
# It warns of `"text" + string` without reason, GCC bug 105651; under other names where headers are precompiled.
set(old_gcc $<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>)
# -fno-math-errno and -fno-trapping-math let sqrt and selects vectorise and keep NaN and infinity intact; -ffast-math would not.
target_compile_options(tyndall_options INTERFACE
  $<$<BOOL:${TYNDALL_ARCH}>:-march=${TYNDALL_ARCH}> -ffp-contract=off -fno-math-errno -fno-trapping-math
  -fno-semantic-interposition
  -Wall -Wextra -Wpedantic -Wshadow $<${old_gcc}:-Wno-restrict>
  $<$<AND:${old_gcc},$<BOOL:${TYNDALL_FAST_BUILD}>>:-Wno-stringop-overflow$<SEMICOLON>-Wno-array-bounds> $<$<BOOL:${TYNDALL_WERROR}>:-Werror>)
target_include_directories(tyndall_options INTERFACE
  ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include)

if(TYNDALL_SANITIZE)
  set(TYNDALL_SANITIZE_FLAG -fsanitize=${TYNDALL_SANITIZE})  # for whoever links the library from outside
  target_compile_options(tyndall_options INTERFACE
    ${TYNDALL_SANITIZE_FLAG} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(tyndall_options INTERFACE ${TYNDALL_SANITIZE_FLAG})
  if(TYNDALL_SANITIZE MATCHES "thread")
    target_compile_definitions(tyndall_options INTERFACE TYNDALL_STD_THREADS)  # math/std_thread_pool.h says why
  endif()
endif()
if(TYNDALL_FUZZ)
  target_compile_options(tyndall_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
