# Everything comes from Debian 12 packages; packages.txt lists them.
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

# The serial C library and its high-level part (dimension scales).
set(HDF5_PREFER_PARALLEL OFF)
find_package(HDF5 REQUIRED COMPONENTS C HL)

# FFTW has no CMake configuration file in Debian.
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)

# jemalloc has none, either.
pkg_check_modules(JEMALLOC REQUIRED IMPORTED_TARGET jemalloc)

# The configuration file of prometheus-cpp wants CURL for a part that is not used here.
pkg_check_modules(PROMETHEUS REQUIRED IMPORTED_TARGET prometheus-cpp-pull)

# gRPC's configuration file finds Protobuf by module mode, Protobuf's own does not work.
find_package(Protobuf REQUIRED MODULE)
find_package(gRPC REQUIRED CONFIG)

# Open MPI, or another: without it tables are scaled out by --shard.
find_package(MPI COMPONENTS C)
option(ALBTPU_MPI "Let albtpu-generate share its work between the ranks of MPI" ${MPI_C_FOUND})
if(ALBTPU_MPI AND NOT MPI_C_FOUND)
  message(FATAL_ERROR "ALBTPU_MPI is ON and there is no MPI: install libopenmpi-dev, or say -DALBTPU_MPI=OFF")
endif()

if(ALBTPU_BUILD_TESTS)
  find_package(GTest REQUIRED CONFIG)
endif()
