#include "tables/schema.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

TEST(Schema, DescribesAxesInTheOrderOfTheFormat) {
  EXPECT_EQ(Describe(AxisId::kWindSpeed).name, "wind_speed");
  EXPECT_EQ(Describe(AxisId::kFetch).name, "fetch");
  EXPECT_EQ(Describe(AxisId::kIncidence).name, "incidence");
  EXPECT_EQ(Describe(AxisId::kAzimuth).name, "azimuth");
  EXPECT_EQ(Describe(AxisId::kFootprint).name, "footprint");
  EXPECT_EQ(Describe(AxisId::kDepth).name, "depth");
}

TEST(Schema, HasLogarithmicFetchAndFootprint) {
  for (AxisId axis : kAxes) {
    const bool is_log = axis == AxisId::kFetch || axis == AxisId::kFootprint;
    EXPECT_EQ(Describe(axis).scale, is_log ? Scale::kLog : Scale::kLinear) << Describe(axis).name;
  }
}

TEST(Schema, HasDepthForAllQuantitiesButRefraction) {
  for (Quantity quantity : kQuantities) {
    const bool is_angle = Describe(quantity).units == "degree";
    EXPECT_EQ(Describe(quantity).over_last_axis, !is_angle) << Describe(quantity).name;
  }
}

TEST(Schema, NeedsAllCoordinatesButFetchAndAzimuth) {
  for (AxisId axis : kAxes) {
    EXPECT_EQ(MayBeAbsent(axis), axis == AxisId::kFetch || axis == AxisId::kAzimuth) << Describe(axis).name;
  }
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
