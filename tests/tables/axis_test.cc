#include "tables/axis.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::MakeAxis;
using ::testing::HasSubstr;

constexpr double kInfiniteNode = std::numeric_limits<double>::infinity();
constexpr double kNoNode = std::numeric_limits<double>::quiet_NaN();

std::string Problem(AxisId id, std::vector<double> nodes) {
  const absl::StatusOr<Axis> axis = Axis::Create(id, std::move(nodes));
  EXPECT_EQ(axis.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(axis.status().message());
}

// The position of a coordinate as one number, lower + fraction; negative if it is outside.
double Place(const Axis& axis, double coordinate) {
  const std::optional<Bracket> bracket = axis.Locate(coordinate);
  return bracket.has_value() ? static_cast<double>(bracket->lower) + bracket->fraction : -1;
}

TEST(Axis, RefusesNodesThatItCannotHave) {
  constexpr float kLeastFloat = std::numeric_limits<float>::denorm_min(),
                  kMostFloat = std::numeric_limits<float>::max();
  struct Case {
    AxisId id;
    std::vector<double> nodes;
    const char* problem;
  };
  for (const Case& c :
       {Case{AxisId::kDepth, {0, 3, 2}, "axis 'depth' node 2 is 2 m, not above node 1 (3 m): nodes must increase"},
        {AxisId::kDepth, {0, 3, 3}, "nodes must increase"},
        {AxisId::kDepth, {0, kLeastFloat}, "1.40129846e-45 m, too close to node 0 (0 m): nodes must be 1e-06 apart"},
        {AxisId::kDepth, {0, kMostFloat}, "node 1 is 3.40282347e+38 m: nodes must not be above 1e+09"},
        {AxisId::kFetch, {}, "'fetch' has no nodes"},
        {AxisId::kFetch, {100, kInfiniteNode}, "'fetch' node 1 is inf m: nodes must be finite"},
        {AxisId::kWindSpeed, {kNoNode}, "'wind_speed' node 0 is nan m s-1"},
        {AxisId::kFootprint, {0.1}, "not representable in single precision"},
        {AxisId::kFetch, {1, 1e300}, "not representable"},
        {AxisId::kDepth, {-1, 0}, "'depth' node 0 is -1 m: nodes must not be negative"},
        {AxisId::kFootprint, {0, 1}, "nodes on a log scale must be positive, 1e-06 at least"},
        {AxisId::kFootprint, {kLeastFloat, 1}, "node 0 is 1.40129846e-45 m: nodes on a log scale must be positive"},
        {AxisId::kAzimuth, {0, 91}, "'azimuth' node 1 is 91 degree: nodes must not be above 90 degree"}})
    EXPECT_THAT(Problem(c.id, c.nodes), HasSubstr(c.problem));
  EXPECT_TRUE(Axis::Create(AxisId::kFootprint, {static_cast<double>(0.1f)}).ok());
  EXPECT_TRUE(Axis::Create(AxisId::kFootprint, {0, 1}, Scale::kLinear).ok());
}

TEST(Axis, LocatesItsNodesExactly) {
  const UncertaintyTable table = testing::SyntheticTable();
  for (const Axis& axis : table.axes())
    for (std::size_t i = 0; i < axis.size(); ++i)
      EXPECT_EQ(Place(axis, axis.nodes()[i]), static_cast<double>(i)) << Describe(axis.id()).name;
}

TEST(Axis, LocatesLinearlyBetweenNodes) {
  const Axis depth = MakeAxis(AxisId::kDepth, {0, 1, 5});
  EXPECT_DOUBLE_EQ(Place(depth, 0.25), 0.25);
  EXPECT_DOUBLE_EQ(Place(depth, 4), 1.75);
}

TEST(Axis, LocatesInTheLogarithmOnALogScale) {
  const Axis footprint = MakeAxis(AxisId::kFootprint, {0.25, 1, 16});
  EXPECT_DOUBLE_EQ(Place(footprint, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(Place(footprint, 2), 1.25);
}

TEST(Axis, UsesTheGivenScale) {
  EXPECT_EQ(MakeAxis(AxisId::kFetch, {1, 2}).scale(), Scale::kLog);
  EXPECT_DOUBLE_EQ(Place(*Axis::Create(AxisId::kFetch, {1, 3}, Scale::kLinear), 2), 0.5);
}

TEST(Axis, LocatesNothingOutsideItsNodes) {
  const Axis depth = MakeAxis(AxisId::kDepth, {1, 2});
  for (double outside :
       {std::nextafter(1.0, 0.0), std::nextafter(2.0, 3.0), -1.0, kInfiniteNode, -kInfiniteNode, kNoNode})
    EXPECT_EQ(depth.Locate(outside), std::nullopt) << outside;
}

TEST(Axis, HoldsFetchAboveItsLastNode) {
  const Axis fetch = MakeAxis(AxisId::kFetch, {100, 1000});
  EXPECT_EQ(Place(fetch, 1001), 1);
  EXPECT_EQ(Place(fetch, kInfiniteNode), 1);
  EXPECT_EQ(fetch.Locate(99), std::nullopt);
  EXPECT_EQ(fetch.Locate(kNoNode), std::nullopt);
  EXPECT_EQ(fetch.Locate(-kInfiniteNode), std::nullopt);
}

TEST(Axis, WithOneFetchAnswersAtAnyFetchAboveZero) {
  const Axis fetch = MakeAxis(AxisId::kFetch, {1000});
  for (double inside : {1e-3, 1000.0, 1e9, kInfiniteNode}) EXPECT_EQ(Place(fetch, inside), 0) << inside;
  for (double outside : {0.0, -1.0, kNoNode}) EXPECT_EQ(fetch.Locate(outside), std::nullopt) << outside;
}

TEST(Axis, WithOneNodeAnswersOnlyThere) {
  const Axis depth = MakeAxis(AxisId::kDepth, {2});
  EXPECT_EQ(Place(depth, 2), 0);
  EXPECT_EQ(depth.Locate(2.1), std::nullopt);
}

TEST(Axis, FoldsAzimuth) {
  const Axis azimuth = MakeAxis(AxisId::kAzimuth, {0, 90});
  for (double same : {30.0, -30.0, 150.0, 210.0, 330.0, 390.0, -3570.0}) {
    EXPECT_DOUBLE_EQ(FoldAzimuth(same), 30) << same;
    EXPECT_NEAR(Place(azimuth, same), 1.0 / 3, 1e-15) << same;
  }
  EXPECT_EQ(azimuth.Locate(kInfiniteNode), std::nullopt);
}

TEST(Axis, KeepsFoldedAzimuthsWithinAQuarterTurn) {
  for (double azimuth : {90.0, -90.0, 270.0, std::nextafter(90.0, 91.0), 180.0, 1e300, -1e-300}) {
    EXPECT_GE(FoldAzimuth(azimuth), 0);
    EXPECT_LE(FoldAzimuth(azimuth), 90);
  }
}

TEST(Axis, FoldsAzimuthIntoHalfATurn) {
  const AxisSchema& schema = kOneSea.axes[Index(AxisId::kAzimuth)];
  const Axis azimuth = *Axis::Create(schema, {0, 90, 180});
  for (double same : {30.0, 210.0, -150.0, 390.0, -330.0, 3630.0}) {
    EXPECT_DOUBLE_EQ(FoldAzimuth(same, Fold::kHalfTurn), 30) << same;
    EXPECT_NEAR(Place(azimuth, same), 1.0 / 3, 1e-15) << same;
  }
  for (double mirrored : {-30.0, 150.0}) EXPECT_EQ(FoldAzimuth(mirrored, Fold::kHalfTurn), 150) << mirrored;
  for (double whole : {0.0, -0.0, 180.0, -180.0, 720.0}) EXPECT_EQ(FoldAzimuth(whole, Fold::kHalfTurn), 0) << whole;
  EXPECT_EQ(FoldAzimuth(-1e-9, Fold::kHalfTurn), 180);
  for (double any : {1e300, -1e300, 179.99999999, -179.99999999}) {
    EXPECT_GE(FoldAzimuth(any, Fold::kHalfTurn), 0);
    EXPECT_LE(FoldAzimuth(any, Fold::kHalfTurn), 180);
  }
  EXPECT_EQ(azimuth.Locate(kInfiniteNode), std::nullopt);
  EXPECT_THAT(Axis::Create(schema, {0, 181}).status().message(), HasSubstr("above 180 degree"));
}

TEST(Axis, WithOneNodeOnAnEndlessLinearScaleAnswersFromZero) {
  const Axis wind_speed = *Axis::Create(kOneSea.axes[Index(AxisId::kWindSpeed)], {6.5});
  for (double inside : {0.0, 1.0, 6.5, 100.0, kInfiniteNode}) EXPECT_EQ(Place(wind_speed, inside), 0) << inside;
  for (double outside : {-1.0, -kInfiniteNode, kNoNode}) EXPECT_EQ(wind_speed.Locate(outside), std::nullopt) << outside;
}

}  // namespace
}  // namespace albtpu
