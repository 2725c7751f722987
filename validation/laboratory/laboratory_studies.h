// The studies of the paper's laboratory: each a function of its options alone.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

// Table 2 of Birkebak et al. (2018): the waves of the tank, as a wave staff measured them.
absl::StatusOr<Study> WaveStaffStudy(const StudyOptions& options);

// Table 4 of Birkebak et al. (2018): refraction as photodiodes under a wave tank measured it.
absl::StatusOr<Study> LaboratoryStudy(const StudyOptions& options);

}  // namespace albtpu
