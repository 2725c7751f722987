#include "sea/spectra/wind_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace albtpu {
namespace {

TEST(WindProfile, HasTheDragOfWu) {
  EXPECT_NEAR(std::pow(FrictionVelocity(10) / 10, 2), 1.45e-3, 1e-9);
  EXPECT_NEAR(std::pow(FrictionVelocity(3) / 3, 2), 0.995e-3, 1e-9);
}

TEST(WindProfile, IsLogarithmic) {
  EXPECT_EQ(WindSpeedAt(10, 7), 7);
  EXPECT_NEAR(WindSpeedAt(20, 7) - 7, 7 - WindSpeedAt(5, 7), 1e-12);
  // u* / 0.4 for each factor of e.
  EXPECT_NEAR(WindSpeedAt(10 * std::exp(1), 7) - 7, FrictionVelocity(7) / 0.4, 1e-12);
}

}  // namespace
}  // namespace albtpu
