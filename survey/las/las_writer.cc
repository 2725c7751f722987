#include "survey/las/las_writer.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "absl/strings/str_cat.h"
#include "survey/las/little_endian.h"

namespace albtpu::client {
namespace {

constexpr std::size_t kCopySize = 1 << 20;

absl::Status Invalid(const LasReader& reader, const std::string& message) {
  return absl::InvalidArgumentError(absl::StrCat(reader.name(), ": ", message));
}

// The record that describes the extra bytes; nullopt if the file has none.
absl::StatusOr<std::optional<VlrEntry>> FindExtraBytesRecord(const LasReader& reader) {
  for (const VlrEntry& evlr : reader.evlrs()) {
    if (evlr.Is(kSpecUser, kExtraBytesRecord)) {
      return Invalid(reader,
                     "describes its extra bytes in an EVLR after the points; expected a VLR before them");
    }
  }
  std::optional<VlrEntry> found;
  for (const VlrEntry& vlr : reader.vlrs()) {
    if (!vlr.Is(kSpecUser, kExtraBytesRecord)) continue;
    if (found.has_value()) return Invalid(reader, "describes its extra bytes in two VLRs; expected one");
    found = vlr;
  }
  return found;
}

// Adds to a field of the header. False, and no change, if the sum does not fit the field.
template <typename Number>
bool Increase(std::size_t field, std::uint64_t increment, std::string& head) {
  const std::uint64_t value = Load<Number>(head, field);
  if (value > std::numeric_limits<Number>::max() - increment) return false;
  Store(static_cast<Number>(value + increment), head.data() + field);
  return true;
}

}  // namespace

absl::StatusOr<std::string> AnnotatedHead(const LasReader& reader,
                                          const std::vector<AppendedFloat>& appended) {
  const std::size_t appended_bytes = appended.size() * sizeof(float);
  const LasHeader& header = reader.header();
  const absl::StatusOr<std::optional<VlrEntry>> existing = FindExtraBytesRecord(reader);
  if (!existing.ok()) return existing.status();
  const std::string_view described =
      existing->has_value() ? reader.head().substr((*existing)->data_offset, (*existing)->data_size) : "";
  const absl::StatusOr<std::string> data =
      DescribeAppended(reader.name(), described, header.extra_bytes(), appended);
  if (!data.ok()) return data.status();

  std::string head(reader.head());
  const auto data_size = static_cast<std::uint16_t>(data->size());
  bool fits = true;
  if (existing->has_value()) {
    const VlrEntry& record = **existing;
    head.replace(record.data_offset, record.data_size, *data);
    Store(data_size, head.data() + record.offset + kVlrLengthField);
  } else {
    const std::size_t end_of_vlrs = reader.vlrs().empty() ? header.header_size : reader.vlrs().back().end();
    head.insert(end_of_vlrs, SpecVlrHeader(kExtraBytesRecord, data_size, "Extra Bytes") + *data);
    fits = Increase<std::uint32_t>(las_field::kVlrCount, 1, head);
  }
  const std::uint64_t grown_by = head.size() - reader.head().size();
  fits = fits && Increase<std::uint32_t>(las_field::kOffsetToPoints, grown_by, head) &&
         Increase<std::uint16_t>(las_field::kRecordLength, appended_bytes, head);
  const std::uint64_t tail_moves_by = grown_by + header.point_count * appended_bytes;
  if (header.start_of_evlrs != 0) {
    fits = fits && Increase<std::uint64_t>(las_field::kStartOfEvlrs, tail_moves_by, head);
  }
  if (header.start_of_waveform_packet != 0) {
    fits = fits && Increase<std::uint64_t>(las_field::kStartOfWaveformPacket, tail_moves_by, head);
  }
  if (!fits) {
    return Invalid(reader, absl::StrCat("has no room for ", appended_bytes, " more bytes in records of ",
                                        header.record_length, "; remove some of its extra bytes"));
  }
  return head;
}

absl::Status CopyTail(const LasReader& reader, OutputFile& output) {
  for (std::uint64_t at = reader.header().end_of_points(); at < reader.file_size();) {
    const std::size_t size = std::min<std::uint64_t>(kCopySize, reader.file_size() - at);
    const absl::StatusOr<std::string> bytes = reader.ReadAt(at, size);
    if (!bytes.ok()) return bytes.status();
    if (absl::Status status = output.Write(*bytes); !status.ok()) return status;
    at += size;
  }
  return absl::OkStatus();
}

}  // namespace albtpu::client
