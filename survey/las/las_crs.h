// Whether the coordinate system of a LAS file counts in feet.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "survey/las/las_reader.h"

namespace albtpu::client {

// What says feet, in words for a message ("UNIT[\"US survey foot\",0.304800609601219]"); nothing when nothing
// does. A code that implies feet without naming a unit (a state plane EPSG code alone) is not seen.
std::optional<std::string> FindFeetInWkt(std::string_view wkt);
std::optional<std::string> FindFeetInGeoKeys(std::string_view geo_key_directory);

// Looks into all records of LASF_Projection: WKT (2112) and GeoTIFF keys (34735), short and extended.
absl::StatusOr<std::optional<std::string>> FindFeet(const LasReader& reader);

}  // namespace albtpu::client
