// A campaign of eight sea cases for tests, computed in a few seconds.
#pragma once

#include <gtest/gtest.h>

#include "generator/campaign/campaign.h"

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

}  // namespace albtpu
