// The Extra Bytes record of LAS (LASF_Spec 4), which describes the bytes of a point after the fields of its format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "tables/coverage.h"

namespace albtpu::client {

// The two floats that are appended to each record. Readers of cBLUE's files know them by these names.
inline constexpr std::string_view kThuName = "total_thu";
inline constexpr std::string_view kTvuName = "total_tvu";
inline constexpr float kNoUncertainty = -1;  // Their no-data value.
inline constexpr std::size_t kAppendedBytes = 2 * sizeof(float);

// Bytes; the capacity of a VLR.
inline constexpr std::size_t kLargestExtraBytesRecord = 65535;

// The data of the record after descriptions of total_thu and total_tvu have been appended. `described` is the existing
// data, which is kept byte for byte; it is empty if the file has no such record. `extra_bytes` is the actual number of
// extra bytes in a point. Bytes without a description get entries of type 0, "undocumented", so that readers find ours
// at the right offset.
//
// Fails when the names exist already, when more bytes are described than exist, when a type is unknown, or when the
// result does not fit a VLR.
absl::StatusOr<std::string> DescribeUncertainty(const std::string& name, std::string_view described,
                                                std::size_t extra_bytes, Coverage coverage);

}  // namespace albtpu::client
