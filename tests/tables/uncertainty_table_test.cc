#include "tables/uncertainty_table.h"

#include <gmock/gmock.h>

#include <limits>
#include <utility>

#include "tests/tables/synthetic_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::MakeAxis;
using ::albtpu::testing::SyntheticTable;
using ::albtpu::testing::TinyTable;
using ::testing::HasSubstr;

// The parts of a valid table, for tests that make one of them invalid.
struct Parts {
  UncertaintyTable::Axes axes;
  UncertaintyTable::Variables variables;
  Provenance provenance;

  Variable& operator[](Quantity quantity) { return *variables[Index(quantity)]; }
  absl::StatusOr<UncertaintyTable> Create() const { return UncertaintyTable::Create(axes, variables, provenance); }
  std::string Problem() const {
    const absl::StatusOr<UncertaintyTable> table = Create();
    EXPECT_EQ(table.status().code(), absl::StatusCode::kInvalidArgument);
    return std::string(table.status().message());
  }
  std::string Digest() const { return Create()->digest(); }
};

Parts PartsOf(const UncertaintyTable& table) {
  Parts parts{table.axes(), {}, table.provenance()};
  for (Quantity quantity : kQuantities)
    if (const Variable* variable = table.variable(quantity)) parts.variables[Index(quantity)] = *variable;
  return parts;
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

TEST(UncertaintyTable, RefusesMissingRequiredQuantities) {
  for (Quantity quantity : kQuantities) {
    Parts parts = PartsOf(TinyTable());
    parts.variables[Index(quantity)].reset();
    if (Describe(quantity).is_bias) {
      EXPECT_TRUE(parts.Create().ok());
    } else
      EXPECT_THAT(parts.Problem(), HasSubstr("' is missing"));
  }
}

TEST(UncertaintyTable, RefusesAxesInAnotherOrder) {
  Parts parts = PartsOf(TinyTable());
  std::swap(parts.axes[0], parts.axes[1]);
  EXPECT_EQ(parts.Problem(), "axis 0 is 'fetch': expected 'wind_speed'");
}

TEST(UncertaintyTable, RefusesAWrongNumberOfValues) {
  Parts parts = PartsOf(TinyTable());
  parts[Quantity::kThu].values.pop_back();
  EXPECT_EQ(parts.Problem(), "variable 'thu' has 15 values: its axes have 16 nodes");
}

TEST(UncertaintyTable, RefusesAWrongNumberOfStandardErrors) {
  Parts parts = PartsOf(TinyTable());
  parts[Quantity::kRefractionCrossWind].standard_errors.push_back(0);
  EXPECT_EQ(parts.Problem(), "variable 'refraction_cross_wind_standard_error' has 9 values: its axes have 8 nodes");
}

TEST(UncertaintyTable, NamesTheNodeOfAValueThatIsNotFinite) {
  Parts parts = PartsOf(TinyTable());
  parts[Quantity::kTvu].values[13] = std::numeric_limits<float>::quiet_NaN();  // 13 = 0b1101
  EXPECT_EQ(parts.Problem(),
            "variable 'tvu' is nan at [wind_speed 1, fetch 0, incidence 1, azimuth 0, footprint 0, depth 1]: "
            "values must be finite");
}

TEST(UncertaintyTable, RefusesInfinity) {
  Parts parts = PartsOf(TinyTable());
  parts[Quantity::kBiasVertical].values[0] = -std::numeric_limits<float>::infinity();
  EXPECT_THAT(parts.Problem(), HasSubstr("variable 'bias_vertical' is -inf"));
}

TEST(UncertaintyTable, AllowsNegativeBiasesOnly) {
  for (Quantity quantity : kQuantities) {
    Parts parts = PartsOf(TinyTable());
    parts[quantity].values[0] = -1;
    if (Describe(quantity).is_bias) {
      EXPECT_TRUE(parts.Create().ok());
    } else
      EXPECT_THAT(parts.Problem(), HasSubstr("it must not be negative"));
  }
}

TEST(UncertaintyTable, RefusesNegativeStandardErrors) {
  for (Quantity quantity : kQuantities) {
    Parts parts = PartsOf(TinyTable());
    parts[quantity].standard_errors[0] = -1;
    EXPECT_THAT(parts.Problem(), HasSubstr("_standard_error' is -1 at "));
  }
}

TEST(UncertaintyTable, RefusesZeroOnALogScale) {
  Parts parts = PartsOf(TinyTable(Scale::kLog));
  parts[Quantity::kThu].values[0] = 0;
  EXPECT_THAT(parts.Problem(), HasSubstr("variable 'thu' is 0 at"));
  parts[Quantity::kThu].values[0] = 1;
  parts[Quantity::kThu].standard_errors[0] = 0;
  EXPECT_TRUE(parts.Create().ok());
}

TEST(UncertaintyTable, RefusesMoreNodesThanItsFormatAllows) {
  std::vector<double> nodes(70'000);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<double>(i);
  Parts parts = PartsOf(TinyTable());
  parts.axes[Index(AxisId::kDepth)] = MakeAxis(AxisId::kDepth, nodes);
  EXPECT_EQ(parts.Problem(), "axis 'depth' has 70000 nodes: it may have 65536 at most");

  nodes.resize(65'000);
  parts.axes[Index(AxisId::kDepth)] = MakeAxis(AxisId::kDepth, nodes);
  parts.axes[Index(AxisId::kWindSpeed)] = MakeAxis(AxisId::kWindSpeed, nodes);
  EXPECT_THAT(parts.Problem(), HasSubstr("the axes up to 'depth' span more than 268435456 nodes"));
}

TEST(UncertaintyTable, RefusesABadProvenance) {
  Parts parts = PartsOf(TinyTable());
  parts.provenance.id = "No Name";
  EXPECT_THAT(parts.Problem(), HasSubstr("attribute 'id'"));
}

TEST(ContentDigest, CoversEverythingThatAnswersDependOn) {
  const Parts original = PartsOf(TinyTable());
  const std::string digest = original.Digest();
  EXPECT_EQ(digest.size(), 64u);
  EXPECT_EQ(PartsOf(TinyTable()).Digest(), digest);

  Parts parts = original;
  parts.provenance.id = "other";
  EXPECT_NE(parts.Digest(), digest);
  parts = original;
  parts.provenance.campaign += "\n";
  EXPECT_NE(parts.Digest(), digest);
  parts = original;
  parts.axes[0] = MakeAxis(AxisId::kWindSpeed, {2, 5});
  EXPECT_NE(parts.Digest(), digest);
  parts = original;
  parts.axes[1] = *Axis::Create(AxisId::kFetch, {1000}, Scale::kLinear);
  EXPECT_NE(parts.Digest(), digest);
  for (Quantity quantity : kQuantities) {
    parts = original;
    parts[quantity].values.back() *= 1.0000002f;
    EXPECT_NE(parts.Digest(), digest);
    parts = original;
    parts[quantity].standard_errors.back() *= 1.0000002f;
    EXPECT_NE(parts.Digest(), digest);
    parts = original;
    parts[quantity].standard_errors.clear();
    EXPECT_NE(parts.Digest(), digest);
    parts = original;
    parts[quantity].scale = Scale::kLog;
    EXPECT_NE(parts.Digest(), digest);
  }
  parts = original;
  parts.variables[Index(Quantity::kBiasVertical)].reset();
  EXPECT_NE(parts.Digest(), digest);
}

TEST(ContentDigest, DoesNotCoverVersionTitleOrOtherAttributes) {
  Parts parts = PartsOf(TinyTable());
  const std::string digest = parts.Digest();
  parts.provenance.version = "another";
  parts.provenance.title = "another";
  parts.provenance.attributes["date"] = std::string("2026-01-01");
  EXPECT_EQ(parts.Digest(), digest);
}

}  // namespace
}  // namespace albtpu
