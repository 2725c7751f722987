// The coordinate system that the records of a LAS file state, and whether it is in feet.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::formats {

// The part that specifies feet, worded for a message (`unit "US survey foot"`, `GeoTIFF key 3076 = 9003`); nullopt if
// none does. A code that implies feet without naming a unit, such as a state plane EPSG code alone, is not recognized.
std::optional<std::string> FindFeetInWkt(std::string_view wkt);
std::optional<std::string> FindFeetInGeoKeys(std::string_view geo_key_directory);

// Searches all records of LASF_Projection, WKT (2112) and GeoTIFF keys (34735), in VLRs and EVLRs.
absl::StatusOr<std::optional<std::string>> FindFeet(const LasReader& reader);

// The codes of a GeoTIFF key directory; 0 where a key is missing or user-defined.
CrsDescription DescribeGeoKeys(std::string_view geo_key_directory);

// The first well-known text and the first GeoTIFF keys of LASF_Projection, in VLRs and then in EVLRs. Empty where there
// are none; a user's text is not set. MapFrame::Create makes a projection of it.
absl::StatusOr<CrsDescription> DescribeCrs(const LasReader& reader);

}  // namespace albtpu::formats
