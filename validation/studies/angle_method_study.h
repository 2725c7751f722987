// Table 5: THU and TVU of the laboratory's angles, beside the limits of IHO S-44.
#pragma once

#include "absl/status/statusor.h"
#include "validation/report/study.h"

namespace albtpu {

// Table 5 by the angle method, from the measured angles of Table 4 at 20 degrees and 5.25 m/s: by quadrature
// and with the paper's 10,000 draws.
absl::StatusOr<Study> AngleMethodStudy(const StudyOptions& options);

}  // namespace albtpu
