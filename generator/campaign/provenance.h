// The provenance of a table: everything needed to judge it and to make it again.
#pragma once

#include <string>
#include <vector>

#include "generator/campaign/campaign.h"
#include "generator/campaign/interpolation_check.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The attributes of tables of every kind.
Provenance CommonProvenance(const Campaign& campaign);

// Of a table of the sea.
Provenance MakeProvenance(const Campaign& campaign, const std::vector<SeaCaseResult>& results);

// Adds the interpolation errors of the table, given for the quantities of kChecked.
void DescribeInterpolationErrors(const std::vector<InterpolationError>& errors, Provenance& provenance);

// The current time, or that of SOURCE_DATE_EPOCH where it is set, as 2026-01-31T12:00:00Z.
std::string DateCreated();

}  // namespace albtpu
