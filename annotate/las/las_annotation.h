// Copies a LAS or LAZ file and appends the uncertainty of each chosen point, and on request the geometry of its beam.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/answers/uncertainty_summary.h"
#include "annotate/las/las_chunk.h"
#include "annotate/run/file_progress.h"
#include "formats/files/file_access.h"
#include "formats/las/las_points.h"
#include "formats/las/las_reader.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::annotate {

struct AnnotatedLas {
  int point_format = 0;
  std::uint64_t input_bytes = 0;
  formats::LasKind input_kind = formats::LasKind::kLas, output_kind = formats::LasKind::kLas;
  bool copc_index_left_out = false;
  std::set<int> chosen_classes = {};
  formats::LasClassCounts classes = {};
  std::uint64_t withheld = 0, synthetic = 0;  // Of the chosen classes; withheld ones have no number.
  UncertaintySummary summary;
  TotalSummary totals = {};  // Empty without a total; so are the next two.
  std::map<int, TotalSummary> totals_by_line = {};
  std::uint64_t sigmas_assumed = 0;
  // By channel of the annotation: points that may get a number, and totals. Dry points of none.
  std::vector<std::uint64_t> points_by_channel = {};
  std::vector<TotalSummary> totals_by_channel = {};
  std::uint64_t dry_without_channel = 0;
  DrySummary dry = {};
  std::uint64_t sloped = 0;  // Dry points whose total has the slope of the terrain.
  // By class: points below the water that are not of the ground, which have no number. And points of the ground there.
  std::map<int, std::uint64_t> submerged = {};
  std::uint64_t low_ground = 0;
  SurfaceCounts surface = {};
  CoordinateSpread incidence = {};      // degree
  JsonBox geometry = {};                // The determination of the beams, for a summary.
  JsonBox sea = {};                     // The same for the sea; null where a table of winds answers.
  std::vector<std::string> notes = {};  // For the user, a line each.
  OutputFile file;                      // Complete; Commit() gives it its name.
  std::optional<OutputFile> csv = {};   // The same beside it, where both are wanted.
};

// Where the points go: as LAS or LAZ, as CSV, or both; empty: not wanted.
struct LasOutputs {
  std::filesystem::path las, csv;
};

// `file` of the result is the LAS file where one is wanted, otherwise the CSV (LasCsv), with a line for each point.
// Points of the chosen classes with an interpolated answer get their uncertainty, all other points get no-data.
// `kind` is that of the output; absent: that of the input. Reading, querying and writing overlap; memory does not grow
// with the file. Fails and leaves no output when LasReader, PlaceOf, the track, AnnotatedHead or the source fails, when
// the output is the input, and when the input is modified meanwhile.
absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input, const LasOutputs& outputs,
                                         Existing existing, const LasAnnotation& annotation, const AnswerSource& source,
                                         FileProgress& progress, std::optional<formats::LasKind> kind = std::nullopt);

}  // namespace albtpu::annotate
