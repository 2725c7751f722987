// A finished surface as GeoTIFF and BAG.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "quality/surface/survey_surface.h"

namespace albtpu::quality {

enum class SurfaceFormat { kNetcdf, kGeoTiff, kBag };
inline constexpr std::array kSurfaceFormats = {SurfaceFormat::kNetcdf, SurfaceFormat::kGeoTiff, SurfaceFormat::kBag};
inline constexpr std::array<std::string_view, 3> kSurfaceFormatNames = {"netcdf", "geotiff", "bag"};

// The file of a format in the folder of a surface: surface.nc, surface.tif, surface.bag.
std::string FileOf(SurfaceFormat format);

// Before a surface is made: FailedPrecondition where a format needs GDAL, which is missing; InvalidArgument where a map
// cannot be written as BAG, which needs a known system whose unit is the metre.
absl::Status CheckFormats(const std::vector<SurfaceFormat>& formats, const SurfaceMap& map);

// Writes the files of `formats` but for surface.nc beside that. `organisation`, which may be empty, answers for the
// surface in the metadata of a BAG.
absl::Status WriteRasters(const MadeSurface& surface, const std::vector<SurfaceFormat>& formats,
                          const std::string& organisation);

}  // namespace albtpu::quality
