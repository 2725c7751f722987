// Grids as rasters, which GDAL writes: a Cloud Optimized GeoTIFF, and a Bathymetric Attributed Grid (BAG). GDAL is an
// optional part of the build. It is loaded when it is needed: with the hundred libraries that it consists of, the
// program would take four times as long to start. Only gdal_raster.cc uses it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "grids/netcdf_grid.h"

namespace albtpu {

// A band is a variable of the NetCDF file, under the same name.
struct RasterBand {
  std::string name, description;
  std::string unit;  // Empty: none.
};

struct Raster {
  std::filesystem::path grid;  // NetCDF, finished.
  GridFrame frame;             // Of it.
  std::vector<RasterBand> bands;
  std::vector<std::pair<std::string, std::string>> metadata;
};

// FailedPrecondition where the program was built without GDAL or does not find it, with what to do.
absl::Status CheckGdal();

// Floats, NaN where there is none; with overviews of every second, fourth, ... cell, so that they have values of nodes.
// What is not finished lies in files beside `path`, which must be new, and is removed. Memory is that of some windows.
absl::Status WriteCog(const Raster& raster, const std::filesystem::path& path);

// Whether GDAL finds a vertical system in a raster. It leaves out of a GeoTIFF one without a code.
bool HasVerticalSystem(const std::filesystem::path& path);

// `raster` has the bands elevation and uncertainty, upwards and in m. `metadata` is the text of BagMetadata. Fails also
// where what GDAL reads of the file is not what was to be written.
absl::Status WriteBag(const Raster& raster, const std::string& metadata, const std::filesystem::path& path);

}  // namespace albtpu
