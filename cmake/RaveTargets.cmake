# SPDX-License-Identifier: Apache-2.0
# One function per kind of target. A folder's CMakeLists.txt is a list of calls to these.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The installed layout, repeated in the build tree, so that `rave` finds its plug-ins the same way.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
set(RAVE_PLUGIN_DIR "lib/rave/plugins")

# What every RAVE target is compiled with. The floating-point flags are part of the contract that
# a run gives the same bits everywhere; they are exported to plug-ins through rave::base.
file(RELATIVE_PATH rave_source_from_build "${CMAKE_BINARY_DIR}" "${CMAKE_SOURCE_DIR}")
add_library(rave_build_flags INTERFACE)
target_compile_options(rave_build_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  -Wnon-virtual-dtor -Woverloaded-virtual -Wimplicit-fallthrough
  $<$<BOOL:${RAVE_WERROR}>:-Werror>
  # A plug-in with a symbol of that kind is never unloaded.
  $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique>
  # g++ collects garbage only above a gigabyte (in KB): a seventh less time, a third more memory.
  "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1048576>"
  -ffile-prefix-map=${CMAKE_SOURCE_DIR}/=
  # ccache with a base folder (see tools/lib/build.sh) hands the compiler relative paths.
  -ffile-prefix-map=${rave_source_from_build}=)
if(RAVE_SANITIZE)
  target_compile_options(rave_build_flags INTERFACE
    -fsanitize=${RAVE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # The checks hide from g++ what an std::optional without a value keeps it from reading.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(rave_build_flags INTERFACE -fsanitize=${RAVE_SANITIZE})
  if(RAVE_SANITIZE MATCHES undefined AND NOT RAVE_FUZZERS)
    # Two checks before each access through a pointer double the time that compiling takes. A null
    # pointer is caught without them (the address sanitizer reports the fault), and what lies at odd
    # places, bytes from files and sockets, goes through the parsers, which the fuzz targets check.
    target_compile_options(rave_build_flags INTERFACE -fno-sanitize=null,alignment)
  endif()
endif()
if(RAVE_FUZZERS)
  # What the libraries do guides the fuzzer; its own main comes with the targets only.
  target_compile_options(rave_build_flags INTERFACE -fsanitize=fuzzer-no-link)
  add_custom_target(rave_fuzzers)
endif()

# rave_vector_sources(SOURCES ...): sources of the calling folder that Highway compiles once for each
# set of instructions, for which they include themselves. g++ 12 puts vfmsubadd and vfmaddsub into
# pairs of a product and a sum there, whatever -ffp-contract says, and then the sets differ in the
# last bit; it finds such pairs when it vectorises straight code. The test house_fused looks for them.
function(rave_vector_sources)
  set_source_files_properties(${ARGN} PROPERTIES
    INCLUDE_DIRECTORIES "${CMAKE_CURRENT_SOURCE_DIR}"
    SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>")
endfunction()

# rave_unity(target): with RAVE_UNITY the sources of a target are compiled a few at a time, so that
# the compiler reads the headers they share once for all of them. Those named to
# rave_vector_sources() stay alone.
function(rave_unity target)
  get_target_property(sources ${target} SOURCES)
  list(LENGTH sources count)
  if(NOT RAVE_UNITY OR count LESS 2)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
  # A class that its own source keeps to itself looks to g++ as if a header declared it.
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endfunction()

# rave_cold(target): code that runs once, or when a person asks for something. -O1 takes a sixth less
# time to compile than -O2.
function(rave_cold target)
  if(NOT RAVE_SANITIZE)
    target_compile_options(${target} PRIVATE -O1)
  endif()
endfunction()

# rave_library(NAME [DEPS ...] [PRIVATE_DEPS ...] [SOURCES ...] [SEPARATE] [COLD])
# The static library rave_NAME (alias rave::NAME) of the calling folder: public headers in
# include/rave/NAME, sources in src/, unit tests in tests/. SEPARATE for what plug-ins link: they get
# the objects that they use and no more, so that a robot program does not need the packages of the
# rest. COLD: see rave_cold().
function(rave_library name)
  cmake_parse_arguments(ARG "SEPARATE;COLD" "" "DEPS;PRIVATE_DEPS;SOURCES" ${ARGN})
  if(ARG_SOURCES)
    add_library(rave_${name} STATIC ${ARG_SOURCES})
    if(ARG_COLD)
      rave_cold(rave_${name})
    endif()
    if(NOT ARG_SEPARATE OR RAVE_UNITY STREQUAL "ALL")
      rave_unity(rave_${name})
    endif()
    set(scope PUBLIC)
    target_link_libraries(rave_${name} PRIVATE $<BUILD_INTERFACE:rave_build_flags> ${ARG_PRIVATE_DEPS})
  else()
    add_library(rave_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(rave::${name} ALIAS rave_${name})
  set_target_properties(rave_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(rave_${name} ${scope} cxx_std_20)
  target_include_directories(rave_${name} ${scope}
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_link_libraries(rave_${name} ${scope} ${ARG_DEPS})
  set_property(GLOBAL APPEND PROPERTY RAVE_INSTALL_TARGETS rave_${name})
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/include")
    set_property(GLOBAL APPEND PROPERTY RAVE_INSTALL_INCLUDES "${CMAKE_CURRENT_SOURCE_DIR}/include/")
  endif()
endfunction()

# rave_plugin(NAME SOURCES ... [DEPS ...] [VIRTUAL])
# The plug-in NAME.so, loaded at run time and linked by nobody. VIRTUAL: it needs the simulator, as
# one that links it always does; the component `host` goes without it.
function(rave_plugin name)
  cmake_parse_arguments(ARG "VIRTUAL" "" "DEPS;SOURCES" ${ARGN})
  if(NOT ARG_VIRTUAL AND NOT "rave::sim" IN_LIST ARG_DEPS AND NOT "rave::world" IN_LIST ARG_DEPS)
    set_property(GLOBAL APPEND PROPERTY RAVE_HOST_PLUGIN_TARGETS rave_plugin_${name})
  endif()
  add_library(rave_plugin_${name} MODULE ${ARG_SOURCES})
  rave_unity(rave_plugin_${name})
  target_link_libraries(rave_plugin_${name} PRIVATE rave_build_flags ${ARG_DEPS})
  set_target_properties(rave_plugin_${name} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
    LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${RAVE_PLUGIN_DIR}")
  # Only the one entry point and the stamp are visible; static libraries stay inside, and a shared
  # one that they want is needed only by a plug-in that uses that part of them.
  target_link_options(rave_plugin_${name} PRIVATE
    -Wl,--exclude-libs,ALL -Wl,--no-undefined -Wl,--as-needed)
  set_property(GLOBAL APPEND PROPERTY RAVE_PLUGIN_TARGETS rave_plugin_${name})
endfunction()

# rave_driver(NAME SOURCES ... DEPS ... [VIRTUAL]): a plug-in that serves devices, or virtual ones.
function(rave_driver name)
  rave_plugin(${name} ${ARGN})
endfunction()

# rave_program(NAME SOURCES ...): a decision process; it is given the robot library and no more.
function(rave_program name)
  rave_plugin(${name} ${ARGN} DEPS rave::robot)
endfunction()

# rave_executable(NAME SOURCES ... DEPS ...)
function(rave_executable name)
  cmake_parse_arguments(ARG "" "" "DEPS;SOURCES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  rave_unity(${name})
  target_link_libraries(${name} PRIVATE rave_build_flags ${ARG_DEPS})
endfunction()

# A test takes one core, unless its processes mostly wait for time to pass (WAITS). ./test tells ctest
# how many cores there are and starts one test more than that.
function(rave_cores_of_test result waits)
  if(waits)
    set(${result} "" PARENT_SCOPE)
  else()
    set(${result} "cores:1" PARENT_SCOPE)
  endif()
endfunction()

# rave_test(NAME SOURCES ... [DEPS ...] [LABELS ...] [TIMEOUT seconds] [NEEDS target...] [OPTIMIZE]
#           [WAITS])
# A GoogleTest program, run by ctest as NAME. NEEDS names targets it starts or loads. The code of
# tests is not optimised, which saves a third of the time it takes to compile; OPTIMIZE for those
# that reckon much themselves. The target rave_tests_LABEL builds all tests of a label.
function(rave_test name)
  if(NOT RAVE_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "OPTIMIZE;WAITS" "TIMEOUT" "DEPS;SOURCES;LABELS;NEEDS;ENVIRONMENT" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  rave_unity(test_${name})
  if(NOT ARG_OPTIMIZE)
    target_compile_options(test_${name} PRIVATE -O0)
  endif()
  target_link_libraries(test_${name} PRIVATE rave_build_flags ${ARG_DEPS} GTest::gtest_main)
  set_target_properties(test_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  target_compile_definitions(test_${name} PRIVATE
    RAVE_SOURCE_DIR="${CMAKE_SOURCE_DIR}" RAVE_BINARY_DIR="${CMAKE_BINARY_DIR}")
  if(ARG_NEEDS)
    add_dependencies(test_${name} ${ARG_NEEDS})
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  foreach(label ${ARG_LABELS})
    if(NOT TARGET rave_tests_${label})
      add_custom_target(rave_tests_${label})
    endif()
    add_dependencies(rave_tests_${label} test_${name})
  endforeach()
  rave_cores_of_test(cores "${ARG_WAITS}")
  add_test(NAME ${name} COMMAND test_${name} WORKING_DIRECTORY "${CMAKE_BINARY_DIR}")
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}"
    ENVIRONMENT "${ARG_ENVIRONMENT}" RESOURCE_GROUPS "${cores}")
endfunction()

# rave_check(NAME COMMAND ... [LABELS ...] [WAITS]): any other command as a test.
function(rave_check name)
  if(NOT RAVE_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "WAITS" "TIMEOUT" "COMMAND;LABELS" ${ARGN})
  rave_cores_of_test(cores "${ARG_WAITS}")
  add_test(NAME ${name} COMMAND ${ARG_COMMAND} WORKING_DIRECTORY "${CMAKE_SOURCE_DIR}")
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "${ARG_LABELS}"
    RESOURCE_GROUPS "${cores}")
endfunction()

# rave_fuzzer(NAME SOURCES ... DEPS ... CORPUS folder)
# With clang and RAVE_FUZZERS a libFuzzer program; otherwise a program that replays the corpus and
# seeded mutations of it, so that every build checks every parser against what is known.
function(rave_fuzzer name)
  if(NOT RAVE_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "CORPUS" "DEPS;SOURCES" ${ARGN})
  add_executable(fuzz_${name} ${ARG_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE rave_build_flags ${ARG_DEPS})
  set_target_properties(fuzz_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/fuzz")
  if(RAVE_FUZZERS)
    target_compile_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    add_dependencies(rave_fuzzers fuzz_${name})
    # Read by tools/fuzz.py.
    file(WRITE "${CMAKE_BINARY_DIR}/fuzz/fuzz_${name}.corpus"
      "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_CORPUS}\n")
  else()
    target_sources(fuzz_${name} PRIVATE "${CMAKE_SOURCE_DIR}/tests/fuzz/replay_main.cpp")
    add_test(NAME fuzz_${name}
      COMMAND fuzz_${name} "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_CORPUS}")
    set_tests_properties(fuzz_${name} PROPERTIES TIMEOUT 300 LABELS fuzz RESOURCE_GROUPS "cores:1")
  endif()
endfunction()

# rave_benchmark(NAME SOURCES ... DEPS ...): a Google Benchmark program.
function(rave_benchmark name)
  if(NOT RAVE_BENCHMARKS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "DEPS;SOURCES" ${ARGN})
  add_executable(bench_${name} ${ARG_SOURCES})
  target_link_libraries(bench_${name} PRIVATE rave_build_flags ${ARG_DEPS} benchmark::benchmark_main)
  set_target_properties(bench_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bench")
endfunction()

# rave_part(NAME [INCLUDE folder] [SOURCES ...] [DEPS ...] [PRIVATE_DEPS ...])
# The library rave_NAME (alias rave::NAME) that this build alone uses and no installation has: what
# the plug-ins of a folder or tests share. INCLUDE is the folder that includes start at, that of the
# caller if it is not given. Without SOURCES it has headers only.
function(rave_part name)
  cmake_parse_arguments(ARG "" "INCLUDE" "DEPS;PRIVATE_DEPS;SOURCES" ${ARGN})
  set(kind INTERFACE)
  set(scope INTERFACE)
  if(ARG_SOURCES)
    set(kind STATIC)
    set(scope PUBLIC)
  endif()
  add_library(rave_${name} ${kind} ${ARG_SOURCES})
  add_library(rave::${name} ALIAS rave_${name})
  if(ARG_SOURCES)
    rave_unity(rave_${name})
    target_link_libraries(rave_${name} PRIVATE rave_build_flags ${ARG_PRIVATE_DEPS})
  endif()
  set(include "${ARG_INCLUDE}")
  cmake_path(ABSOLUTE_PATH include BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
  target_include_directories(rave_${name} ${scope} "${include}")
  target_link_libraries(rave_${name} ${scope} ${ARG_DEPS})
endfunction()
