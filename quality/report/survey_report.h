// The report of a survey, from its annotated files: whether it meets the specification, and where and why not.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "annotate/answers/json_box.h"
#include "annotate/seas/sea_timeline.h"
#include "quality/annotated/annotated_points.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/report/grid_file.h"
#include "quality/report/land_table.h"
#include "quality/report/specification.h"
#include "quality/report/survey_grid.h"

namespace albtpu::quality {

inline constexpr double kDefaultPassShare = 95;  // %, of the points; NOAA asks it of the nodes of a surface.

struct ReportOptions {
  double cell = 1;                            // m
  std::vector<Specification> specifications;  // All that the report covers.
  std::string specification, wanted_class;    // The required one: names of one of them.
  double pass_share = kDefaultPassShare;      // %
  double patch = kDefaultPatch;               // m
  CheckPointErrors check_points = {};         // That land will be held against.
  // [project] of a survey file, which comes before that of the files, and the name of their vertical datum if it is
  // given there: keys and their text.
  std::vector<std::pair<std::string, std::string>> project = {};
  std::string vertical_datum = {};
  annotate::JsonBox surface = {};  // surface.json of the same files; null: not given.
  // The waves that the files were annotated with; null: those of the winds that they state.
  const annotate::SeaTimeline* seas = nullptr;
};

// Everything that determines the report: the files by name and size, and the options. It is `made_from` in the JSON.
nlohmann::ordered_json MadeFrom(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options);

struct SurveyReport {
  annotate::JsonBox json;
  SurveyGrid grid;
  GridFileFacts facts;
};

// Reads all points of `files`, which is not empty, once for the report and once more where lines overlap. Memory is
// bounded by the grid (SurveyGrid::kMostBytes) and the patches (OverlapPatches). FailedPrecondition if there is no
// point of a bathymetric class.
absl::StatusOr<SurveyReport> MakeReport(const std::vector<AnnotatedLasFile>& files, const ReportOptions& options);

}  // namespace albtpu::quality
