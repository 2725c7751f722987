// Copies a LAS file and appends THU and TVU to each point.
#pragma once

#include <filesystem>

#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"
#include "survey/answers/uncertainty_summary.h"
#include "survey/files/file_progress.h"
#include "survey/files/output_file.h"
#include "survey/las/las_chunk.h"
#include "survey/las/las_points.h"

namespace albtpu::client {

struct AnnotatedLas {
  int point_format = 0;
  std::uint64_t input_bytes = 0;
  LasClassCounts classes;
  UncertaintySummary summary;
  OutputFile file;  // Complete; Commit() gives it its name.
};

// Bathymetric points with an interpolated answer get their uncertainty, all other points get no-data. Reading, querying
// and writing overlap; memory does not grow with the file. Fails and leaves no output when LasReader, AnnotatedHead or
// the source fails, when the output is the input, when the coordinate system is in feet and no unit is given, and when
// the input is modified meanwhile.
absl::StatusOr<AnnotatedLas> AnnotateLas(const std::filesystem::path& input,
                                         const std::filesystem::path& output, Existing existing,
                                         const LasAnnotation& annotation, UncertaintySource& source,
                                         FileProgress& progress);

}  // namespace albtpu::client
