#include "survey/las/las_annotation.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "survey/files/ordered_pipeline.h"
#include "survey/las/las_beams.h"
#include "survey/las/las_extra_bytes.h"
#include "survey/las/las_prescan.h"
#include "survey/las/las_reader.h"
#include "survey/las/las_writer.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

// The largest chunk, in bytes and in records. A server takes no more pulses than this in one message.
constexpr std::size_t kChunkBytes = 8 << 20;
constexpr std::size_t kChunkRecords = 65536;

// Reads the chunk of `own` records after the first `read` ones, and the records around it that may belong to the same
// pulses.
absl::Status ReadChunk(const LasReader& reader, std::uint64_t read, std::uint64_t own,
                       LasChunkWork::Chunk& chunk) {
  const LasHeader& header = reader.header();
  const std::uint64_t length = header.record_length;
  chunk.own = own;
  chunk.before = std::min<std::uint64_t>(kPulseReach, read);
  const std::uint64_t after = std::min<std::uint64_t>(kPulseReach, header.point_count - read - own);
  chunk.records.resize((chunk.before + own + after) * length);
  return reader.ReadAt(header.offset_to_points + (read - chunk.before) * length,
                       std::span<char>(chunk.records));
}

// No sensor for bathymetry looks farther aside in the median of its points.
constexpr float kLargestMedianIncidence = 35;  // degree

absl::Status CheckIncidence(const LasReader& reader, const LasAnnotation& annotation,
                            const CoordinateSpread& incidence) {
  if (!std::holds_alternative<TrajectoryFromFiles>(annotation.plan.source)) return absl::OkStatus();
  if (incidence.count() == 0 || incidence.middle() <= kLargestMedianIncidence) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrFormat("%s: the median incidence by the trajectory is %.1f degrees (the sensors of laser "
                      "bathymetry look at most %g "
                      "degrees aside; the 18 s between UTC and GPS are 1.1 km); check --trajectory-time, "
                      "--crs, --geoid-separation and "
                      "--units, and whether the trajectory is that of this flight",
                      reader.name(), incidence.middle(), kLargestMedianIncidence));
}

// Copies all points from `reader` to the file of `annotated`, with their uncertainty.
absl::Status AnnotatePoints(const LasReader& reader, const LasAnnotation& annotation, const LasBeams& beams,
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
        const absl::Status status = ReadChunk(reader, read_records, count, chunk);
        read_records += count;
        if (!status.ok()) return status;
        return true;
      },
      LasChunkWork(header, annotation, beams.geometry(), beams.has_surface_returns(), source),
      [&](Chunk& chunk) {
        annotated.classes.Merge(chunk.classes);
        annotated.summary.Merge(chunk.summary);
        annotated.surface.Merge(chunk.surface);
        annotated.incidence.Merge(chunk.incidence);
        written_records += chunk.own;
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
  const absl::StatusOr<std::string> head =
      AnnotatedHead(*reader, AppendedFloats(annotation.style.coverage, annotation.details));
  if (!head.ok()) return head.status();
  FileProgress::File file_progress(progress, input.filename().string());
  const absl::StatusOr<std::unique_ptr<LasBeams>> beams = LasBeams::Find(*reader, annotation);
  if (!beams.ok()) {
    // Reading also fails when the input became shorter; the modification is the cause to report.
    const absl::Status changed = reader->CheckUnchanged();
    return changed.ok() ? beams.status() : changed;
  }
  absl::StatusOr<OutputFile> file = OutputFile::Create(output, existing);
  if (!file.ok()) return file.status();

  AnnotatedLas annotated{.point_format = reader->header().point_format,
                         .input_bytes = reader->file_size(),
                         .chosen_classes = annotation.ClassesOf(reader->header().point_format),
                         .classes = {},
                         .summary = UncertaintySummary(annotation.style),
                         .surface = {},
                         .incidence = {},
                         .geometry = {},
                         .notes = {},
                         .file = *std::move(file)};
  absl::Status status = annotated.file.Write(*head);
  if (status.ok()) status = AnnotatePoints(*reader, annotation, **beams, source, file_progress, annotated);
  if (status.ok()) status = CopyTail(*reader, annotated.file);
  if (absl::Status changed = reader->CheckUnchanged(); !changed.ok()) return changed;
  if (!status.ok()) return status;
  if (absl::Status plausible = CheckIncidence(*reader, annotation, annotated.incidence); !plausible.ok()) {
    return plausible;
  }
  annotated.geometry = (*beams)->Json();
  annotated.notes = (*beams)->Notes();
  if (annotated.incidence.count() > 0) {
    const auto least = annotated.incidence.least(), greatest = annotated.incidence.greatest();
    annotated.geometry["incidence"] = {{"least", JsonNumber(least)}, {"greatest", JsonNumber(greatest)}};
    annotated.notes.push_back(absl::StrFormat("incidence %.2f to %.2f degrees", least, greatest));
  }
  if (!annotation.plan.water_classes.empty()) {
    annotated.geometry["water_surface"] = annotated.surface.Json();
    annotated.notes.push_back(absl::StrCat("water surface: ", annotated.surface.Text()));
  }
  return annotated;
}

}  // namespace albtpu::client
