// The Extra Bytes record of LAS (LASF_Spec 4): what stands behind the fields of a point's format.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "tables/coverage.h"

namespace albtpu::client {

// The two floats that are appended to each record, by the names that readers of cBLUE's files know.
inline constexpr std::string_view kThuName = "total_thu";
inline constexpr std::string_view kTvuName = "total_tvu";
inline constexpr float kNoUncertainty = -1;  // Declared as their no-data value.
inline constexpr std::size_t kAppendedBytes = 2 * sizeof(float);

// The most that a VLR can hold.
inline constexpr std::size_t kLargestExtraBytesRecord = 65535;

// The data of the record with total_thu and total_tvu described last. `described` is the data that the file
// has, kept byte for byte, empty if it has none; `extra_bytes` is what the records really have. Bytes that
// nothing describes get entries of type 0, "undocumented", so that ours are found where they are.
//
// Fails when the names are there already, when more bytes are described than there are, when a type is
// unknown, or when the result would not fit a VLR.
absl::StatusOr<std::string> DescribeUncertainty(const std::string& name, std::string_view described,
                                                std::size_t extra_bytes, Coverage coverage);

}  // namespace albtpu::client
