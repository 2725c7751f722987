// The spectra beside what was measured of real seas, and what one in place of the other does to a beam.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> RealSeaStudy(const StudyOptions& options);

}  // namespace albtpu
