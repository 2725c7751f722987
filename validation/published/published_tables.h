// The paper's numbers as lookup tables, so that programs can compare them with ours: the published angles, with THU
// and TVU by the angle method. They hold neither biases nor standard errors, because the paper gives none.
#pragma once

#include "absl/status/statusor.h"
#include "tables/uncertainty_table.h"
#include "validation/published/published_angles.h"

namespace albtpu {

// Table 4: the angles measured by the photodiodes, for a footprint of 0.25 m and depths from 1 to 10 m.
absl::StatusOr<UncertaintyTable> MeasuredTable(const PublishedAngles& table_4);

// Eq. 27-30, for the winds, incidences and diameters of Table 1 and depths from 1 to 10 m. The nodes are close enough
// that interpolation differs from the equations by less than 0.5 % in refraction and THU, and by less than 0.1 mm per
// m of depth in TVU.
absl::StatusOr<UncertaintyTable> ModelTable();

}  // namespace albtpu
