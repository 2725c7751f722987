// A campaign of eight sea cases for tests, computed in a few seconds.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "generator/campaign/campaign.h"
#include "generator/campaign/table_maker.h"
#include "generator/campaign/unit_work.h"
#include "generator/ranks/ranks.h"

namespace albtpu {

inline Campaign TwoSeas() {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(R"(id = "small"
version = "1"
title = "Two seas"
[axes]
wind_speed = [3, 6]
fetch = [5000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.25, 1]
depth = [0, 10]
[effort]
realizations = 40
[interpolation]
checked_pulses = 6
)");
  EXPECT_TRUE(campaign.ok()) << campaign.status();
  return *campaign;
}

// The table of a campaign of a sea, computed in this process. After each unit, `done` is called with the number of
// finished units, by one thread at a time.
inline absl::StatusOr<UncertaintyTable> MakeTable(const Campaign& campaign,
                                                  const std::function<void(std::size_t)>& done) {
  TableBuilder builder(campaign);
  std::size_t finished = 0;
  const absl::Status computed = ComputeUnits(campaign, UnitsOf(campaign), *OneRank(),
                                             [&](UnitId unit, const std::string& bytes, const std::string&) {
                                               const absl::Status added = builder.Add(unit, bytes);
                                               done(++finished);
                                               return added;
                                             });
  if (!computed.ok()) return computed;
  absl::StatusOr<Table> table = builder.Build();
  if (!table.ok()) return table.status();
  return UncertaintyTable(*std::move(table));
}

}  // namespace albtpu
