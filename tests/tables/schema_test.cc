#include "tables/schema.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

TEST(Schema, NeedsAllCoordinatesButFetchAndAzimuth) {
  for (AxisId axis : kAxes)
    EXPECT_EQ(MayBeAbsent(axis), axis == AxisId::kFetch || axis == AxisId::kAzimuth) << Describe(axis).name;
}

TEST(Schema, OfOneSeaHasTheNamesUnitsAndQuantitiesOfTheSeaSurface) {
  ASSERT_EQ(kOneSea.axes.size(), kAxisCount);
  for (AxisId axis : kAxes) {
    const AxisSchema& schema = kOneSea.axes[Index(axis)];
    EXPECT_EQ(schema.name, Describe(axis).name);
    EXPECT_EQ(schema.units, Describe(axis).units);
    EXPECT_EQ(schema.scale, Describe(axis).scale);
    EXPECT_EQ(schema.if_absent == IfAbsent::kRefuse,
              axis == AxisId::kIncidence || axis == AxisId::kFootprint || axis == AxisId::kDepth);
  }
  EXPECT_EQ(kOneSea.quantities.data(), kSeaSurface.quantities.data());
  EXPECT_EQ(kOneSea.axes[Index(AxisId::kAzimuth)].fold, Fold::kHalfTurn);
  EXPECT_EQ(kSeaSurface.axes[Index(AxisId::kAzimuth)].fold, Fold::kQuadrant);
}

TEST(Schema, FindsEveryName) {
  for (AxisId axis : kAxes) EXPECT_EQ(FindAxis(Describe(axis).name), axis);
  for (Quantity quantity : kQuantities) EXPECT_EQ(FindQuantity(Describe(quantity).name), quantity);
}

TEST(Schema, FindsNothingForOtherNames) {
  EXPECT_EQ(FindAxis("thu"), std::nullopt);
  EXPECT_EQ(FindAxis(""), std::nullopt);
  EXPECT_EQ(FindQuantity("depth"), std::nullopt);
  EXPECT_EQ(FindQuantity("THU"), std::nullopt);
}

}  // namespace
}  // namespace albtpu
