// The shipped table of the water column, for targets with SHIPPED_WATER_TABLE.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tables/file/table_io.h"
#include "tables/water/water_column_table.h"

namespace albtpu::testing {

// Read once.
inline std::shared_ptr<const WaterColumnTable> ShippedWaterTable() {
  static const auto table = std::make_shared<const WaterColumnTable>(
      WaterColumnTable::Create(ReadTable(SHIPPED_WATER_TABLE, kWaterColumn).value()).value());
  return table;
}

// Writes the same table as another version, which its digest does not cover.
inline absl::Status WriteWaterTable(const std::string& version, const std::filesystem::path& path) {
  const Table& shipped = ShippedWaterTable()->table();
  Provenance provenance = shipped.provenance();
  provenance.version = version;
  Table::Variables variables;
  for (std::size_t q = 0; q < kWaterQuantityCount; ++q) variables.emplace_back(*shipped.variable(q));
  return WriteTable(Table::Create(kWaterColumn, shipped.axes(), std::move(variables), provenance).value(), path,
                    Existing::kReplace);
}

}  // namespace albtpu::testing
