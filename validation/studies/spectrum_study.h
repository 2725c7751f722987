// Figures 2 and 3 of the paper: the spectrum of a young sea, and a beam through a surface drawn from it.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> SpectrumStudy(const StudyOptions& options);

}  // namespace albtpu
