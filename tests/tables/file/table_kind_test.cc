// Files of other kinds of tables than the sea surface.
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <vector>

#include "tables/file/table_io.h"
#include "tests/tables/file/forged_table.h"
#include "tests/tables/query/table_kinds.h"

namespace albtpu {
namespace {

using ::albtpu::testing::Forge;
using ::albtpu::testing::kLargestKind;
using ::albtpu::testing::kOneAxis;
using ::albtpu::testing::kThreeAxes;
using ::albtpu::testing::kThreeAxesRenamed;
using ::albtpu::testing::Problem;
using ::albtpu::testing::RandomTable;
using ::albtpu::testing::TemporaryFolder;
using ::albtpu::testing::TinyTable;
using ::testing::HasSubstr;

TEST(TableKind, ComesBackFromItsFileUnchanged) {
  const TemporaryFolder folder;
  for (const Table& table : {RandomTable(kThreeAxes, {4, 3, 5}, 1), RandomTable(kOneAxis, {7}, 2),
                             RandomTable(kLargestKind, {3, 2, 4, 2, 3, 3}, 3, Scale::kLog, false)}) {
    ASSERT_TRUE(WriteTable(table, folder / "t.h5", Existing::kReplace).ok());
    const absl::StatusOr<Table> read = ReadTable(folder / "t.h5", table.schema());
    EXPECT_EQ(&read->schema(), &table.schema());
    EXPECT_EQ(read->digest(), table.digest());
    EXPECT_TRUE(read->provenance().attributes.empty());
    for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
      EXPECT_EQ(read->axes()[axis].nodes(), table.axes()[axis].nodes());
      EXPECT_EQ(read->axes()[axis].scale(), table.axes()[axis].scale());
    }
    for (std::size_t q = 0; q < table.schema().quantities.size(); ++q) {
      EXPECT_EQ(read->variable(q)->values, table.variable(q)->values);
      EXPECT_EQ(read->variable(q)->standard_errors, table.variable(q)->standard_errors);
      EXPECT_EQ(read->variable(q)->scale, table.variable(q)->scale);
    }
  }
}

TEST(TableKind, IsRefusedWhereAnotherIsExpected) {
  const TemporaryFolder folder;
  const auto path = folder / "t.h5";
  ASSERT_TRUE(WriteTable(RandomTable(kThreeAxes, {2, 2, 2}, 1), path, Existing::kKeep).ok());
  const absl::Status as_sea = ReadTable(path).status();
  EXPECT_EQ(as_sea.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(as_sea.message(),
            path.string() + ": is a table of kind 'three_axes': expected kind 'sea_surface' or 'one_sea'");
  EXPECT_THAT(std::string(ReadTable(path, kThreeAxesRenamed).status().message()),
              HasSubstr("is a table of kind 'three_axes': expected kind 'three_axes_renamed'"));

  ASSERT_TRUE(WriteTable(TinyTable(), path, Existing::kReplace).ok());
  EXPECT_THAT(std::string(ReadTable(path, kThreeAxes).status().message()),
              HasSubstr("is a table of kind 'sea_surface': expected kind 'three_axes'"));
}

// So that a table has one written form.
TEST(TableKind, IsNotNamedInFilesOfTheSeaSurface) {
  EXPECT_EQ(Problem(Forge(
                [](hid_t file) { EXPECT_TRUE(hdf5::WriteAttribute(file, "table_kind", std::string("sea_surface"))); })),
            "attribute 'table_kind' is 'sea_surface': files of that kind do not have it");
  EXPECT_THAT(
      Problem(Forge([](hid_t file) { EXPECT_TRUE(hdf5::WriteAttribute(file, "table_kind", std::int64_t{1})); })),
      HasSubstr("attribute 'table_kind' is a number"));
}

TEST(TableKind, CountsInTheDigest) {
  EXPECT_NE(RandomTable(kThreeAxes, {2, 2, 2}, 1).digest(), RandomTable(kThreeAxesRenamed, {2, 2, 2}, 1).digest());
}

TEST(TableKind, RefusesAxesOfAnother) {
  const Table table = RandomTable(kThreeAxes, {2, 2, 2}, 1);
  const auto problem = [&](Table::Axes axes) {
    return std::string(
        Table::Create(kThreeAxes, std::move(axes), Table::Variables(2), table.provenance()).status().message());
  };
  EXPECT_EQ(problem({table.axes()[0]}), "there are 1 axes: expected the 3 of kind 'three_axes'");
  AxisSchema other = kThreeAxes.axes[2];
  other.units = "km";
  EXPECT_EQ(problem({table.axes()[0], table.axes()[1], Axis::Create(other, {1, 2}).value()}),
            "axis 'range' has other rules than that of kind 'three_axes'");
  EXPECT_EQ(problem(table.axes()), "variable 'spread' is missing: only biases may be absent");
}

TEST(TableKind, RefusesAnotherNumberOfVariables) {
  const Table table = RandomTable(kThreeAxes, {2, 2, 2}, 1);
  for (const std::size_t count : {0u, 1u, 3u}) {
    const absl::Status status =
        Table::Create(kThreeAxes, table.axes(), Table::Variables(count), table.provenance()).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_EQ(status.message(),
              "there are " + std::to_string(count) + " variables: expected the 2 of kind 'three_axes'");
  }
}

TEST(TableSchema, IsWellFormedOnlyWithinItsRules) {
  EXPECT_TRUE(IsWellFormed(kSeaSurface));
  TableSchema schema = kThreeAxes;
  schema.blend_order = schema.blend_order.first(2);
  EXPECT_FALSE(IsWellFormed(schema));
  schema = kThreeAxes;
  schema.axes = schema.axes.first(2);  // The two-ended axis would be the last.
  const std::size_t order[] = {0, 1};
  schema.blend_order = order;
  EXPECT_FALSE(IsWellFormed(schema));
  schema = kThreeAxes;
  schema.name = "";
  EXPECT_FALSE(IsWellFormed(schema));
}

// They are all datasets of one group.
TEST(TableSchema, NamesAxesQuantitiesAndStandardErrorsDifferently) {
  const auto is_well_formed = [](std::string_view axis, std::string_view first, std::string_view second) {
    std::vector<AxisSchema> axes(kThreeAxes.axes.begin(), kThreeAxes.axes.end());
    std::vector<QuantitySchema> quantities(kThreeAxes.quantities.begin(), kThreeAxes.quantities.end());
    axes.front().name = axis;
    quantities.front().name = first;
    quantities.back().name = second;
    TableSchema schema = kThreeAxes;
    schema.axes = axes;
    schema.quantities = quantities;
    return IsWellFormed(schema);
  };
  EXPECT_TRUE(is_well_formed("attenuation", "spread", "shift"));
  EXPECT_TRUE(is_well_formed("attenuation", "spread", "shift_standard_error"));
  EXPECT_FALSE(is_well_formed("heading", "spread", "shift"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "spread"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "range"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "spread_standard_error"));
  EXPECT_FALSE(is_well_formed("attenuation", "shift_standard_error", "shift"));
  EXPECT_FALSE(is_well_formed("spread_standard_error", "spread", "shift"));
  EXPECT_FALSE(is_well_formed("", "spread", "shift"));
}

}  // namespace
}  // namespace albtpu
