// The paper's own numbers as lookup tables, so that programs can answer with them beside ours: published
// angles, THU and TVU by the angle method. They hold neither biases nor standard errors, for the paper gives
// none.
#pragma once

#include "absl/status/statusor.h"
#include "tables/uncertainty_table.h"
#include "validation/published/published_angles.h"

namespace albtpu {

// Table 4: what the photodiodes measured, at a footprint of 0.25 m, depths from 1 to 10 m.
absl::StatusOr<UncertaintyTable> MeasuredTable(const PublishedAngles& table_4);

// Eq. 27-30, over the winds, incidences and diameters of Table 1 and depths from 1 to 10 m. The nodes are
// close enough that interpolation departs from the equations by less than 0.5 % in refraction and THU, and by
// less than 0.1 mm per m of depth in TVU.
absl::StatusOr<UncertaintyTable> ModelTable();

}  // namespace albtpu
