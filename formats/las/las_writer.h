// Copies of LAS and LAZ files with more bytes in each point record, the uncertainties and on request the geometry of
// its beam: what stands before the points, and the writer of the points.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "formats/files/file_access.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_reader.h"
#include "laz/chunk_table.h"
#include "laz/items/laszip_record.h"

namespace albtpu::formats {

// Everything before the points of a copy of a LAS or LAZ file with more bytes in each point record.

struct LasHead {
  std::string bytes;                        // Up to the points.
  std::optional<laz::LaszipRecord> record;  // The compression of the points; LAZ only.
  std::vector<ReplacedFloat> replaced;      // The floats that replace existing ones.
};

// The Extra Bytes record is extended in place, or added after the last VLR; of several, the first has all entries; then
// follows the LASzip record of LAZ. That of the input is left out, and so are records that are not kept (IsKept). Bytes
// between the VLRs and the points are kept. In the header only these fields change: offset to points, numbers of VLRs
// and EVLRs, record length, and the mark of compressed points; where EVLRs and waveform packets begin is not known
// before the points are written (MoveTailStarts). Fails when a field would overflow, or when DescribeAppended fails.
// With `replace`, floats that the records have already are not appended.
absl::StatusOr<LasHead> AnnotatedHead(const LasReader& reader, const std::vector<AppendedFloat>& appended, LasKind kind,
                                      bool replace = false);

// Whether a VLR or EVLR is valid for the copy. Of LAZ, the records of COPC, an index by the places of compressed
// points, are not. An EVLR of Extra Bytes is not, because its entries are in the VLR of the copy.
bool IsKept(const LasReader& reader, const VlrEntry& entry);

// Whether the file has records of COPC that are not kept.
bool HasCopcIndex(const LasReader& reader);

// Changes the header at the beginning of `head` when what follows the points, from byte `from` of the input, follows
// them in the copy from byte `to`, without the EVLRs that are not kept.
void MoveTailStarts(const LasReader& reader, std::uint64_t from, std::uint64_t to, std::string& head);

// Writes a copy of a LAS or LAZ file with more bytes in each point record: the uncertainties and, on request, the
// geometry of its beam.
//
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
