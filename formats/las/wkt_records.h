// Several records of well-known text in one LAS file, of which the format allows one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_reader.h"

namespace albtpu::formats {

inline constexpr std::string_view kProjectionUser = "LASF_Projection";
inline constexpr std::uint16_t kWktRecord = 2112;
inline constexpr std::size_t kLongestWkt = 1 << 20;  // Bytes; real ones have a few thousand.

// The different texts in VLRs and then in EVLRs, without empty ones.
absl::StatusOr<std::vector<std::string>> WktRecords(const LasReader& reader);

// How far apart two coordinate systems put a point, m; infinite where one of them is not defined there.
double Apart(const MapFrame& one, const MapFrame& other, const MapPosition& at);

// Two datums of one map put a point less than this apart, two units or zones far more.
inline constexpr double kSamePlace = 2;  // m

// FailedPrecondition where a further text differs from the first, which `first` was made of, in the unit or the datum
// of positions or heights, or puts `middle`, a point of the file, elsewhere. Otherwise a remark for the user, which is
// empty where there is one text alone.
absl::StatusOr<std::string> CompareWkts(const LasReader& reader, const MapFrame& first, const MapPosition& middle);

}  // namespace albtpu::formats
