#include "annotate/las/las_annotation.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "annotate/las/las_beams.h"
#include "annotate/las/las_csv.h"
#include "annotate/las/las_prescan.h"
#include "annotate/seas/sea_facts.h"
#include "formats/files/ordered_pipeline.h"
#include "formats/las/las_extra_bytes.h"
#include "formats/las/las_points.h"
#include "formats/las/las_writer.h"
#include "formats/text/text.h"
#include "laz/items/point_encoders.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

// The largest chunk of LAS, in bytes and in records. A server takes no more pulses than this in one message.
constexpr std::size_t kChunkBytes = 8 << 20;
constexpr std::size_t kChunkRecords = 65536;

// A chunk on its way from file to file.
struct Passing {
  LasChunkWork::Chunk chunk;
  std::unique_ptr<laz::ChunkEncoder> encoder;  // Null for LAS.
  std::string compressed;

  std::string_view output() const { return encoder != nullptr ? compressed : chunk.annotated; }
};

// No bathymetric sensor has a larger median incidence.
constexpr float kLargestMedianIncidence = 35;  // degree

// No scanner looks aside as little as this. Programs that write whole degrees into the field of formats 6 to 10, which
// counts steps of 0.006 degrees, make a 167th of 20 degrees.
constexpr float kLeastScan = 0.5;             // degree, to one side
constexpr std::uint64_t kEnoughAngles = 100;  // Of a few points near the middle, nothing is wrong.

absl::Status CheckScanAngles(const formats::LasReader& reader, const CoordinateSpread& incidence) {
  if (incidence.count() < kEnoughAngles || incidence.greatest() >= kLeastScan) return absl::OkStatus();
  if (incidence.greatest() == 0) {
    return absl::FailedPreconditionError(
        absl::StrCat(reader.name(),
                     ": all scan angles are 0, so that nobody recorded them; give --trajectory, "
                     "--trajectory-from-returns or --incidence"));
  }
  return absl::FailedPreconditionError(
      absl::StrFormat("%s: all scan angles are within %.2g degrees (a scanner swings by 10 to 30), so that they are "
                      "probably in another "
                      "unit, such as whole degrees where point formats 6 to 10 count steps of %g; give --trajectory, "
                      "--trajectory-from-returns or --incidence",
                      reader.name(), incidence.greatest(), formats::kModernScanAngleStep));
}

absl::Status CheckIncidence(const formats::LasReader& reader, const LasAnnotation& annotation,
                            const CoordinateSpread& incidence) {
  if (std::holds_alternative<AcrossTrackScan>(annotation.plan.source)) return CheckScanAngles(reader, incidence);
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

void NoteChannels(const LasAnnotation& annotation, AnnotatedLas& annotated) {
  const std::uint64_t bathymetric = annotated.summary.outcomes().count(NoPulse::kNoChannel);
  if (const std::uint64_t none = bathymetric + annotated.dry_without_channel; none > 0)
    annotated.notes.push_back(
        absl::StrCat(none, " points belong to no channel of [[sensor.channel]] and have no number (NO_CHANNEL); ",
                     bathymetric, " of them are bathymetric"));
  for (std::size_t i = 0; i < annotation.channels.size(); ++i)
    if (annotated.points_by_channel[i] == 0)
      annotated.notes.push_back(absl::StrCat("no point is of ", annotation.channels[i].label));
}

// The bytes of the file that hold `points` points; compressed points count as equally long.
std::uint64_t BytesOf(const formats::LasReader& reader, std::uint64_t points) {
  const formats::LasHeader& header = reader.header();
  if (reader.kind() == formats::LasKind::kLas) return header.offset_to_points + points * header.record_length;
  const laz::LazExtent& extent = reader.extent();
  const double part = static_cast<double>(points) / static_cast<double>(header.point_count);
  return extent.points_begin +
         static_cast<std::uint64_t>(part * static_cast<double>(extent.points_end - extent.points_begin));
}

// Copies the file of `reader` to that of `annotated`, with the uncertainty of its points. Without a `head` that of
// `annotated` is the CSV.
absl::Status AnnotatePoints(const formats::LasReader& reader, const std::optional<formats::LasHead>& head,
                            const LasAnnotation& annotation, const LasBeams& beams, const AnswerSource& source,
                            FileProgress::File& progress, AnnotatedLas& annotated) {
  const formats::LasHeader& header = reader.header();
  const bool compressed = head.has_value() && head->record.has_value();
  const std::uint64_t max_records =
      compressed ? head->record->chunk_size
                 : std::clamp<std::uint64_t>(kChunkBytes / header.record_length, 1, kChunkRecords);
  std::optional<formats::LasWriter> writer;
  if (head.has_value()) writer.emplace(reader, *head, annotated.file);
  OutputFile* const csv_file = !head.has_value()           ? &annotated.file
                               : annotated.csv.has_value() ? &*annotated.csv
                                                           : nullptr;
  ASSIGN_OR_RETURN(formats::LasPointRuns runs, formats::LasPointRuns::Open(reader, kPulseReach, kPulseReach));
  if (writer.has_value()) RETURN_IF_ERROR(writer->Begin());
  const std::vector<formats::ReplacedFloat> replaced =
      head.has_value() ? head->replaced : std::vector<formats::ReplacedFloat>();
  LasChunkWork work(header, annotation, replaced, beams.geometries(), beams.utc(), beams.has_surface_returns(), source,
                    beams.terrain());
  const LasCsv csv(header, beams.place(), annotation.appended());
  if (csv_file != nullptr) {
    work.MakeCsv(&csv);
    RETURN_IF_ERROR(csv_file->Write(csv.head()));
  }
  // The layers of fields that stay as they are need not be encoded again.
  std::optional<laz::CommonLayers> common;
  if (compressed && reader.kind() == formats::LasKind::kLaz) common.emplace(reader.extent().record, *head->record);
  std::uint64_t written_records = 0;
  const absl::Status status = formats::RunOrderedPipeline(
      [&] {
        return Passing{.chunk = LasChunkWork::Chunk(annotation.style_of_sea()),
                       .encoder = compressed ? laz::ChunkEncoder::For(*head->record) : nullptr,
                       .compressed = {}};
      },
      [&](Passing& passing) { return runs.Next(max_records, passing.chunk); },
      [&](Passing& passing) -> absl::Status {
        RETURN_IF_ERROR(work(passing.chunk));
        if (passing.encoder == nullptr) return absl::OkStatus();
        std::string original;
        std::vector<std::string_view> known;
        if (common.has_value() && !common->empty()) {
          ASSIGN_OR_RETURN(original, runs.ReadChunk(passing.chunk));
          known = common->Of(original);
        }
        passing.encoder->Encode(passing.chunk.annotated, passing.compressed, known);
        return absl::OkStatus();
      },
      [&](Passing& passing) -> absl::Status {
        const LasChunkWork::Chunk& chunk = passing.chunk;
        annotated.classes.Merge(chunk.classes);
        annotated.withheld += chunk.withheld;
        annotated.synthetic += chunk.synthetic;
        annotated.summary.Merge(chunk.summary);
        annotated.totals.Merge(chunk.totals);
        annotated.dry.Merge(chunk.dry);
        annotated.sloped += chunk.sloped;
        for (const auto& [point_class, points] : chunk.submerged) annotated.submerged[point_class] += points;
        annotated.low_ground += chunk.low_ground;
        for (const auto& [line, summary] : chunk.totals_by_line) annotated.totals_by_line[line].Merge(summary);
        for (std::size_t i = 0; i < annotated.points_by_channel.size(); ++i) {
          annotated.points_by_channel[i] += chunk.points_by_channel[i];
          annotated.totals_by_channel[i].Merge(chunk.totals_by_channel[i]);
        }
        annotated.dry_without_channel += chunk.dry_without_channel;
        annotated.sigmas_assumed += chunk.sigmas_assumed;
        annotated.surface.Merge(chunk.surface);
        annotated.incidence.Merge(chunk.incidence);
        written_records += chunk.own;
        progress.Reach(BytesOf(reader, written_records), written_records);
        if (csv_file != nullptr) RETURN_IF_ERROR(csv_file->Write(chunk.csv));
        return writer.has_value() ? writer->Write(passing.output(), chunk.own) : absl::OkStatus();
      });
  return status.ok() && writer.has_value() ? writer->End(runs.tail_begin(), runs.tail_end()) : status;
}

// Points under the water of classes that are not taken as bathymetric.
void NoteSubmerged(AnnotatedLas& annotated) {
  std::uint64_t unclassified = 0, others = 0;
  std::vector<std::string> classes;
  for (const auto& [point_class, points] : annotated.submerged) {
    (formats::IsUnclassified(point_class) ? unclassified : others) += points;
    if (!formats::IsUnclassified(point_class)) classes.push_back(absl::StrCat(point_class));
  }
  const auto note = [&](std::uint64_t points, const std::string& of, const std::string& what) {
    if (points == 0) return;
    annotated.notes.push_back(absl::StrCat(points, of, " lie below the water surface and ", what,
                                           "; --classes with their class makes them bathymetric"));
  };
  note(unclassified, " unclassified points", "have no number");
  note(others, absl::StrCat(" points of class ", absl::StrJoin(classes, " and ")), "have no number");
  note(annotated.low_ground, " points of the ground", "have the numbers of land");
}

}  // namespace

absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input, const LasOutputs& outputs,
                                         Existing existing, const LasAnnotation& annotation, const AnswerSource& source,
                                         FileProgress& progress, std::optional<formats::LasKind> kind) {
  const bool las = !outputs.las.empty();
  for (const std::filesystem::path& output : {outputs.las, outputs.csv})
    if (!output.empty()) RETURN_IF_ERROR(formats::CheckNotTheSameFile(input, output));
  ASSIGN_OR_RETURN(const formats::LasReader reader, formats::LasReader::Open(input));
  const formats::LasKind output_kind = kind.value_or(reader.kind());
  std::optional<formats::LasHead> head;
  if (las) {
    ASSIGN_OR_RETURN(head, formats::AnnotatedHead(reader, formats::AppendedFloats(annotation.appended()), output_kind,
                                                  annotation.replace));
  }
  FileProgress::File file_progress(progress, input.filename().string());
  const absl::StatusOr<std::unique_ptr<LasBeams>> beams = LasBeams::Find(reader, annotation);
  if (!beams.ok()) {
    // Reading also fails when the input became shorter; the modification is the cause to report.
    const absl::Status changed = reader.CheckUnchanged();
    return changed.ok() ? beams.status() : changed;
  }
  ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(las ? outputs.las : outputs.csv, existing));
  std::optional<OutputFile> csv;
  if (las && !outputs.csv.empty()) {
    ASSIGN_OR_RETURN(csv, OutputFile::Create(outputs.csv, existing));
  }

  AnnotatedLas annotated{.point_format = reader.header().point_format,
                         .input_bytes = reader.file_size(),
                         .input_kind = reader.kind(),
                         .output_kind = output_kind,
                         .copc_index_left_out = las && formats::HasCopcIndex(reader),
                         .chosen_classes = annotation.ClassesOf(reader.header().point_format),
                         .summary = UncertaintySummary(annotation.style_of_sea()),
                         .points_by_channel = std::vector<std::uint64_t>(annotation.channels.size()),
                         .totals_by_channel = std::vector<TotalSummary>(annotation.channels.size()),
                         .file = std::move(file),
                         .csv = std::move(csv)};
  const absl::Status status = AnnotatePoints(reader, head, annotation, **beams, source, file_progress, annotated);
  RETURN_IF_ERROR(reader.CheckUnchanged());
  if (!status.ok()) return status;
  RETURN_IF_ERROR(CheckIncidence(reader, annotation, annotated.incidence));
  annotated.geometry = JsonBox((*beams)->Json());
  annotated.notes = (*beams)->Notes();
  if (const LasTerrain terrain = (*beams)->terrain(); terrain.planes != nullptr) {
    const std::string from = terrain.is_classified ? "ground" : "unclassified";
    (*annotated.geometry)["terrain"] = {{"cell", terrain.planes->cell()}, {"from", from}, {"points", annotated.sloped}};
    annotated.notes.push_back(
        absl::StrFormat("terrain slope: known at %d of %d dry points, from planes of %s points within %g m",
                        annotated.sloped, annotated.dry.count(), from, 1.5 * terrain.planes->cell()));
  }
  NoteSubmerged(annotated);
  if (annotated.withheld > 0)
    annotated.notes.push_back(absl::StrCat(
        annotated.withheld, " bathymetric points are withheld and have no number; --use-withheld gives them one"));
  if (annotated.synthetic > 0)
    annotated.notes.push_back(
        absl::StrCat(annotated.synthetic,
                     " bathymetric points are synthetic: no pulse measured them, and their numbers are those "
                     "of a pulse there"));
  if (!annotation.channels.empty()) NoteChannels(annotation, annotated);
  if (annotated.incidence.count() > 0) {
    const auto least = annotated.incidence.least(), greatest = annotated.incidence.greatest();
    (*annotated.geometry)["incidence"] = {{"least", formats::JsonNumber(least)},
                                          {"greatest", formats::JsonNumber(greatest)}};
    annotated.notes.push_back(absl::StrFormat("incidence %.2f to %.2f degrees", least, greatest));
  }
  if (!annotation.plan.water_classes.empty()) {
    (*annotated.geometry)["water_surface"] = annotated.surface.Json();
    annotated.notes.push_back(absl::StrCat("water surface: ", annotated.surface.Text()));
  }
  if (annotated.sigmas_assumed > 0) {
    annotated.notes.push_back(absl::StrCat("nothing states the errors of the trajectory at ",
                                           annotated.sigmas_assumed, " points; those of a good one are assumed"));
  }
  if (annotation.seas != nullptr) {
    const auto [first, last] = (*beams)->records();
    annotated.sea = JsonBox(SeasJson(*annotation.seas, first, last));
    const std::vector<std::string> notes = SeasNotes(*annotation.seas, first, last);
    annotated.notes.insert(annotated.notes.end(), notes.begin(), notes.end());
  }
  if (annotated.copc_index_left_out) {
    annotated.notes.push_back(
        "the index of COPC is left out, as it does not know the new bytes: the output is no COPC");
  }
  return annotated;
}

}  // namespace albtpu::annotate
