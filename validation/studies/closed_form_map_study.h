// The closed form everywhere: where the small-slope theory holds over the domain of a survey, and where it
// fails.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

absl::StatusOr<Study> ClosedFormMapStudy(const StudyOptions& options);

}  // namespace albtpu
