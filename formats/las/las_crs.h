// The coordinate system that the records of a LAS file state, and whether it is in feet.
#pragma once

#include <memory>
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

// The records that state a coordinate system: well-known text (2112) and GeoTIFF keys (34735) of LASF_Projection.
struct CrsRecords {
  bool wkt = true, keys = true;
};

// Searches these records in VLRs and EVLRs.
absl::StatusOr<std::optional<std::string>> FindFeet(const LasReader& reader, CrsRecords records = {});

// The codes of a GeoTIFF key directory; 0 where a key is missing or user-defined. A projection of the file's own is
// read where it is UTM or transverse Mercator with all parameters, of which `reals`, the record 34736, has some.
CrsDescription DescribeGeoKeys(std::string_view geo_key_directory, std::string_view reals = "");

// The first well-known text and the first GeoTIFF keys, in VLRs and then in EVLRs. Empty where there are none; a user's
// text is not set. MapFrame::Create makes a projection of it.
absl::StatusOr<CrsDescription> DescribeCrs(const LasReader& reader, CrsRecords records = {});

// The coordinate system of a file.
struct LasCrs {
  std::shared_ptr<const MapFrame> map;           // Null if none is stated.
  std::optional<double> metres_per_height_unit;  // Absent: not stated.
  std::string remark;                            // For the user, about how it was found; usually empty.
  std::optional<std::string> feet;               // What says that something is in feet, as FindFeet.
};

// Of a text and keys the record counts that the header names (LASF 1.4 R15, bit 4 of the global encoding), or the other
// one if that is faulty. The other record only adds a unit of heights that the first lacks, and only if it puts
// `middle`, a point of the file, at the same place; a contradiction is remarked. `user` is the text of --crs, which
// comes before both; may be empty. Fails as MapFrame::Create, and where several texts contradict each other.
absl::StatusOr<LasCrs> CrsOf(const LasReader& reader, const std::string& user, const MapPosition& middle);

// The same at the first point. Fails when it cannot be read, too.
absl::StatusOr<LasCrs> CrsOf(const LasReader& reader, const std::string& user);

}  // namespace albtpu::formats
