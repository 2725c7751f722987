#include <gtest/gtest.h>

#include "annotate/beams/file_track.h"

namespace albtpu::annotate {
namespace {

TEST(LocalFrame, TurnsEachAxisIntoMetresFromTheOrigin) {
  const LocalFrame frame = {
      .origin_x = 1000, .origin_y = 2000, .metres_per_x = 0.25, .metres_per_y = 0.5, .metres_per_z = 0.125};
  EXPECT_EQ(frame.At(1000, 2000, 0), Eigen::Vector3d::Zero());
  EXPECT_EQ(frame.At(1004, 1998, 16), Eigen::Vector3d(1, -1, 2));
}

TEST(LocalFrame, KeepsHeightsInTheirDatum) {
  const LocalFrame frame = {.origin_x = 1000, .origin_y = 2000};
  EXPECT_EQ(frame.Z(-23.5), -23.5);
}

}  // namespace
}  // namespace albtpu::annotate
