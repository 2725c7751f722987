// Table 4 of Birkebak et al. (2018): refraction as photodiodes under a wave tank measured it.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> LaboratoryStudy(const StudyOptions& options);

}  // namespace albtpu
