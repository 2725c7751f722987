#include "tables/query/axis_lookup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/instruction_sets.h"
#include "tests/tables/query/asked_columns.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::MakeAxis;

using ::albtpu::testing::kInfinity;

class AxisLookupTest : public testing::OnInstructionSet {};
ALBTPU_ON_EACH_INSTRUCTION_SET(AxisLookupTest);

std::vector<std::int32_t> LowerNodes(const Axis& axis, const std::vector<float>& coordinates) {
  std::vector<std::int32_t> rows(coordinates.size(), 100);
  AxisLookup(axis, Index(axis.id())).AddLowerNodes(coordinates.data(), coordinates.size(), 3, rows.data());
  for (std::int32_t& row : rows) row = (row - 100) / 3;
  return rows;
}

// Expects the same positions from both, with a step of two rows from node to node.
void ExpectEqual(const Axis& axis, std::vector<float> coordinates) {
  coordinates.resize((coordinates.size() + AxisLookup::kPadding - 1) / AxisLookup::kPadding * AxisLookup::kPadding);
  std::vector<std::int32_t> rows(coordinates.size(), 7), codes(coordinates.size(), outcome_code::kInside);
  std::vector<float> fractions(coordinates.size(), -1);
  AxisLookup(axis, Index(axis.id()))
      .Locate(coordinates.data(), coordinates.size(), 2, rows.data(), fractions.data(), codes.data());
  const std::vector<std::int32_t> lower_nodes = LowerNodes(axis, coordinates);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    SCOPED_TRACE(coordinates[i]);
    const std::optional<Bracket> bracket = axis.Locate(coordinates[i]);
    ASSERT_EQ(codes[i] == outcome_code::kInside, bracket.has_value());
    ASSERT_EQ(rows[i], 7 + 2 * static_cast<std::int32_t>(bracket.value_or(Bracket{}).lower));
    ASSERT_TRUE(!bracket.has_value() || 7 + 2 * lower_nodes[i] == rows[i]);
    const double fraction = bracket.value_or(Bracket{}).fraction;
    ASSERT_NEAR(fractions[i], fraction, 1e-6);
    const bool too_small = fraction > 0 && fraction < std::numeric_limits<float>::min();
    ASSERT_TRUE(too_small || (fractions[i] == 0) == (fraction == 0));
    ASSERT_TRUE(fraction < 1 || fractions[i] == 1);
    ASSERT_LE(fractions[i], 1);
  }
}

// Nodes, their neighbours in single precision, and coordinates between and beyond them.
std::vector<float> CoordinatesOf(const Axis& axis, std::mt19937& random) {
  std::vector<float> coordinates = {-1, -0.0f, 0, 1e6f, -1e6f};
  for (double node : axis.nodes()) {
    const auto at = static_cast<float>(node);
    for (const float x : {at, std::nextafter(at, 0.0f), std::nextafter(at, kInfinity)}) coordinates.push_back(x);
  }
  std::uniform_real_distribution<float> inside(static_cast<float>(axis.nodes().front()),
                                               static_cast<float>(axis.nodes().back()));
  for (int i = 0; i < 1000; ++i) coordinates.push_back(inside(random));
  return coordinates;
}

TEST_P(AxisLookupTest, AgreesWithTheAxisAtAndBetweenNodes) {
  std::mt19937 random(1);
  const auto agrees = [&](const Axis& axis) { ExpectEqual(axis, CoordinatesOf(axis, random)); };
  agrees(MakeAxis(AxisId::kWindSpeed, {3, 4, 5, 7, 10}));
  agrees(MakeAxis(AxisId::kWindSpeed, {5}));
  agrees(MakeAxis(AxisId::kFetch, {1e3, 1e4, 3e4, 1e6}));
  agrees(MakeAxis(AxisId::kFetch, {1e3}));
  agrees(MakeAxis(AxisId::kIncidence, {0, 25}));
  agrees(MakeAxis(AxisId::kAzimuth, {0, 15, 30, 90}));
  agrees(MakeAxis(AxisId::kAzimuth, {45}));
  agrees(MakeAxis(AxisId::kFootprint, {0.1, 0.11, 0.5, 0.7, 3}));
}

TEST_P(AxisLookupTest, SearchesLongAxes) {
  std::mt19937 random(2);
  for (const int count : {47, 48, 49, 50, 64, 65, 66, 1000}) {
    std::vector<double> depths, footprints;
    for (int i = 0; i < count; ++i) {
      depths.push_back(0.1 * i);
      footprints.push_back(0.1 * std::pow(1.01, i));
    }
    const Axis depth = MakeAxis(AxisId::kDepth, depths), footprint = MakeAxis(AxisId::kFootprint, footprints);
    ExpectEqual(depth, CoordinatesOf(depth, random));
    ExpectEqual(footprint, CoordinatesOf(footprint, random));
  }
}

TEST_P(AxisLookupTest, FoldsAzimuthsExactly) {
  std::mt19937 random(3);
  std::vector<float> azimuths;
  for (const float most : {200.0f, 1e4f, AxisLookup::kFarthestAzimuth}) {
    std::uniform_real_distribution<float> azimuth(-most, most);
    for (int i = 0; i < 1000; ++i) azimuths.push_back(azimuth(random));
  }
  for (int turn = -2000; turn <= 2000; ++turn) {
    const auto at = static_cast<float>(90 * turn);
    for (const float x : {at, std::nextafter(at, -kInfinity), std::nextafter(at, kInfinity)}) azimuths.push_back(x);
  }
  ExpectEqual(MakeAxis(AxisId::kAzimuth, {0, 30, 60, 90}), azimuths);
  ExpectEqual(MakeAxis(AxisId::kAzimuth, {10, 80}), azimuths);
}

TEST_P(AxisLookupTest, FindsANodeBelowAnyCoordinate) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kMost = std::numeric_limits<float>::max();
  const std::vector<float> odd = {kNaN, -kNaN, kInfinity, -kInfinity, kMost, -kMost, 1e7f, -1e7f, 4e9f, -0.0f, 1e-40f};
  std::vector<double> many;
  for (int i = 0; i < 60; ++i) many.push_back(i);
  for (const Axis& axis : {MakeAxis(AxisId::kAzimuth, {0, 30, 60, 90}), MakeAxis(AxisId::kAzimuth, {45}),
                           MakeAxis(AxisId::kFetch, {1e3, 1e4, 1e5}), MakeAxis(AxisId::kDepth, many)}) {
    std::vector<float> coordinates(16, 5);
    std::copy(odd.begin(), odd.end(), coordinates.begin());
    const auto last = static_cast<std::int32_t>(axis.size()) - 2;
    for (const std::int32_t node : LowerNodes(axis, coordinates)) {
      EXPECT_GE(node, 0);
      EXPECT_LE(node, std::max(last, 0));
    }
  }
}

TEST_P(AxisLookupTest, KeepsTheLowestCode) {
  const Axis axis = MakeAxis(AxisId::kDepth, {0, 10});
  const auto depth = static_cast<std::int32_t>(Index(AxisId::kDepth));
  std::vector<float> coordinates(AxisLookup::kPadding, 5), fractions(AxisLookup::kPadding);
  coordinates[1] = coordinates[2] = 11;
  coordinates[3] = coordinates[4] = std::nanf("");
  std::vector<std::int32_t> rows(AxisLookup::kPadding),
      codes = {0, outcome_code::kInside, 3, outcome_code::kOutside, 3, outcome_code::kInside, 9, 4};
  AxisLookup(axis, Index(axis.id()))
      .Locate(coordinates.data(), coordinates.size(), 1, rows.data(), fractions.data(), codes.data());
  EXPECT_EQ(codes,
            (std::vector<std::int32_t>{0, outcome_code::kOutside + depth, 3, depth, 3, outcome_code::kInside, 9, 4}));
}

}  // namespace
}  // namespace albtpu
