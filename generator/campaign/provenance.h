// What a table made by a campaign says of itself: enough to trust it and to make it again.
#pragma once

#include <string>
#include <vector>

#include "generator/campaign/campaign.h"
#include "generator/campaign/interpolation_check.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

Provenance MakeProvenance(const Campaign& campaign, const std::vector<SeaCaseResult>& results);

// Adds how far the table is off between its nodes. `errors` are those of kChecked.
void DescribeInterpolationErrors(const std::vector<InterpolationError>& errors, Provenance& provenance);

// Now, or the time of SOURCE_DATE_EPOCH where it is set, as 2026-01-31T12:00:00Z.
std::string DateCreated();

}  // namespace albtpu
