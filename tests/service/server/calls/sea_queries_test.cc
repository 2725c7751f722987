// Queries with a sea, through a running server.
#include <gmock/gmock.h>

#include "sea/angle.h"
#include "sea/correlation/pulse_correlation.h"
#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "tables/file/table_encoder.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

using SeaQueries = ServedTables;

TEST_F(SeaQueries, GiveTheSameBitsInRowsAndInColumns) {
  v1::QueryPulsesRequest rows;
  *rows.mutable_sea() = client::ToWire(testing::DescribedWaves());
  v1::Pulse pulse = WirePulse();
  *rows.add_pulses() = pulse;
  pulse.clear_wind_speed();
  pulse.clear_fetch();
  *rows.add_pulses() = pulse;
  pulse.clear_azimuth();
  *rows.add_pulses() = pulse;
  v1::QueryColumnsRequest columns;
  *columns.mutable_sea() = rows.sea();
  *columns.mutable_pulses() = WireColumns(4);
  const v1::QueryPulsesResponse in_rows = Ask(rows);
  const v1::QueryColumnsResponse in_columns = Ask(columns);
  const float thu = Floats(in_columns.sea_surface().thu())[0];
  EXPECT_EQ(in_rows.uncertainties(0).sea_surface().thu(), thu);
  EXPECT_EQ(in_rows.uncertainties(1).sea_surface().thu(), thu);
  EXPECT_GE(in_rows.uncertainties(2).sea_surface().thu(), thu);
  EXPECT_EQ(in_rows.sea().SerializeAsString(), in_columns.sea().SerializeAsString());
}

TEST_F(SeaQueries, GetTheTableAsAFile) {
  v1::CompileSeaRequest request;
  *request.mutable_sea() = client::ToWire(testing::MeasuredWaves());
  v1::CompileSeaResponse response = Ask(request);
  const UncertaintyTable table = OrDie(CompileSea(SeaCompiler(), testing::MeasuredWaves()));
  EXPECT_EQ(response.table().reference().digest(), table.digest());
  EXPECT_EQ(response.table().axes_size(), 6);
  EXPECT_TRUE(response.table().has_sea());
  EXPECT_EQ(response.file(), "");
  request.set_with_file(true);
  response = Ask(request);
  EXPECT_EQ(OrDie(DecodeTable(response.file())).digest(), table.digest());
  EXPECT_LT(response.file().size(), kMaxMessageBytes / 4);
}

TEST_F(SeaQueries, TellWhatNeighbouringPulsesShare) {
  v1::CompileSeaRequest request;
  *request.mutable_sea() = client::ToWire(testing::DescribedWaves());
  EXPECT_FALSE(Ask(request).has_correlation());
  v1::CorrelationQuery& query = *request.mutable_correlation();
  query.set_incidence(18);
  query.set_azimuth(40);
  query.set_footprint(0.5);
  v1::PulseSeparation& pair = *query.add_separations();
  pair.set_x(1);
  pair.set_y(-0.5);
  pair.set_seconds(0.2);
  v1::SurfaceCell& cell = *query.add_cells();
  cell.set_side(2);
  cell.set_orientation(30);
  const v1::SeaCorrelation found = Ask(request).correlation();

  const DescribedSea described = Describe(testing::DescribedWaves());
  const WaveCorrelation sea(described.spectrum, {.water_depth = described.water_depth});
  const BeamCorrelation beam(
      sea, {.incidence = RadiansOfDegrees(18), .azimuth = RadiansOfDegrees(40), .footprint = 0.5}, kSeaWaterIndex);
  const PulseCorrelation of_pair = CorrelationOf(beam.Between({1, -0.5}, 0.2), beam.pulse());
  const PulseCorrelation of_cell =
      CorrelationOf(beam.InCell({.side = 2, .orientation = RadiansOfDegrees(30)}), beam.pulse());
  ASSERT_EQ(found.separations_size(), 1);
  EXPECT_EQ(found.separations(0).horizontal(), of_pair.horizontal);
  EXPECT_EQ(found.separations(0).vertical(), of_pair.vertical);
  ASSERT_EQ(found.cells_size(), 1);
  EXPECT_EQ(found.cells(0).slope_x(), of_cell.slope_x);
  EXPECT_EQ(found.cells(0).slope_y(), of_cell.slope_y);
  EXPECT_EQ(found.cells(0).height(), of_cell.height);
}

TEST_F(SeaQueries, NameTheWrongNumbersOfACorrelation) {
  const auto problem_of = [this](const auto& spoil) {
    v1::CompileSeaRequest request;
    *request.mutable_sea() = client::ToWire(testing::WindSea(7));
    request.mutable_correlation()->set_footprint(0.5);
    request.mutable_correlation()->add_separations()->set_x(1);
    request.mutable_correlation()->add_cells()->set_side(1);
    spoil(*request.mutable_correlation());
    return StatusOf(request).error_message();
  };
  EXPECT_EQ(problem_of([](auto&) {}), "");
  EXPECT_THAT(problem_of([](auto& q) { q.set_footprint(0); }), HasSubstr("footprint is 0 m"));
  EXPECT_THAT(problem_of([](auto& q) { q.set_incidence(31); }), HasSubstr("incidence is 31 degrees"));
  EXPECT_THAT(problem_of([](auto& q) { q.set_refractive_index(1.5); }), HasSubstr("refractive_index is 1.5"));
  EXPECT_THAT(problem_of([](auto& q) { q.mutable_separations(0)->set_y(60); }), HasSubstr("separations[0]"));
  EXPECT_THAT(problem_of([](auto& q) { q.mutable_cells(0)->set_side(51); }), HasSubstr("cells[0].side is 51"));
  EXPECT_THAT(problem_of([](auto& q) {
                for (int i = 0; i < 64; ++i) q.add_cells()->set_side(1);
              }),
              HasSubstr("cells has 65 entries (64 at most)"));
}

}  // namespace
}  // namespace albtpu::server
