# With ALBTPU_SANITIZE, what all that we compile is compiled with, generated code too: of an inline function that two
# files have, the linker keeps either.
function(albtpu_sanitize target)
  if(NOT ALBTPU_SANITIZE)
    return()
  endif()
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)  # Indices of views, which no sanitizer sees.
  target_compile_options(${target} PRIVATE -fsanitize=${ALBTPU_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  target_link_options(${target} PUBLIC -fsanitize=${ALBTPU_SANITIZE})
  if(ALBTPU_SANITIZE STREQUAL "thread")
    # Headers of protobuf and Abseil lay out classes otherwise where this is defined, and their libraries are compiled
    # without. libstdc++ derives the second from it, and takes a short cut past atomic numbers without.
    target_compile_options(${target} PRIVATE -U__SANITIZE_THREAD__ -D_GLIBCXX_TSAN=1)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE" AND ALBTPU_BUILD_TESTS)  # Which bring it.
    target_link_libraries(${target} PRIVATE albtpu_seen_libraries)
  endif()
endfunction()

# What all of our own code is compiled with: albtpu_target(NAME) is called once for each target.
function(albtpu_target target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Werror)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  albtpu_sanitize(${target})
endfunction()

# A program that is installed. In the build tree it lies in bin/ as well, so that it finds share/ the same way.
function(albtpu_program target)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# Kernels that are compiled once for each of Highway's instruction sets but AVX-512 and those without a fixed
# width, and chosen when the program runs: albtpu_kernels(NAME PRIVATE|PUBLIC) is called for each target that has or
# tests any.
function(albtpu_kernels target scope)
  target_compile_definitions(${target} ${scope}
    "HWY_DISABLED_TARGETS=(HWY_AVX3|HWY_AVX3_DL|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
  # Highway's NEON is with the cryptographic instructions; compiled for less, the members that g++ makes by itself
  # cannot hold its vectors.
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    target_compile_options(${target} PRIVATE -march=armv8-a+crypto)
  endif()
  target_link_libraries(${target} ${scope} hwy::hwy)
endfunction()

# A GoogleTest program of one source file or more, registered with CTest under one label.
#   albtpu_test(NAME LABEL SOURCES ... LIBRARIES ...)
function(albtpu_test name label)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  albtpu_target(${name})
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} GTest::gmock GTest::gtest_main)
  include(GoogleTest)
  gtest_discover_tests(${name} PROPERTIES LABELS ${label} DISCOVERY_TIMEOUT 60)
endfunction()
