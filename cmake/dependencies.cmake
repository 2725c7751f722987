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
# gRPC would find RE2 by pkg-config, which in Debian 13 takes 40 s at each configuration, for the 170 parts of Abseil
# that it goes through, and adds -DNOMINMAX, with which compilers do not accept precompiled headers made without.
find_library(RE2_LIBRARY re2 REQUIRED)
add_library(re2::re2 INTERFACE IMPORTED)
set_property(TARGET re2::re2 PROPERTY INTERFACE_LINK_LIBRARIES "${RE2_LIBRARY}")
set(re2_FOUND TRUE)
find_package(gRPC REQUIRED CONFIG)

# Open MPI or another. Without it, jobs with --shard share the work of a table.
find_package(MPI COMPONENTS C)
albtpu_optional_part(ALBTPU_MPI FOUND MPI_C_FOUND RESULT ALBTPU_WITH_MPI PART "MPI ranks of albtpu-generate"
  NEEDS MPI PACKAGE libopenmpi-dev)

# GeoTIFF and BAG of surfaces. The programs do not link it; they load it when it is needed.
pkg_check_modules(GDAL IMPORTED_TARGET gdal)
albtpu_optional_part(ALBTPU_GDAL FOUND GDAL_FOUND RESULT ALBTPU_WITH_GDAL PART "GeoTIFF and BAG of albtpu-query surface"
  NEEDS GDAL PACKAGE libgdal-dev)
if(ALBTPU_WITH_GDAL)
  find_library(ALBTPU_GDAL_FILE gdal REQUIRED HINTS ${GDAL_LIBRARY_DIRS} ${GDAL_LIBDIR})
  mark_as_advanced(ALBTPU_GDAL_FILE)
  file(REAL_PATH ${ALBTPU_GDAL_FILE} gdal_file)
  string(REGEX MATCH "libgdal\\.so\\.[0-9]+" ALBTPU_GDAL_LIBRARY ${gdal_file})  # Of the ABI: "libgdal.so.32".
endif()

if(ALBTPU_BUILD_TESTS)
  find_package(GTest REQUIRED CONFIG)
endif()
