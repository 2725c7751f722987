// LAS and LAZ files in memory: taken apart into what the user sees of them, and put together as one or the other.
// Headers and records are read by the tables of the specification, without our reader; points by our codec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "laz/items/laszip_record.h"
#include "laz/laz_points.h"
#include "tests/formats/las/las_builder.h"
#include "tests/laz/busy_points.h"

namespace albtpu::testing {

// A file without its compression.
struct LasParts {
  std::string header;  // Its offsets, counts and compression bit are set when the file is put together.
  std::string vlrs;    // Without the LASzip record.
  std::uint32_t vlr_count = 0;
  std::string gap;                                // Between the VLRs and the points.
  std::string points;                             // Records as in a LAS file.
  std::string tail;                               // After the points: waveforms, EVLRs, anything.
  std::optional<std::uint64_t> waveforms, evlrs;  // Where they begin in the tail.

  int point_format() const;
  std::size_t record_length() const;
  std::uint64_t point_count() const;
};

enum class TableForm {
  kInFront,  // Its offset is before the points, as when a file is written to a disk.
  kAtEnd,    // Its offset is in the last 8 bytes of the file, as when it is written to a pipe.
  kNone,     // No table; the offset is -1.
};

struct LazForm {
  std::uint32_t chunk_size = laz::kCommonChunkSize;  // Points; kVariableChunks: some of few points, some of many.
  TableForm table = TableForm::kInFront;
};

// Takes a file of either kind apart. Its header must be right; what is wrong with its points, LASzip record and chunk
// table is said by the library. `threads` as for LazPoints::Open.
absl::StatusOr<LasParts> TakeApart(std::string_view file, int threads = 1);

// Where the points of a LAZ file lie, whose header must be right.
absl::StatusOr<laz::LazExtent> ExtentOf(std::string_view file);

// The points of a chunk each, first to last, when `count` points are written with this chunk size.
std::vector<std::size_t> ChunkPoints(std::uint64_t count, std::uint32_t chunk_size);

std::string AsLas(const LasParts& parts);
std::string AsLaz(const LasParts& parts, const LazForm& form = {});

// A file around given records, of version 1.2 for formats 0 to 3, 1.3 with waveforms in the file for 4 and 5, 1.4 with
// waveforms and an EVLR for 6 to 10. It has two VLRs, and a gap before the points.
LasParts FileOf(const RecordLayout& layout, const std::string& records);

// The file of BuildLas(), as LAZ.
std::string BuildLaz(const LasSpec& spec, std::uint32_t chunk_size);

}  // namespace albtpu::testing
