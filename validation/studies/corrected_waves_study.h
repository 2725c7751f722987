// Fig. 1a of the paper: gravity waves longer than the footprint, if a local-slope correction takes them away.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> CorrectedWavesStudy(const StudyOptions& options);

}  // namespace albtpu
