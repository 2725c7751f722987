// Table 3, Figures 8 and 9, Eq. 27-30: the paper's Monte Carlo beside ours.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> PaperMonteCarloStudy(const StudyOptions& options);

}  // namespace albtpu
