// From a campaign to a table.
#pragma once

#include <functional>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign.h"
#include "generator/monte_carlo.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Works off the encounters of a campaign on all threads of the current TBB arena; `done` is called, by one at a time,
// after each with how many are done. The table is a function of the campaign and of the date that
// SOURCE_DATE_EPOCH states.
absl::StatusOr<UncertaintyTable> MakeTable(const Campaign& campaign,
                                           const std::function<void(std::size_t)>& done);

// The same from the closed form: refraction, THU and TVU, no biases and no standard errors.
absl::StatusOr<UncertaintyTable> MakeClosedFormTable(const Campaign& campaign);

// What interpolation adds between the nodes of a campaign: the closed form interpolated as the table is, over
// the closed form itself, less 1, at pulses drawn evenly over the axes (log axes in log). Magnitudes, in
// increasing order.
struct InterpolationError {
  std::vector<double> refraction_along_wind, thu;
};
absl::StatusOr<InterpolationError> MeasureInterpolationError(const Campaign& campaign);

}  // namespace albtpu
