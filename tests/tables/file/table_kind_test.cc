// Files of other kinds of tables than the sea surface.
#include <gmock/gmock.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tables/file/table_io.h"
#include "tables/water/water_schema.h"
#include "tests/tables/file/forged_table.h"

namespace albtpu {
namespace {

using ::albtpu::testing::Forge;
using ::albtpu::testing::Problem;
using ::albtpu::testing::TemporaryFolder;
using ::albtpu::testing::TinyTable;
using ::testing::HasSubstr;

// The water column under another name.
const TableSchema kRenamed = [] {
  TableSchema schema = kWaterColumn;
  schema.name = "water_column_renamed";
  return schema;
}();

// A table of the water column of random values on two nodes an axis.
Table WaterTable(const TableSchema& schema = kWaterColumn, Scale scale = Scale::kLinear) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(0.1f, 1.0f);
  Table::Axes axes;
  for (const AxisSchema& axis : schema.axes) axes.push_back(Axis::Create(axis, {1, 2}).value());
  Table::Variables variables;
  for (const QuantitySchema& quantity : schema.quantities) {
    Variable& variable = variables.emplace_back().emplace();
    variable.scale = quantity.is_bias ? Scale::kLinear : scale;
    for (std::size_t i = 0; i < ValueCount(axes, quantity); ++i) variable.values.push_back(number(random));
    if (scale == Scale::kLog) variable.standard_errors = variable.values;
  }
  return Table::Create(schema, axes, variables,
                       {.id = "random", .version = "1", .title = "Random numbers", .campaign = {}, .attributes = {}})
      .value();
}

TEST(TableKind, ComesBackFromItsFileUnchanged) {
  const TemporaryFolder folder;
  for (const Table& table : {WaterTable(), WaterTable(kWaterColumn, Scale::kLog)}) {
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
  ASSERT_TRUE(WriteTable(WaterTable(), path, Existing::kKeep).ok());
  const absl::Status as_sea = ReadTable(path).status();
  EXPECT_EQ(as_sea.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(as_sea.message(),
            path.string() + ": is a table of kind 'water_column': expected kind 'sea_surface' or 'one_sea'");
  EXPECT_THAT(std::string(ReadTable(path, kRenamed).status().message()),
              HasSubstr("is a table of kind 'water_column': expected kind 'water_column_renamed'"));

  ASSERT_TRUE(WriteTable(TinyTable(), path, Existing::kReplace).ok());
  EXPECT_THAT(std::string(ReadTable(path, kWaterColumn).status().message()),
              HasSubstr("is a table of kind 'sea_surface': expected kind 'water_column'"));
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

TEST(TableKind, CountsInTheDigest) { EXPECT_NE(WaterTable().digest(), WaterTable(kRenamed).digest()); }

TEST(TableKind, RefusesAxesAndVariablesOfAnother) {
  const Table table = WaterTable();
  const auto problem = [&](Table::Axes axes, std::size_t variables) {
    const absl::Status status =
        Table::Create(kWaterColumn, std::move(axes), Table::Variables(variables), table.provenance()).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
    return std::string(status.message());
  };
  EXPECT_EQ(problem({table.axes()[0]}, 9), "there are 1 axes: expected the 6 of kind 'water_column'");
  AxisSchema other = kWaterColumn.axes[5];
  other.units = "km";
  Table::Axes axes = table.axes();
  axes[5] = Axis::Create(other, {1, 2}).value();
  EXPECT_EQ(problem(axes, 9), "axis 'pulse_length' has other rules than that of kind 'water_column'");
  EXPECT_EQ(problem(table.axes(), 9), "variable 'stretch' is missing: only biases may be absent");
  for (const std::size_t count : {0u, 1u, 10u})
    EXPECT_EQ(problem(table.axes(), count),
              "there are " + std::to_string(count) + " variables: expected the 9 of kind 'water_column'");
}

TEST(TableSchema, IsWellFormedOnlyWithinItsRules) {
  EXPECT_TRUE(IsWellFormed(kSeaSurface));
  TableSchema schema = kSeaSurface;
  schema.blend_order = schema.blend_order.first(5);
  EXPECT_FALSE(IsWellFormed(schema));
  schema = kSeaSurface;
  schema.axes = schema.axes.first(4);  // The azimuth, which takes the larger of two ends, would be the last.
  const std::size_t order[] = {0, 1, 2, 3};
  schema.blend_order = order;
  EXPECT_FALSE(IsWellFormed(schema));
  schema = kSeaSurface;
  schema.name = "";
  EXPECT_FALSE(IsWellFormed(schema));
}

// They are all datasets of one group.
TEST(TableSchema, NamesAxesQuantitiesAndStandardErrorsDifferently) {
  const auto is_well_formed = [](std::string_view axis, std::string_view first, std::string_view second) {
    std::vector<AxisSchema> axes(kSeaSurface.axes.begin(), kSeaSurface.axes.end());
    std::vector<QuantitySchema> quantities(kSeaSurface.quantities.begin(), kSeaSurface.quantities.end());
    axes.front().name = axis;
    quantities.front().name = first;
    quantities.back().name = second;
    TableSchema schema = kSeaSurface;
    schema.axes = axes;
    schema.quantities = quantities;
    return IsWellFormed(schema);
  };
  EXPECT_TRUE(is_well_formed("attenuation", "spread", "shift"));
  EXPECT_TRUE(is_well_formed("attenuation", "spread", "shift_standard_error"));
  EXPECT_FALSE(is_well_formed("azimuth", "spread", "shift"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "spread"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "depth"));
  EXPECT_FALSE(is_well_formed("attenuation", "spread", "spread_standard_error"));
  EXPECT_FALSE(is_well_formed("attenuation", "shift_standard_error", "shift"));
  EXPECT_FALSE(is_well_formed("spread_standard_error", "spread", "shift"));
  EXPECT_FALSE(is_well_formed("", "spread", "shift"));
}

}  // namespace
}  // namespace albtpu
