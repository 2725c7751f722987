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
#include "tables/uncertainty_table.h"

namespace albtpu {

// Puts the units of a campaign together. The table is a function of the campaign and of the date that
// SOURCE_DATE_EPOCH states, whoever computed the units and in whatever order they come.
class TableBuilder {
 public:
  explicit TableBuilder(const Campaign& campaign);  // which outlives the builder
  ~TableBuilder();
  TableBuilder(const TableBuilder&) = delete;
  TableBuilder& operator=(const TableBuilder&) = delete;

  // Each of UnitsOf(campaign) once, as it was sealed. The error is that of a unit which is damaged or not of
  // this campaign, program and instruction set (unit.h).
  absl::Status Add(UnitId unit, std::string_view bytes);

  // Requires that all are there. To be called once, last.
  absl::StatusOr<UncertaintyTable> Build();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Works off all units of a campaign in this process (unit_work.h); `done` is called, by one at a time, after
// each with how many are done.
absl::StatusOr<UncertaintyTable> MakeTable(const Campaign& campaign,
                                           const std::function<void(std::size_t)>& done);

}  // namespace albtpu
