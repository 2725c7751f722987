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

// What is appended to each record.
struct Appended {
  Coverage coverage = Coverage::kTwoSigma;
  bool total = false;    // The total uncertainty, not the share of the sea surface alone.
  bool details = false;  // The geometry of each beam, too; of a total also its shares, biases and covariance.
};

// In this order in a record: sea_thu and sea_tvu, or total_thu and total_tvu; of a total with details kTotalDetailCount
// more; with details the geometry.
std::vector<AppendedFloat> AppendedFloats(const Appended& appended);

inline constexpr std::size_t kUncertaintyCount = 2;
// thu_air to tvu_water, two biases, six entries of the covariance.
inline constexpr std::size_t kTotalDetailCount = 14;
inline constexpr std::size_t kGeometryCount =
    5;  // incidence, beam_azimuth, footprint, water_depth, slant_range

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
