#include "tables/uncertainty_table.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "tests/tables/query/asked_columns.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::kInfinity;
using ::albtpu::testing::kNaN;

using ::albtpu::testing::MakeAxis;
using ::albtpu::testing::PartsOf;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TableParts;
using ::albtpu::testing::TinyTable;
using ::testing::HasSubstr;

std::string Problem(const TableParts& parts) {
  const absl::StatusOr<UncertaintyTable> table = parts.Create();
  EXPECT_EQ(table.status().code(), absl::StatusCode::kInvalidArgument);
  return std::string(table.status().message());
}

TEST(UncertaintyTable, CountsValuesOverTheAxesOfAQuantity) {
  const UncertaintyTable table = SyntheticTable();
  EXPECT_EQ(ValueCount(table.axes(), Quantity::kRefractionAlongWind), 5u * 4 * 6 * 4 * 4);
  EXPECT_EQ(ValueCount(table.axes(), Quantity::kThu), 5u * 4 * 6 * 4 * 4 * 7);
}

TEST(UncertaintyTable, MayLackBiasesAndStandardErrors) {
  const UncertaintyTable table = SyntheticTable({.published = true});
  EXPECT_EQ(table.variable(Quantity::kBiasAlongBeam), nullptr);
  ASSERT_NE(table.variable(Quantity::kThu), nullptr);
  EXPECT_TRUE(table.variable(Quantity::kThu)->standard_errors.empty());
}

TEST(UncertaintyTable, RefusesWhatIsNoTable) {
  struct Case {
    std::function<void(TableParts&)> change;
    ::testing::Matcher<std::string> problem;
  };
  const Case cases[] = {
      {[](TableParts& parts) { std::swap(parts.axes[0], parts.axes[1]); }, "axis 0 is 'fetch': expected 'wind_speed'"},
      {[](TableParts& parts) { parts[Quantity::kThu].values.pop_back(); },
       "variable 'thu' has 15 values: its axes have 16 nodes"},
      {[](TableParts& parts) { parts[Quantity::kRefractionCrossWind].standard_errors.push_back(0); },
       "variable 'refraction_cross_wind_standard_error' has 9 values: its axes have 8 nodes"},
      {[](TableParts& parts) { parts[Quantity::kTvu].values[13] = kNaN; },  // 13 = 0b1101
       "variable 'tvu' is nan at [wind_speed 1, fetch 0, incidence 1, azimuth 0, footprint 0, depth 1]: values must be "
       "finite"},
      {[](TableParts& parts) { parts[Quantity::kBiasVertical].values[0] = -kInfinity; },
       HasSubstr("variable 'bias_vertical' is -inf")},
      {[](TableParts& parts) { parts.provenance.id = "No Name"; }, HasSubstr("attribute 'id'")}};
  for (const auto& [change, problem] : cases) {
    TableParts parts = PartsOf(TinyTable());
    change(parts);
    EXPECT_THAT(Problem(parts), problem);
  }
}

TEST(UncertaintyTable, MayLackBiasesAndHaveNegativeOnesAndNothingElse) {
  for (Quantity quantity : kQuantities) {
    TableParts without = PartsOf(TinyTable()), negative = without, negative_error = without;
    without.variables[Index(quantity)].reset();
    negative[quantity].values[0] = -1;
    negative_error[quantity].standard_errors[0] = -1;
    EXPECT_THAT(Problem(negative_error), HasSubstr("_standard_error' is -1 at "));
    if (Describe(quantity).is_bias) {
      EXPECT_TRUE(without.Create().ok() && negative.Create().ok());
      continue;
    }
    EXPECT_THAT(Problem(without), HasSubstr("' is missing"));
    EXPECT_THAT(Problem(negative), HasSubstr("it must not be negative"));
  }
}

TEST(UncertaintyTable, RefusesZeroOnALogScale) {
  TableParts parts = PartsOf(TinyTable(Scale::kLog));
  parts[Quantity::kThu].values[0] = 0;
  EXPECT_THAT(Problem(parts), HasSubstr("variable 'thu' is 0 at"));
  parts[Quantity::kThu].values[0] = 1;
  parts[Quantity::kThu].standard_errors[0] = 0;
  EXPECT_TRUE(parts.Create().ok());
}

TEST(UncertaintyTable, RefusesMoreNodesThanItsFormatAllows) {
  std::vector<double> nodes(70'000);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<double>(i);
  TableParts parts = PartsOf(TinyTable());
  parts.axes[Index(AxisId::kDepth)] = MakeAxis(AxisId::kDepth, nodes);
  EXPECT_EQ(Problem(parts), "axis 'depth' has 70000 nodes: it may have 65536 at most");

  nodes.resize(65'000);
  parts.axes[Index(AxisId::kDepth)] = MakeAxis(AxisId::kDepth, nodes);
  parts.axes[Index(AxisId::kWindSpeed)] = MakeAxis(AxisId::kWindSpeed, nodes);
  EXPECT_THAT(Problem(parts), HasSubstr("the axes up to 'depth' span more than 268435456 nodes"));
}

TEST(ContentDigest, CoversEverythingThatAnswersDependOn) {
  const std::string digest = TinyTable().digest();
  EXPECT_EQ(digest.size(), 64u);
  EXPECT_EQ(PartsOf(TinyTable()).Create()->digest(), digest);
  std::vector<std::function<void(TableParts&)>> changes = {
      [](TableParts& parts) { parts.provenance.id = "other"; },
      [](TableParts& parts) { parts.provenance.campaign += "\n"; },
      [](TableParts& parts) {
        parts.axes[0] = MakeAxis(AxisId::kWindSpeed, {2, 5});
      },
      [](TableParts& parts) { parts.axes[1] = *Axis::Create(AxisId::kFetch, {1000}, Scale::kLinear); },
      [](TableParts& parts) { parts.variables[Index(Quantity::kBiasVertical)].reset(); }};
  for (const Quantity quantity : kQuantities) {
    changes.push_back([=](TableParts& parts) { parts[quantity].values.back() *= 1.0000002f; });
    changes.push_back([=](TableParts& parts) { parts[quantity].standard_errors.back() *= 1.0000002f; });
    changes.push_back([=](TableParts& parts) { parts[quantity].standard_errors.clear(); });
    changes.push_back([=](TableParts& parts) { parts[quantity].scale = Scale::kLog; });
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    TableParts parts = PartsOf(TinyTable());
    changes[i](parts);
    EXPECT_NE(parts.Create()->digest(), digest) << i;
  }
}

TEST(ContentDigest, DoesNotCoverVersionTitleOrOtherAttributes) {
  TableParts parts = PartsOf(TinyTable());
  parts.provenance.version = "another";
  parts.provenance.title = "another";
  parts.provenance.attributes["date"] = std::string("2026-01-01");
  EXPECT_EQ(parts.Create()->digest(), TinyTable().digest());
}

}  // namespace
}  // namespace albtpu
