// The shipped table of the water column, for targets with SHIPPED_WATER_TABLE.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "tables/file/table_io.h"
#include "tables/water/water_column_table.h"

namespace albtpu::testing {

// Read once.
inline std::shared_ptr<const WaterColumnTable> ShippedWaterTable() {
  static const auto table = std::make_shared<const WaterColumnTable>(
      WaterColumnTable::Create(ReadTable(SHIPPED_WATER_TABLE, kWaterColumn).value()).value());
  return table;
}

}  // namespace albtpu::testing
