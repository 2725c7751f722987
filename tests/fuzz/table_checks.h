// What must hold for every table that is accepted, however it came about.
#pragma once

#include "tables/table.h"
#include "tables/uncertainty_table.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {

// Aborts unless both interpolators agree: on nodes, between them and outside the table, with and without azimuth.
// Large tables are not interpolated.
void CheckAnswers(const UncertaintyTable& table);

// Aborts unless a table of the water column is refused with a reason, or has an answer within its nodes and none beyond
// them. Large tables are not interpolated.
void CheckWater(Table table);

// For the nodes and values of a table.
float AnyTableNumber(Random& random);

}  // namespace albtpu::fuzz
