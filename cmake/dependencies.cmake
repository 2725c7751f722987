# All dependencies are packages of Debian 12 and 13, which packages.txt lists.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(ZLIB REQUIRED)
find_package(absl REQUIRED CONFIG)
find_package(spdlog REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(tomlplusplus REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(Eigen3 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(hwy REQUIRED CONFIG)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)

# The serial C library, and its high-level library for dimension scales.
set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 REQUIRED COMPONENTS C HL)

# FFTW and jemalloc have no CMake configuration file in Debian.
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(JEMALLOC REQUIRED IMPORTED_TARGET jemalloc)

# PROJ's CMake configuration file names no imported target that is the same in all its versions.
pkg_check_modules(PROJ REQUIRED IMPORTED_TARGET proj)

# NetCDF has no CMake configuration file in Debian.
pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET netcdf)

# pkg-config instead of the CMake configuration file of prometheus-cpp, which requires CURL for its push component; we
# use only the pull component.
pkg_check_modules(PROMETHEUS REQUIRED IMPORTED_TARGET prometheus-cpp-pull)

# gRPC's configuration file needs Protobuf to have been found in module mode; Protobuf's own configuration file does not
# work with it.
find_package(Protobuf REQUIRED MODULE)
find_package(gRPC REQUIRED CONFIG)
# gRPC finds RE2 by pkg-config. In Debian 13 that adds -DNOMINMAX, which concerns Windows only; with it, compilers do
# not accept precompiled headers that were compiled without.
if(TARGET re2::re2)
  get_property(options TARGET re2::re2 PROPERTY INTERFACE_COMPILE_OPTIONS)
  list(REMOVE_ITEM options -DNOMINMAX)
  set_property(TARGET re2::re2 PROPERTY INTERFACE_COMPILE_OPTIONS "${options}")
endif()

# Open MPI or another. Without it, jobs with --shard share the work of a table.
find_package(MPI COMPONENTS C)
albtpu_optional_part(ALBTPU_MPI FOUND MPI_C_FOUND RESULT ALBTPU_WITH_MPI PART "MPI ranks of albtpu-generate"
  NEEDS MPI PACKAGE libopenmpi-dev)

if(ALBTPU_BUILD_TESTS)
  find_package(GTest REQUIRED CONFIG)
endif()
