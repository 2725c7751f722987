// Writes a copy of a LAS file with more bytes in each point record: the uncertainties and, on request, the geometry of
// its beam.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "survey/files/output_file.h"
#include "survey/las/las_extra_bytes.h"
#include "survey/las/las_reader.h"

namespace albtpu::client {

// All bytes before the points of the output. The Extra Bytes record is extended in place, or added after the last VLR;
// bytes between the VLRs and the points are kept. In the header only these fields change: offset to points, number of
// VLRs, record length, start of the EVLRs and, if waveforms are in the file, start of the waveform packet. Fails when a
// field would overflow, or when DescribeAppended fails.
absl::StatusOr<std::string> AnnotatedHead(const LasReader& reader,
                                          const std::vector<AppendedFloat>& appended);

// Copies everything after the points.
absl::Status CopyTail(const LasReader& reader, OutputFile& output);

}  // namespace albtpu::client
