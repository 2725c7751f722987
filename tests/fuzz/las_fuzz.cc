// Arbitrary bytes as a LAS file are rejected with a reason, or annotated such that every byte is kept and the output
// is a LAS file that describes its uncertainties.
#include <algorithm>
#include <string>
#include <string_view>

#include "service/client/local_source.h"
#include "survey/las/las_chunk.h"
#include "survey/las/las_crs.h"
#include "survey/las/las_extra_bytes.h"
#include "survey/las/las_reader.h"
#include "survey/las/las_writer.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/memory_file.h"
#include "tests/tables/synthetic_table.h"

namespace {

using namespace albtpu;
using namespace albtpu::client;

LasAnnotation Annotation() {
  LasAnnotation annotation;
  for (int point_class = 0; point_class < kClassCount; point_class += 2) {
    annotation.classes.insert(point_class);
  }
  annotation.flight_line.wind_speed = 5;
  annotation.flight_line.footprint = DivergingBeam{.altitude = 400, .divergence = 1};
  annotation.flight_line.azimuth = AcrossTrackScan{.flight_direction = 10, .wind_from = 200};
  return annotation;
}

void MustExplain(const absl::Status& status) {
  ALBTPU_MUST(absl::IsInvalidArgument(status) || absl::IsDataLoss(status));
  ALBTPU_MUST(status.message().size() > 20);
}

std::string_view Record(std::string_view file, const LasHeader& header, std::size_t i) {
  return file.substr(header.offset_to_points + i * header.record_length, header.record_length);
}

void CheckRecords(std::string_view before, const LasHeader& old_header, std::string_view after,
                  const LasHeader& header) {
  ALBTPU_MUST(header.point_count == old_header.point_count && header.point_format == old_header.point_format);
  ALBTPU_MUST(header.record_length == old_header.record_length + kAppendedBytes);
  for (std::size_t i = 0; i < header.point_count; ++i) {
    const std::string_view record = Record(after, header, i);
    ALBTPU_MUST(record.substr(0, old_header.record_length) == Record(before, old_header, i));
    const auto thu = Load<float>(record, old_header.record_length);
    const auto tvu = Load<float>(record, old_header.record_length + sizeof(float));
    ALBTPU_MUST((thu == kNoUncertainty && tvu == kNoUncertainty) || (thu >= 0 && tvu >= 0));
  }
}

void CheckVlrs(std::string_view before, const std::vector<VlrEntry>& old_entries, std::string_view after,
               const std::vector<VlrEntry>& entries) {
  const auto is_ours = [](const VlrEntry& entry) { return entry.Is(kSpecUser, kExtraBytesRecord); };
  std::size_t i = 0;
  for (const VlrEntry& old_entry : old_entries) {
    while (i < entries.size() && is_ours(entries[i]) && !is_ours(old_entry)) ++i;
    ALBTPU_MUST(i < entries.size());
    if (!is_ours(old_entry)) {
      const auto all = [](std::string_view file, const VlrEntry& entry) {
        return file.substr(entry.offset, entry.end() - entry.offset);
      };
      ALBTPU_MUST(all(before, old_entry) == all(after, entries[i]));
    }
    ++i;
  }
}

std::string Annotated(std::string_view file, const LasReader& reader, const std::string& head) {
  static LocalSource source("", testing::SyntheticTable());
  static const LasAnnotation annotation = Annotation();
  const LasHeader& header = reader.header();
  LasChunkWork::Chunk chunk((AnswerStyle()));
  chunk.records = file.substr(header.offset_to_points, header.point_count * header.record_length);
  ALBTPU_MUST(LasChunkWork(header, annotation, source)(chunk).ok());
  return head + chunk.annotated + std::string(file.substr(header.end_of_points()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile input, output;
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  input.Write(file);
  const absl::StatusOr<LasReader> reader = LasReader::Open(input.path());
  if (!reader.ok()) {
    MustExplain(reader.status());
    return 0;
  }
  ALBTPU_MUST(FindFeet(*reader).ok());
  const absl::StatusOr<std::string> head = AnnotatedHead(*reader, Coverage::kTwoSigma);
  if (!head.ok()) {
    MustExplain(head.status());
    return 0;
  }
  const std::string annotated = Annotated(file, *reader, *head);
  output.Write(annotated);
  const absl::StatusOr<LasReader> again = LasReader::Open(output.path());
  ALBTPU_MUST(again.ok());
  CheckRecords(file, reader->header(), annotated, again->header());
  CheckVlrs(file, reader->vlrs(), annotated, again->vlrs());
  CheckVlrs(file, reader->evlrs(), annotated, again->evlrs());
  ALBTPU_MUST(absl::IsInvalidArgument(AnnotatedHead(*again, Coverage::kTwoSigma).status()));
  return 0;
}
