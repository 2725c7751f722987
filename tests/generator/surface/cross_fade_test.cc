#include "generator/surface/cross_fade.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

TEST(CrossFade, LeavesLongWavesToThePlaneWavesAndShortOnesToThePatch) {
  const CrossFade share(3, 6);
  EXPECT_EQ(share(0.1), 0);
  EXPECT_EQ(share(3), 0);
  EXPECT_EQ(share(6), 1);
  EXPECT_EQ(share(1000), 1);
}

TEST(CrossFade, RisesSteadilyThroughOneHalfAtTheGeometricMean) {
  const CrossFade share(2, 8);
  EXPECT_NEAR(share(4), 0.5, 1e-15);
  for (double k = 2; k < 8; k *= 1.05) EXPECT_LT(share(k), share(k * 1.05));
}

}  // namespace
}  // namespace albtpu
