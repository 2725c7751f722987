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

# Compile options of all our own code; to be called once for each target.
function(albtpu_target target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${ALBTPU_WERROR}>:-Werror>)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  albtpu_sanitize(${target})
  # At the end of the folder it is known whether the target is a test or position-independent.
  cmake_language(EVAL CODE "cmake_language(DEFER CALL albtpu_precompiled_headers ${target})")
endfunction()

# What most files include, compiled once for all targets that are compiled alike: it is half of the time of a short
# file. A group is an object library without code; REUSE_FROM asks for the same options.
#   albtpu_precompiled_group(NAME OPTIONS ... HEADERS ... LIBRARIES ...)
function(albtpu_precompiled_group name)
  cmake_parse_arguments(ARG "" "" "OPTIONS;HEADERS;LIBRARIES" ${ARGN})
  if(TARGET ${name})
    return()
  endif()
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cc CONTENT "")
  add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/${name}.cc)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${ALBTPU_WERROR}>:-Werror>
    -pthread ${ARG_OPTIONS})
  albtpu_sanitize(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES})
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <string>
    <string_view> <utility> <vector> <absl/status/statusor.h> <absl/strings/str_cat.h> <absl/strings/str_format.h>
    ${ARG_HEADERS})
endfunction()

function(albtpu_precompiled_headers target)
  get_target_property(is_test ${target} ALBTPU_TEST_OPTIONS)
  get_target_property(relocatable ${target} POSITION_INDEPENDENT_CODE)
  if(NOT is_test STREQUAL "is_test-NOTFOUND")
    string(MAKE_C_IDENTIFIER "albtpu_test_headers${is_test}" group)
    albtpu_precompiled_group(${group} OPTIONS ${is_test} HEADERS <gmock/gmock.h> <gtest/gtest.h>
      LIBRARIES GTest::gmock GTest::gtest_main)
  elseif(relocatable)
    set(group albtpu_package_headers)
    albtpu_precompiled_group(${group})
    set_target_properties(${group} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    set(group albtpu_headers)
    albtpu_precompiled_group(${group})
  endif()
  target_compile_options(${target} PRIVATE -pthread)  # Some libraries ask for it, and all must be compiled alike.
  target_precompile_headers(${target} REUSE_FROM ${group})
endfunction()

# Installs a program. In the build tree it is in bin/ as well, so that it finds share/ the same way. CLI11's header costs
# 3 s a file for the objects that it defines, so that files are compiled several at a time.
function(albtpu_program target)
  if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
  endif()
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# For targets that contain or test Highway kernels. A kernel is compiled once for each instruction set, except AVX-512
# and those of variable vector width, and the best one is chosen at run time:
#   albtpu_kernels(NAME PRIVATE|PUBLIC)
function(albtpu_kernels target scope)
  target_compile_definitions(${target} ${scope}
    "HWY_DISABLED_TARGETS=(HWY_AVX3|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  # Highway's NEON target includes the cryptographic instructions. Compiled without them, member functions that g++
  # generates implicitly cannot hold its vectors.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    target_compile_options(${target} PRIVATE -march=armv8-a+crypto)
  endif()
  target_link_libraries(${target} ${scope} hwy::hwy)
endfunction()

# A GoogleTest program, registered with CTest under one label:
#   albtpu_test(NAME LABEL SOURCES ... LIBRARIES ...)
# It is one test of CTest: most of its tests take milliseconds, and to start it takes longer. Those of `validation` take
# seconds and are registered one by one, to run beside each other. Others run for less time than the optimization of
# their own code takes; the libraries under test are as released.
function(albtpu_test name label)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  albtpu_target(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  set(options "")
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT label STREQUAL "validation")
    set(options -O1)
  endif()
  target_compile_options(${name} PRIVATE ${options})
  set_target_properties(${name} PROPERTIES ALBTPU_TEST_OPTIONS "${options}")
  if(label STREQUAL "validation")
    include(GoogleTest)
    gtest_discover_tests(${name} PROPERTIES LABELS ${label} DISCOVERY_TIMEOUT 60)
  else()
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES LABELS ${label})
  endif()
endfunction()
