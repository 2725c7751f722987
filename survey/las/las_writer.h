// A LAS file that is another one with 8 bytes more on each record: total_thu and total_tvu.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "survey/files/output_file.h"
#include "survey/las/las_reader.h"
#include "tables/coverage.h"

namespace albtpu::client {

// Every byte before the points of the file to be written. The Extra Bytes record is extended where it stands,
// or added behind the last VLR; bytes between the VLRs and the points stay. Of the header only these change:
// offset to points, VLR count, record length, start of the EVLRs and, where waveforms are inside, of their
// packet. Fails when a field would overflow, and for what DescribeUncertainty refuses.
absl::StatusOr<std::string> AnnotatedHead(const LasReader& reader, Coverage coverage);

// Copies what lies behind the points.
absl::Status CopyTail(const LasReader& reader, OutputFile& output);

}  // namespace albtpu::client
