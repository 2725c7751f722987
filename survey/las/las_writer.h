// Writes a copy of a LAS file with 8 more bytes in each point record: total_thu and total_tvu.
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

// All bytes before the points of the output. The Extra Bytes record is extended in place, or added after the last VLR;
// bytes between the VLRs and the points are kept. In the header only these fields change: offset to points, number of
// VLRs, record length, start of the EVLRs and, if waveforms are in the file, start of the waveform packet. Fails when a
// field would overflow, or when DescribeUncertainty fails.
absl::StatusOr<std::string> AnnotatedHead(const LasReader& reader, Coverage coverage);

// Copies everything after the points.
absl::Status CopyTail(const LasReader& reader, OutputFile& output);

}  // namespace albtpu::client
