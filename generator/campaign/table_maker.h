// From a campaign to a table.
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/campaign/unit.h"
#include "tables/table.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// Builds a table from the units of a campaign. The table is a function of the campaign and of the date in
// SOURCE_DATE_EPOCH alone; it does not matter who computed the units and in which order they are added.
class TableBuilder {
 public:
  explicit TableBuilder(const Campaign& campaign);  // must outlive the builder
  ~TableBuilder();
  TableBuilder(const TableBuilder&) = delete;
  TableBuilder& operator=(const TableBuilder&) = delete;

  // Adds a sealed unit; each of UnitsOf(campaign) is added once. Fails when the unit is damaged or was not made for
  // this campaign by this program on this instruction set (OpenUnit in unit.h).
  absl::Status Add(UnitId unit, std::string_view bytes);

  // Requires that all units were added. Call it once.
  absl::StatusOr<Table> Build();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Computes all units of a campaign of a sea in this process (unit_work.h). After each unit, `done` is called with the
// number of finished units, by one thread at a time.
absl::StatusOr<UncertaintyTable> MakeTable(const Campaign& campaign,
                                           const std::function<void(std::size_t)>& done);

}  // namespace albtpu
