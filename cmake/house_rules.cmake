# Compiles `target` for ALBTPU_SANITIZE. All targets need this, those of generated code too: if two files define the
# same inline function, the linker keeps either one.
function(albtpu_sanitize target)
  if(NOT ALBTPU_SANITIZE)
    return()
  endif()
  # The sanitizers do not check the indices of views; libstdc++'s assertions do.
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  target_compile_options(${target} PRIVATE -fsanitize=${ALBTPU_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(${target} PUBLIC -fsanitize=${ALBTPU_SANITIZE})
  if(ALBTPU_SANITIZE STREQUAL "thread")
    # The headers of protobuf and Abseil change the layout of classes if __SANITIZE_THREAD__ is defined, but Debian's
    # libraries are compiled without it. libstdc++ derives _GLIBCXX_TSAN from it; without _GLIBCXX_TSAN it bypasses
    # atomic operations.
    target_compile_options(${target} PRIVATE -U__SANITIZE_THREAD__ -D_GLIBCXX_TSAN=1)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE" AND ALBTPU_BUILD_TESTS)  # tests/sanitizers defines albtpu_seen_libraries.
    target_link_libraries(${target} PRIVATE albtpu_seen_libraries)
  endif()
endfunction()

# Warnings are errors for developers; others may have a compiler that warns of more.
option(ALBTPU_WERROR "Treat warnings as errors" OFF)

# Warnings of all our own code. With precompiled headers g++ 12 does not know which code is of the system, and prints
# its false alarms about std::string.
function(albtpu_warn target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${ALBTPU_WERROR}>:-Werror>)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                           -Wno-stringop-overread)
  endif()
endfunction()

include(CMakeDependentOption)
# Half of the time of a file goes into what it includes, so that a release compiles several files at a time. Where
# precompiled headers are disabled, to see whether each file includes what it needs, each file is compiled alone.
cmake_dependent_option(ALBTPU_UNITY "Compile several files of a target at a time" ON
                       "NOT CMAKE_DISABLE_PRECOMPILE_HEADERS" OFF)

# Compile options of all our own code; to be called once for each target:
#   albtpu_target(NAME [APPLICATION|PROGRAM|TEST|VALIDATION])
# What computes, or serves many pulses, is optimized most. An APPLICATION handles files and settings, and a PROGRAM its
# arguments; a TEST runs for less time than its optimization takes, but a VALIDATION computes.
function(albtpu_target target)
  albtpu_warn(${target})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  albtpu_sanitize(${target})
  if(ALBTPU_UNITY)
    set(batch 24)
    if(CMAKE_CURRENT_SOURCE_DIR MATCHES "/tests(/|$)")  # Tests have less code beside what they include.
      set(batch 9)
    endif()
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${batch})
  endif()
  albtpu_precompile(${target} "${ARGN}")
endfunction()

# Optimizes a target by its kind, and precompiles what most files include: half of the time of a short file goes into
# it. Targets of a kind share it, by an object library without code, because g++ optimizes as precompiled headers were
# told.
function(albtpu_precompile target kind)
  set(options -pthread)  # Some libraries ask for it, and all must be compiled alike.
  set(libraries Eigen3::Eigen)
  set(headers "")
  set(optimization "")
  if(kind STREQUAL "APPLICATION")
    set(optimization -O2)
    set(headers <nlohmann/json.hpp> <toml++/toml.h>)
  elseif(kind STREQUAL "PROGRAM")
    set(optimization -O1)
    set(headers <CLI/CLI.hpp> <nlohmann/json.hpp> <toml++/toml.h>)
  elseif(kind MATCHES "TEST|VALIDATION")
    if(kind STREQUAL "TEST")
      set(optimization -O1)
    endif()
    set(headers <gmock/gmock.h> <gtest/gtest.h> <fstream> <numbers> <random>)
    list(APPEND libraries GTest::gmock GTest::gtest_main)
  elseif(kind)
    message(FATAL_ERROR "albtpu_target(${target}): unknown kind '${kind}'")
  endif()
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    list(APPEND options ${optimization})
  endif()
  if(headers MATCHES "toml[+][+]")
    set(toml tomlplusplus::tomlplusplus)
    list(APPEND libraries ${toml})
    # Its headers are compiled otherwise without these, which all that share them must have.
    target_compile_options(${target} PRIVATE $<TARGET_PROPERTY:${toml},INTERFACE_COMPILE_OPTIONS>)
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:${toml},INTERFACE_COMPILE_DEFINITIONS>)
  endif()
  string(TOLOWER "albtpu_headers_${kind}" group)
  string(REGEX REPLACE "_$" "" group "${group}")
  if(NOT TARGET ${group})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${group}.cc CONTENT "")
    add_library(${group} OBJECT ${PROJECT_BINARY_DIR}/${group}.cc)
    albtpu_warn(${group})
    albtpu_sanitize(${group})
    target_compile_options(${group} PRIVATE ${options})
    target_link_libraries(${group} PRIVATE ${libraries})
    target_precompile_headers(${group} PRIVATE
      <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
      <string_view> <utility> <vector> <absl/status/statusor.h> <absl/strings/str_cat.h> <absl/strings/str_format.h>
      <Eigen/Core> ${headers})
  endif()
  target_compile_options(${target} PRIVATE ${options})
  target_precompile_headers(${target} REUSE_FROM ${group})
endfunction()

# Installs a program, in a component. In the build tree it is in bin/ as well, so that it finds share/ the same way.
function(albtpu_program target component)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
endfunction()

# For targets that contain or test Highway kernels. A kernel is compiled once for each of these instruction sets, of
# vectors of fixed width up to 8 floats, and the best one is chosen at run time. The last two are for other processors.
# All others are disabled, also those of later versions of Highway:
#   albtpu_kernels(NAME PRIVATE|PUBLIC)
function(albtpu_kernels target scope)
  target_compile_definitions(${target} ${scope}
    "HWY_DISABLED_TARGETS=(~(HWY_SSSE3|HWY_SSE4|HWY_AVX2|HWY_NEON|HWY_EMU128|HWY_SCALAR))")
  # Highway's NEON target includes the cryptographic instructions. Compiled without them, member functions that g++
  # generates implicitly cannot hold its vectors.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    target_compile_options(${target} PRIVATE -march=armv8-a+crypto)
    set_target_properties(${target} PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # They are compiled without it.
  endif()
  target_link_libraries(${target} ${scope} hwy::hwy)
endfunction()

# A GoogleTest program, registered with CTest under one label:
#   albtpu_test(NAME LABEL [ONE_PROCESS] SOURCES ... LIBRARIES ...)
# It is one test of CTest: most of its tests take milliseconds, and to start it takes longer. Those of `validation` take
# seconds and are registered one by one, to run beside each other, unless they share in ONE_PROCESS what takes longer
# than they do.
function(albtpu_test name label)
  cmake_parse_arguments(ARG "ONE_PROCESS" "" "SOURCES;LIBRARIES" ${ARGN})
  albtpu_skip_kernels(${ARG_SOURCES})
  add_executable(${name} ${ARG_SOURCES})
  set(kind TEST)
  if(label STREQUAL "validation")
    set(kind VALIDATION)
  endif()
  albtpu_target(${name} ${kind})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  if(label STREQUAL "validation" AND NOT ARG_ONE_PROCESS)
    include(GoogleTest)
    gtest_discover_tests(${name} PROPERTIES LABELS ${label} COST 100 DISCOVERY_TIMEOUT 60)
    return()
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS ${label})
  if(label STREQUAL "validation")
    set_tests_properties(${name} PROPERTIES COST 100)
  endif()
endfunction()

# Sets `variable` to the sources in `folders` of the current folder, without those of programs (main.cc, *_main.cc): a
# new file needs no line in a list.
function(albtpu_sources variable)
  set(sources "")
  foreach(folder IN LISTS ARGN)
    file(GLOB found CONFIGURE_DEPENDS ${folder}/*.cc)
    list(APPEND sources ${found})
  endforeach()
  list(FILTER sources EXCLUDE REGEX "(^|/|_)main\\.cc$")
  albtpu_skip_kernels(${sources})
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# Compiles the sources that have kernels alone: each includes itself, once for each instruction set.
function(albtpu_skip_kernels)
  foreach(source IN LISTS ARGN)
    file(REAL_PATH ${source} path BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    file(STRINGS ${path} kernels REGEX "^#include <hwy/foreach_target")
    if(kernels)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()
