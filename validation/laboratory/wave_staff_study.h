// Table 2 of Birkebak et al. (2018): the waves of the tank, as a wave staff measured them.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> WaveStaffStudy(const StudyOptions& options);

}  // namespace albtpu
