// A LAS file, repeated with the THU and TVU of each bathymetric point.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/files/output_file.h"
#include "survey/files/progress.h"
#include "survey/las/las_chunk.h"
#include "survey/las/las_classes.h"

namespace albtpu::client {

struct AnnotatedLas {
  int point_format = 0;
  std::uint64_t input_bytes = 0;
  LasClassCounts classes;
  UncertaintySummary summary;
  OutputFile file;  // Whole, but not under its name before Commit().
};

// Points of other classes, and those without an interpolated answer, get no-data. Reads, asks and writes at
// the same time; memory does not grow with the file. Fails, leaving nothing, for all that LasReader,
// AnnotatedHead and the source refuse, when the output is the input, when the coordinate system is in feet
// and no unit is given, and when somebody writes to the input meanwhile.
absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const LasAnnotation& annotation, UncertaintySource& source,
                                         Progress& progress);

}  // namespace albtpu::client
