// What a table made by a campaign says of itself: enough to trust it and to make it again.
#pragma once

#include <string>
#include <vector>

#include "generator/campaign.h"
#include "generator/interpolation_check.h"
#include "generator/monte_carlo.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

Provenance MakeProvenance(const Campaign& campaign, const std::vector<EncounterResult>& results);

// Adds how far the table is off between its nodes. `errors` are those of kChecked.
void DescribeInterpolationErrors(const std::vector<InterpolationError>& errors, Provenance& provenance);

// The instructions that this machine runs our libraries with, as the microarchitecture level of the x86-64 psABI
// ("x86-64-v3"), or the name of another architecture. FFTW and the C library choose by it, so the last bit
// depends on it.
std::string InstructionSet();

// Now, or the time of SOURCE_DATE_EPOCH where it is set, as 2026-01-31T12:00:00Z.
std::string DateCreated();

}  // namespace albtpu
