// Queries with a water in words, through a running server. tests/service/client/water_source_test.cc compares the bits
// with those of columns that a client computes.
#include <gmock/gmock.h>

#include <cmath>

#include "service/client/wire.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/budget/water/known_waters.h"
#include "tests/service/server/served_tables.h"
#include "tests/tables/water/shipped_water.h"

namespace albtpu::server {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class WaterQueries : public ServedTables {
 protected:
  explicit WaterQueries(const std::filesystem::path& water = SHIPPED_WATER_TABLE) : ServedTables(water) {}

  // One number for all pulses, as a person types them.
  static v1::QueryBudgetRequest Request(const KnownWater& water, const std::vector<float>& depths = {8}) {
    v1::QueryBudgetRequest request;
    request.mutable_options()->set_table("survey");
    request.mutable_options()->set_located(v1::SURFACE_LOCATION_LOCAL);
    *request.mutable_pulses() = InColumns({WirePulse()});
    request.mutable_pulses()->set_depth(Column(depths));
    request.mutable_aircraft()->set_altitude(Column({400}));
    request.mutable_aircraft()->set_beam_azimuth(Column({90}));
    for (const v1::BudgetQuantity quantity :
         {v1::BUDGET_QUANTITY_TOTAL_TVU, v1::BUDGET_QUANTITY_TVU_WATER, v1::BUDGET_QUANTITY_BIAS_VERTICAL})
      request.add_quantities(quantity);
    *request.mutable_water() = client::ToWire(water);
    return request;
  }
};

struct WaterFile {
  WaterFile() { EXPECT_TRUE(testing::WriteWaterTable("2", water_path_).ok()); }

  const testing::TemporaryFolder water_folder_;
  const std::filesystem::path water_path_ = water_folder_ / "water.h5";
};

class WaterQueriesFromAFile : protected WaterFile, public WaterQueries {
 protected:
  WaterQueriesFromAFile() : WaterQueries(water_path_) {}
};

TEST_F(WaterQueriesFromAFile, NameTheVersionThatWasReloaded) {
  const v1::QueryBudgetRequest request = Request(testing::CoastalWater());
  const v1::TableReference before = Ask(request).water().table();
  EXPECT_EQ(before.version(), "2");
  ASSERT_TRUE(testing::WriteWaterTable("3", water_path_).ok());
  Reload();
  const v1::TableReference after = Ask(request).water().table();
  EXPECT_EQ(after.version(), "3");
  EXPECT_EQ(after.digest(), before.digest());
}

TEST_F(WaterQueries, HaveTheShareOfTheWater) {
  v1::QueryBudgetRequest request = Request(testing::CoastalWater());
  const v1::QueryBudgetResponse in_water = Ask(request);
  request.clear_water();
  const v1::QueryBudgetResponse without = Ask(request);
  const float share = Floats(in_water.budget().tvu_water())[0];
  EXPECT_GT(share, 0.005);
  EXPECT_NEAR(Floats(in_water.budget().total_tvu())[0], std::hypot(Floats(without.budget().total_tvu())[0], share),
              1e-6);
  EXPECT_EQ(in_water.water().table().digest(), testing::ShippedWaterTable()->table().digest());
  EXPECT_NEAR(in_water.water().attenuation(), 0.85 * 0.15, 1e-12);
  EXPECT_FALSE(without.has_water());
}

TEST_F(WaterQueries, TakeOneIncidenceAndOneDepthForAllPulses) {
  v1::QueryBudgetRequest request = Request(testing::CoastalWater());
  request.mutable_aircraft()->set_roll(Column({-1, 0, 1}));
  const std::vector<float> share = Floats(Ask(request).budget().tvu_water());
  EXPECT_THAT(share, ElementsAre(share[0], share[0], share[0]));
  EXPECT_GT(share[0], 0.005);
}

TEST_F(WaterQueries, NameTheAxisOnWhichAPulseIsBeyond) {
  KnownWater water = testing::CoastalWater({.kd = 0.6, .kd_kind = KdKind::kDiffuse532});
  const v1::QueryBudgetResponse deep = Ask(Request(water, {2, 18}));
  EXPECT_LT(deep.water().greatest_depth(), 18);
  EXPECT_THAT(Bytes(deep.outcomes()), ElementsAre(v1::OUTCOME_INTERPOLATED, v1::OUTCOME_OUT_OF_DOMAIN));
  EXPECT_THAT(Bytes(deep.outcome_axes()), ElementsAre(0, v1::AXIS_DEPTH));
  EXPECT_TRUE(std::isnan(Floats(deep.budget().total_tvu())[1]));
  water.field_of_view = 1;
  const v1::QueryBudgetResponse cut = Ask(Request(water, {2}));
  EXPECT_THAT(Bytes(cut.outcome_axes()), ElementsAre(v1::AXIS_FOOTPRINT));
}

TEST_F(WaterQueries, TakeTheIndexOfTemperatureAndSalinity) {
  KnownWater water = testing::CoastalWater();
  water.temperature = 15;
  water.salinity = 35;
  v1::QueryBudgetRequest request = Request(water);
  EXPECT_NEAR(Ask(request).refractive_index(), 1.34199, 1e-5);
  request.mutable_options()->set_refractive_index(1.335);
  EXPECT_EQ(Ask(request).refractive_index(), 1.335);
}

TEST_F(WaterQueries, RefuseAWaterBesideItsColumns) {
  v1::QueryBudgetRequest request = Request(testing::CoastalWater());
  request.mutable_aircraft()->set_water_noise(Column({0.01f}));
  const grpc::Status status = StatusOf(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(FieldOf(status), "water");
  EXPECT_THAT(status.error_message(), HasSubstr("aircraft.water_noise"));
}

TEST_F(WaterQueries, NameAWrongFieldByItsPath) {
  v1::QueryBudgetRequest request = Request(testing::CoastalWater({.secchi = 5}));
  request.mutable_water()->set_secchi(-5);
  EXPECT_EQ(FieldOf(StatusOf(request)), "water.secchi");
  request = Request(testing::CoastalWater());
  request.mutable_water()->set_green_surface(true);
  EXPECT_TRUE(StatusOf(request).ok());
  request.mutable_options()->set_located(v1::SURFACE_LOCATION_LEVEL);
  EXPECT_EQ(FieldOf(StatusOf(request)), "water.green_surface");
  request = Request(testing::CoastalWater());
  request.mutable_water()->set_bias(v1::BIAS_HANDLING_CALIBRATED);
  request.mutable_water()->mutable_calibration()->set_depth(99);  // Beyond the table: found when it is compiled.
  const grpc::Status status = StatusOf(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(FieldOf(status), "water");
}

}  // namespace
}  // namespace albtpu::server
