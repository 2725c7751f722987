// The Extra Bytes record of LAS (LASF_Spec 4), which describes the bytes of a point after the fields of its format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/coverage.h"

namespace albtpu::client {

// One of the floats that are appended to each record.
struct AppendedFloat {
  std::string_view name, description;  // At most 32 bytes each.
  float no_data = 0;
};

inline constexpr float kNoNumber = -1;  // The no-data value of lengths; that of angles is NaN.

// The uncertainties, and the geometry of each beam where it is wanted; in this order in a record.
std::vector<AppendedFloat> AppendedFloats(Coverage coverage, bool details);

inline constexpr std::size_t kUncertaintyCount = 2;  // sea_thu, sea_tvu
inline constexpr std::size_t kDetailCount =
    5;  // incidence, beam_azimuth, footprint, water_depth, slant_range
constexpr std::size_t AppendedCount(bool details) { return kUncertaintyCount + (details ? kDetailCount : 0); }

// Bytes; the capacity of a VLR.
inline constexpr std::size_t kLargestExtraBytesRecord = 65535;

// The data of the record after descriptions of `appended` have been added. `described` is the existing data, which is
// kept byte for byte; it is empty if the file has no such record. `extra_bytes` is the actual number of extra bytes in
// a point. Bytes without a description get entries of type 0, "undocumented", so that readers find ours at the right
// offset.
//
// Fails when a name exists already, when more bytes are described than exist, when a type is unknown, or when the
// result does not fit a VLR.
absl::StatusOr<std::string> DescribeAppended(const std::string& name, std::string_view described,
                                             std::size_t extra_bytes,
                                             const std::vector<AppendedFloat>& appended);

}  // namespace albtpu::client
