// Finds out whether the coordinate system of a LAS file is in feet.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "survey/las/las_reader.h"

namespace albtpu::client {

// The part that specifies feet, worded for a message (`unit "US survey foot"`, `GeoTIFF key 3076 = 9003`); nullopt if
// none does. A code that implies feet without naming a unit, such as a state plane EPSG code alone, is not recognized.
std::optional<std::string> FindFeetInWkt(std::string_view wkt);
std::optional<std::string> FindFeetInGeoKeys(std::string_view geo_key_directory);

// Searches all records of LASF_Projection, WKT (2112) and GeoTIFF keys (34735), in VLRs and EVLRs.
absl::StatusOr<std::optional<std::string>> FindFeet(const LasReader& reader);

}  // namespace albtpu::client
