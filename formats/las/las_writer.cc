#include "formats/las/las_writer.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

using laz::Store;

// The user of all records of COPC (copc.io): the info VLR and the EVLR of the hierarchy.
constexpr std::string_view kCopcUser = "copc";

// The largest chunk of compressed points, for records so long that the common number of them is more.
constexpr std::size_t kChunkBytes = 16 << 20;

// The first field of a VLR of LAS 1.0; reserved later.
constexpr std::uint16_t kFirstVlrSignature = 0xAABB;

absl::Status Invalid(const LasReader& reader, const std::string& message) {
  return reader.Named(absl::InvalidArgumentError(message));
}

std::string Vlr(const LasReader& reader, std::string_view user, std::uint16_t record_id, std::string_view description,
                const std::string& data) {
  std::string bytes = VlrHeader(user, record_id, static_cast<std::uint16_t>(data.size()), description);
  if (reader.header().version_minor == 0) Store(kFirstVlrSignature, bytes.data());
  return bytes + data;
}

// A field of the header. False, and no change, if the value does not fit it.
template <typename Number>
bool Set(std::size_t field, std::uint64_t value, std::string& head) {
  if (value > std::numeric_limits<Number>::max()) return false;
  Store(static_cast<Number>(value), head.data() + field);
  return true;
}

// Bytes of the EVLRs that are not kept, before byte `end` of the input.
std::uint64_t LeftOutBefore(const LasReader& reader, std::uint64_t end) {
  std::uint64_t bytes = 0;
  for (const VlrEntry& evlr : reader.evlrs())
    if (!IsKept(reader, evlr) && evlr.offset < end) bytes += evlr.end() - evlr.offset;
  return bytes;
}

std::uint64_t KeptEvlrs(const LasReader& reader) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(reader.evlrs(), [&](const VlrEntry& evlr) { return IsKept(reader, evlr); }));
}

}  // namespace

bool IsKept(const LasReader& reader, const VlrEntry& entry) {
  if (entry.Is(kSpecUser, kExtraBytesRecord)) return entry.offset < reader.header().offset_to_points;
  return reader.kind() == LasKind::kLas || (entry.user_id != kCopcUser && entry.user_id != laz::kLaszipUser);
}

bool HasCopcIndex(const LasReader& reader) {
  const auto is_copc = [](const VlrEntry& entry) { return entry.user_id == kCopcUser; };
  return reader.kind() == LasKind::kLaz &&
         (std::ranges::any_of(reader.vlrs(), is_copc) || std::ranges::any_of(reader.evlrs(), is_copc));
}

absl::StatusOr<LasHead> AnnotatedHead(const LasReader& reader, const std::vector<AppendedFloat>& appended, LasKind kind,
                                      bool replace) {
  const LasHeader& header = reader.header();
  const std::string_view input = reader.head();
  ASSIGN_OR_RETURN(const std::string described, ReadExtraBytesRecord(reader));
  ASSIGN_OR_RETURN(const AppendedDescription description,
                   DescribeAppended(reader.name(), described, header.extra_bytes(), appended, replace));
  const std::string& data = description.record;
  std::size_t appended_bytes = BytesOf(appended);
  for (const ReplacedFloat& replaced : description.replaced) appended_bytes -= appended[replaced.appended].size();
  const std::size_t record_length = header.record_length + appended_bytes;
  const auto no_room = [&] {
    return Invalid(reader, absl::StrCat("has no room for ", appended_bytes, " more bytes in records of ",
                                        header.record_length, "; remove some of its extra bytes"));
  };
  if (record_length > std::numeric_limits<std::uint16_t>::max()) return no_room();

  LasHead head{
      .bytes = std::string(input.substr(0, header.header_size)), .record = {}, .replaced = description.replaced};
  std::uint64_t vlr_count = 0;
  bool has_description = false;
  const auto add = [&](std::string_view vlr) {
    head.bytes += vlr;
    ++vlr_count;
  };
  for (const VlrEntry& vlr : reader.vlrs()) {
    if (!IsKept(reader, vlr)) continue;
    if (vlr.Is(kSpecUser, kExtraBytesRecord)) {
      if (std::exchange(has_description, true)) continue;
      std::string extended(input.substr(vlr.offset, kVlrHeaderSize));
      Store(static_cast<std::uint16_t>(data.size()), extended.data() + kVlrLengthField);
      add(extended + data);
    } else {
      add(input.substr(vlr.offset, vlr.end() - vlr.offset));
    }
  }
  if (!has_description) add(Vlr(reader, kSpecUser, kExtraBytesRecord, "Extra Bytes", data));
  if (kind == LasKind::kLaz) {
    const std::size_t points = std::clamp<std::size_t>(kChunkBytes / record_length, 1, laz::kCommonChunkSize);
    head.record = laz::RecordFor(header.point_format, record_length, static_cast<std::uint32_t>(points));
    add(Vlr(reader, laz::kLaszipUser, laz::kLaszipRecordId, "LASzip record", laz::LaszipRecordData(*head.record)));
  }
  head.bytes += input.substr(reader.vlrs().empty() ? header.header_size : reader.vlrs().back().end());

  const int mark = kind == LasKind::kLaz ? laz::kCompressedFlag : 0;
  bool fits =
      Set<std::uint32_t>(las_field::kVlrCount, vlr_count, head.bytes) &&
      Set<std::uint32_t>(las_field::kOffsetToPoints, head.bytes.size(), head.bytes) &&
      Set<std::uint16_t>(las_field::kRecordLength, record_length, head.bytes) &&
      Set<std::uint8_t>(las_field::kPointFormat, static_cast<std::uint64_t>(header.point_format | mark), head.bytes);
  if (header.evlr_count > 0) fits = fits && Set<std::uint32_t>(las_field::kEvlrCount, KeptEvlrs(reader), head.bytes);
  if (!fits) return no_room();
  return head;
}

void MoveTailStarts(const LasReader& reader, std::uint64_t from, std::uint64_t to, std::string& head) {
  const LasHeader& header = reader.header();
  const auto moved = [&](std::uint64_t start) { return start - from - LeftOutBefore(reader, start) + to; };
  if (header.start_of_evlrs != 0) {
    const std::uint64_t start = KeptEvlrs(reader) > 0 ? moved(header.start_of_evlrs) : 0;
    Store(start, head.data() + las_field::kStartOfEvlrs);
  }
  if (header.start_of_waveform_packet != 0)
    Store(moved(header.start_of_waveform_packet), head.data() + las_field::kStartOfWaveformPacket);
}

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
  if (head_.record.has_value()) chunks_.push_back({.offset = output_.size(), .bytes = bytes.size(), .points = points});
  return output_.Write(bytes);
}

absl::Status LasWriter::EndPoints() {
  if (!head_.record.has_value()) return absl::OkStatus();
  const std::uint64_t table = output_.size();
  RETURN_IF_ERROR(output_.Write(laz::ChunkTableBytes(*head_.record, chunks_)));
  return output_.WriteAt(head_.bytes.size(), TableOffset(table));
}

absl::Status LasWriter::End(std::uint64_t tail_begin, std::uint64_t tail_end) {
  RETURN_IF_ERROR(EndPoints());
  // A lost table of chunks or padding of LAZ would pass for further points behind those of LAS.
  const LasHeader& from = reader_.header();
  if (!head_.record.has_value() && from.compressed) {
    std::uint64_t named = tail_end;
    for (const std::uint64_t start : {from.start_of_evlrs, from.start_of_waveform_packet})
      if (start != 0) named = std::min(named, start);
    tail_begin = std::max(tail_begin, named);
  }
  std::string header = head_.bytes.substr(0, reader_.header().header_size);
  MoveTailStarts(reader_, tail_begin, output_.size(), header);
  RETURN_IF_ERROR(output_.WriteAt(0, header));
  std::uint64_t next = tail_begin;
  for (const VlrEntry& evlr : reader_.evlrs()) {  // In the order of the file.
    if (IsKept(reader_, evlr)) continue;
    RETURN_IF_ERROR(Copy(next, evlr.offset));
    next = evlr.end();
  }
  return Copy(next, tail_end);
}

absl::Status LasWriter::Copy(std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t at = begin; at < end;) {
    const std::size_t size = std::min<std::uint64_t>(kCopySize, end - at);
    ASSIGN_OR_RETURN(const std::string bytes, reader_.ReadAt(at, size));
    RETURN_IF_ERROR(output_.Write(bytes));
    at += size;
  }
  return absl::OkStatus();
}

}  // namespace albtpu::formats
