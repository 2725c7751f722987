// Queries with a sea, through a running server.
#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "tables/file/table_encoder.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

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

}  // namespace
}  // namespace albtpu::server
