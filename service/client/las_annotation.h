// A LAS file, repeated with the THU and TVU of each bathymetric point.
#pragma once

#include <filesystem>
#include <optional>
#include <set>

#include "absl/status/statusor.h"
#include "service/client/answer_columns.h"
#include "service/client/beam_geometry.h"
#include "service/client/las_summary.h"
#include "service/client/output_file.h"
#include "service/client/uncertainty_source.h"
#include "tables/table_io.h"

namespace albtpu::client {

struct LasAnnotation {
  std::set<int> classes;  // Those that are the bottom seen through water.
  FlightLine flight_line;
  bool unit_is_given = false;  // Then feet in the coordinate system are no surprise.
  AnswerStyle style;
};

struct AnnotatedLas {
  int point_format = 0;
  LasSummary summary;
  OutputFile file;  // Whole, but not under its name before Commit().
};

// Points of other classes, and those without an interpolated answer, get no-data. Memory does not grow with
// the file. Fails, leaving nothing, for all that LasReader, AnnotatedHead and the source refuse, when the
// output is the input, and when the coordinate system is in feet and no unit is given.
absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const LasAnnotation& annotation, UncertaintySource& source);

}  // namespace albtpu::client
