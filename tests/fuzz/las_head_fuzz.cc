// Arbitrary bytes as everything in a LAS file except the points, read from memory, are rejected with a reason; or all
// offsets lie in the file, and the extra bytes can be described.
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/las/las_crs.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_header.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu;
using namespace albtpu::formats;

const std::string kName = "file";

void CheckHeader(const LasHeader& header, std::uint64_t file_size) {
  ALBTPU_MUST(header.version_minor >= 0 && header.version_minor <= 4);
  ALBTPU_MUST(header.point_format >= 0 && header.point_format <= kLargestPointFormat);
  ALBTPU_MUST(header.record_length >= MinimumRecordLength(header.point_format));
  ALBTPU_MUST(header.header_size <= header.offset_to_points && header.offset_to_points <= file_size);
  const std::uint64_t room = file_size - header.offset_to_points;
  std::uint64_t end_of_points = header.offset_to_points;  // Of LAZ: at least.
  if (!header.compressed) {
    ALBTPU_MUST(header.point_count <= room && header.point_count * header.record_length <= room);
    end_of_points = header.end_of_points();
  }
  for (const std::uint64_t start : {header.start_of_evlrs, header.start_of_waveform_packet})
    ALBTPU_MUST(start == 0 || (end_of_points <= start && start <= file_size));
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis)
    ALBTPU_MUST(std::isfinite(header.offset[axis]) && std::isfinite(header.scale[axis]) && header.scale[axis] != 0);
}

// The result starts with the existing description and ends with our entries of 192 bytes.
void CheckExtraBytes(std::string_view described, std::size_t extra_bytes) {
  constexpr std::size_t kEntry = 192, kNameField = 4;
  const std::vector<AppendedFloat> appended = AppendedFloats({.details = true});
  const absl::StatusOr<AppendedDescription> description = DescribeAppended(kName, described, extra_bytes, appended);
  if (!description.ok()) return fuzz::MustExplain(description.status());
  const std::string* const ours = &description->record;
  ALBTPU_MUST(ours->size() % kEntry == 0 && ours->size() >= described.size() + appended.size() * kEntry);
  ALBTPU_MUST(ours->size() <= kLargestExtraBytesRecord);
  ALBTPU_MUST(ours->substr(0, described.size()) == described);
  for (std::size_t i = 0; i < appended.size(); ++i) {
    const std::size_t entry = ours->size() - (appended.size() - i) * kEntry;
    ALBTPU_MUST(ours->substr(entry + kNameField, appended[i].name.size()) == appended[i].name);
  }
  const std::size_t more = appended.size() * sizeof(float);
  ALBTPU_MUST(absl::IsInvalidArgument(DescribeAppended(kName, *ours, extra_bytes + more, appended).status()));
  const auto replacing = DescribeAppended(kName, *ours, extra_bytes + more, appended, true);
  ALBTPU_MUST(replacing.ok() && replacing->record == *ours && replacing->replaced.size() == appended.size());
}

void CheckData(const VlrEntry& entry, std::string_view data, const LasHeader& header) {
  constexpr std::string_view kProjection = "LASF_Projection";
  if (entry.Is(kSpecUser, kExtraBytesRecord)) CheckExtraBytes(data, header.extra_bytes());
  const std::optional<std::string> feet = entry.Is(kProjection, 2112)    ? FindFeetInWkt(data)
                                          : entry.Is(kProjection, 34735) ? FindFeetInGeoKeys(data)
                                                                         : std::nullopt;
  ALBTPU_MUST(!feet.has_value() || feet->size() > 4);
}

void CheckVlrs(std::string_view head, const LasHeader& header) {
  const absl::StatusOr<std::vector<VlrEntry>> entries = ListVlrs(kName, header, head);
  if (!entries.ok()) return fuzz::MustExplain(entries.status());
  ALBTPU_MUST(entries->size() == header.vlr_count);
  std::uint64_t next = header.header_size;
  bool described = false;
  for (const VlrEntry& entry : *entries) {
    ALBTPU_MUST(entry.offset == next && entry.data_offset == next + kVlrHeaderSize);
    ALBTPU_MUST(entry.data_size <= head.size() && entry.end() <= head.size());
    next = entry.end();
    CheckData(entry, head.substr(entry.data_offset, entry.data_size), header);
    described = described || entry.Is(kSpecUser, kExtraBytesRecord);
  }
  if (!described) CheckExtraBytes("", header.extra_bytes());
}

void CheckEvlrs(std::string_view file, const LasHeader& header) {
  std::uint64_t next = header.start_of_evlrs;
  for (std::uint32_t i = 0; i < header.evlr_count && file.size() - next >= kEvlrHeaderSize; ++i) {
    const std::string bytes(file.substr(next, kEvlrHeaderSize));
    const absl::StatusOr<VlrEntry> entry = ParseEvlr(kName, bytes, next, file.size());
    if (!entry.ok()) return fuzz::MustExplain(entry.status());
    ALBTPU_MUST(entry->data_offset == next + kEvlrHeaderSize && entry->data_size <= file.size());
    ALBTPU_MUST(entry->end() <= file.size());
    CheckData(*entry, file.substr(entry->data_offset, entry->data_size), header);
    next = entry->end();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string file(reinterpret_cast<const char*>(data), size);
  const std::string beginning = file.substr(0, kLargestLasHeader);
  const absl::StatusOr<LasHeader> header = ParseLasHeader(kName, beginning, size);
  if (!header.ok()) {
    fuzz::MustExplain(header.status());
    return 0;
  }
  CheckHeader(*header, size);
  CheckVlrs(file.substr(0, header->offset_to_points),
            *header);  // A copy, so that sanitizers detect reads beyond it.
  CheckEvlrs(file, *header);
  return 0;
}
