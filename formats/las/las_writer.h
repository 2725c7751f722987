// Writes a copy of a LAS or LAZ file with more bytes in each point record: the uncertainties and, on request, the
// geometry of its beam.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "formats/files/output_file.h"
#include "formats/las/annotated_head.h"
#include "formats/las/las_reader.h"
#include "formats/laz/chunk_table.h"

namespace albtpu::formats {

//   LasWriter writer(reader, *head, output);
//   status = writer.Begin();
//   status = writer.Write(records, count);  // As often as there are runs of points.
//   status = writer.End(tail_begin, tail_end);
class LasWriter {
 public:
  // All must outlive it.
  LasWriter(const LasReader& reader, const LasHead& head, OutputFile& output)
      : reader_(reader), head_(head), output_(output) {}

  absl::Status Begin();

  // The records of `points` points; of LAZ, a compressed chunk of them.
  absl::Status Write(std::string_view bytes, std::uint64_t points);

  // Copies what follows the points in the input, but for EVLRs that are not kept, and completes the head.
  absl::Status End(std::uint64_t tail_begin, std::uint64_t tail_end);

 private:
  absl::Status EndPoints();
  absl::Status Copy(std::uint64_t begin, std::uint64_t end);

  const LasReader& reader_;
  const LasHead& head_;
  OutputFile& output_;
  std::vector<laz::Chunk> chunks_;  // Of LAZ.
};

}  // namespace albtpu::formats
