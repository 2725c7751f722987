#include "formats/las/las_writer.h"

#include <algorithm>
#include <string>

#include "formats/laz/coding/little_endian.h"

namespace albtpu::formats {
namespace {

constexpr std::size_t kCopySize = 1 << 20;

std::string TableOffset(std::uint64_t offset) {
  std::string bytes(laz::kTableOffsetSize, '\0');
  laz::Store(offset, bytes.data());
  return bytes;
}

}  // namespace

absl::Status LasWriter::Begin() {
  absl::Status status = output_.Write(head_.bytes);
  if (status.ok() && head_.record.has_value()) status = output_.Write(TableOffset(0));
  return status;
}

absl::Status LasWriter::Write(std::string_view bytes, std::uint64_t points) {
  if (head_.record.has_value())
    chunks_.push_back({.offset = output_.size(), .bytes = bytes.size(), .points = points});
  return output_.Write(bytes);
}

absl::Status LasWriter::EndPoints() {
  if (!head_.record.has_value()) return absl::OkStatus();
  const std::uint64_t table = output_.size();
  absl::Status status = output_.Write(laz::ChunkTableBytes(*head_.record, chunks_));
  if (status.ok()) status = output_.WriteAt(head_.bytes.size(), TableOffset(table));
  return status;
}

absl::Status LasWriter::End(std::uint64_t tail_begin, std::uint64_t tail_end) {
  if (absl::Status status = EndPoints(); !status.ok()) return status;
  std::string header = head_.bytes.substr(0, reader_.header().header_size);
  MoveTailStarts(reader_, tail_begin, output_.size(), header);
  if (absl::Status status = output_.WriteAt(0, header); !status.ok()) return status;
  std::uint64_t next = tail_begin;
  for (const VlrEntry& evlr : reader_.evlrs()) {  // In the order of the file.
    if (IsKept(reader_, evlr)) continue;
    if (absl::Status status = Copy(next, evlr.offset); !status.ok()) return status;
    next = evlr.end();
  }
  return Copy(next, tail_end);
}

absl::Status LasWriter::Copy(std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t at = begin; at < end;) {
    const std::size_t size = std::min<std::uint64_t>(kCopySize, end - at);
    const absl::StatusOr<std::string> bytes = reader_.ReadAt(at, size);
    if (!bytes.ok()) return bytes.status();
    if (absl::Status status = output_.Write(*bytes); !status.ok()) return status;
    at += size;
  }
  return absl::OkStatus();
}

}  // namespace albtpu::formats
