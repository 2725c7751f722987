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

# Compile options of all our own code; to be called once for each target.
function(albtpu_target target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Werror)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  albtpu_sanitize(${target})
endfunction()

# Installs a program. In the build tree it is in bin/ as well, so that it finds share/ the same way.
function(albtpu_program target)
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

# The headers of all tests, precompiled: they take a quarter of the time of a test's file.
function(albtpu_reuse_test_headers target)
  if(NOT TARGET albtpu_test_headers)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/test_headers.cc CONTENT "")
    add_library(albtpu_test_headers OBJECT ${PROJECT_BINARY_DIR}/test_headers.cc)
    albtpu_target(albtpu_test_headers)
    target_compile_options(albtpu_test_headers PRIVATE -pthread)
    target_link_libraries(albtpu_test_headers PRIVATE GTest::gmock GTest::gtest_main)
    target_precompile_headers(albtpu_test_headers PRIVATE <gmock/gmock.h> <gtest/gtest.h>)
  endif()
  target_compile_options(${target} PRIVATE -pthread)  # Some libraries require it, and all must be compiled alike.
  target_precompile_headers(${target} REUSE_FROM albtpu_test_headers)
endfunction()

# A GoogleTest program, whose tests are registered with CTest under one label:
#   albtpu_test(NAME LABEL SOURCES ... LIBRARIES ...)
function(albtpu_test name label)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  albtpu_target(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  albtpu_reuse_test_headers(${name})
  include(GoogleTest)
  gtest_discover_tests(${name} PROPERTIES LABELS ${label} DISCOVERY_TIMEOUT 60)
endfunction()
