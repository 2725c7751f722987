#include "survey/las/las_annotation.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"
#include "survey/files/ordered_pipeline.h"
#include "survey/las/las_chunk.h"
#include "survey/las/las_crs.h"
#include "survey/las/las_reader.h"
#include "survey/las/las_writer.h"

namespace albtpu::client {
namespace {

// The largest chunk, in bytes and in records. A server takes no more pulses than this in one message.
constexpr std::size_t kChunkBytes = 8 << 20;
constexpr std::size_t kChunkRecords = 65536;

absl::Status CheckUnits(const LasReader& reader, const LasAnnotation& annotation) {
  if (annotation.unit_is_given) return absl::OkStatus();
  const absl::StatusOr<std::optional<std::string>> feet = FindFeet(reader);
  if (!feet.ok()) return feet.status();
  if (!feet->has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(reader.name(), ": its coordinate system is in feet (", **feet,
                   "); give the unit of its heights and of --water-level by --units m, ft or us-ft"));
}

// Copies all points from `reader` to the file of `annotated`, with their uncertainty.
absl::Status AnnotatePoints(const LasReader& reader, const LasAnnotation& annotation,
                            UncertaintySource& source, FileProgress::File& progress,
                            AnnotatedLas& annotated) {
  using Chunk = LasChunkWork::Chunk;
  const LasHeader& header = reader.header();
  const std::uint64_t length = header.record_length;
  const std::uint64_t most_records = std::clamp<std::uint64_t>(kChunkBytes / length, 1, kChunkRecords);
  std::uint64_t read_records = 0, written_records = 0;
  return RunOrderedPipeline(
      [&] { return Chunk(annotation.style); },
      [&](Chunk& chunk) -> absl::StatusOr<bool> {
        const std::uint64_t count = std::min(most_records, header.point_count - read_records);
        if (count == 0) return false;
        chunk.records.resize(count * length);
        const std::uint64_t offset = header.offset_to_points + read_records * length;
        read_records += count;
        const absl::Status status = reader.ReadAt(offset, std::span<char>(chunk.records));
        if (!status.ok()) return status;
        return true;
      },
      LasChunkWork(header, annotation, source),
      [&](Chunk& chunk) {
        annotated.classes.Merge(chunk.classes);
        annotated.summary.Merge(chunk.summary);
        written_records += chunk.records.size() / length;
        progress.Reach(header.offset_to_points + written_records * length, written_records);
        return annotated.file.Write(chunk.annotated);
      });
}

}  // namespace

absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const LasAnnotation& annotation, UncertaintySource& source,
                                         FileProgress& progress) {
  if (absl::Status status = CheckNotTheSameFile(input, output); !status.ok()) return status;
  const absl::StatusOr<LasReader> reader = LasReader::Open(input);
  if (!reader.ok()) return reader.status();
  if (absl::Status status = CheckUnits(*reader, annotation); !status.ok()) return status;
  const absl::StatusOr<std::string> head = AnnotatedHead(*reader, annotation.style.coverage);
  if (!head.ok()) return head.status();
  absl::StatusOr<OutputFile> file = OutputFile::Create(output, existing);
  if (!file.ok()) return file.status();

  AnnotatedLas annotated{.point_format = reader->header().point_format,
                         .input_bytes = reader->file_size(),
                         .classes = {},
                         .summary = UncertaintySummary(annotation.style),
                         .file = *std::move(file)};
  FileProgress::File file_progress(progress, input.filename().string());
  absl::Status status = annotated.file.Write(*head);
  if (status.ok()) status = AnnotatePoints(*reader, annotation, source, file_progress, annotated);
  if (status.ok()) status = CopyTail(*reader, annotated.file);
  // Reading also fails when the input became shorter; the modification is the cause to report.
  if (absl::Status changed = reader->CheckUnchanged(); !changed.ok()) return changed;
  if (!status.ok()) return status;
  return annotated;
}

}  // namespace albtpu::client
