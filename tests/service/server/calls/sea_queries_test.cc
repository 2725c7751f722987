// Queries with a sea, through a running server.
#include <gmock/gmock.h>

#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_pulses.h"
#include "tables/file/table_encoder.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

class SeaQueries : public ServedTables {
 protected:
  static v1::QueryColumnsRequest Request(const KnownSea& sea, std::size_t count = 4) {
    v1::QueryColumnsRequest request;
    *request.mutable_sea() = client::ToWire(sea);
    *request.mutable_pulses() = WireColumns(count);
    return request;
  }

  UncertaintyTable Compiled(const KnownSea& sea) const { return OrDie(CompileSea(compiler_, sea)); }

  SeaCompiler compiler_;
};

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
  v1::QueryPulsesResponse in_rows;
  ASSERT_TRUE(QueryPulses(rows, in_rows).ok());
  v1::QueryColumnsResponse in_columns;
  ASSERT_TRUE(QueryColumns(Request(testing::DescribedWaves()), in_columns).ok());
  const float thu = Floats(in_columns.sea_surface().thu())[0];
  EXPECT_EQ(in_rows.uncertainties(0).sea_surface().thu(), thu);
  EXPECT_EQ(in_rows.uncertainties(1).sea_surface().thu(), thu);
  EXPECT_GE(in_rows.uncertainties(2).sea_surface().thu(), thu);
  EXPECT_EQ(in_rows.sea().SerializeAsString(), in_columns.sea().SerializeAsString());
}

TEST_F(SeaQueries, AreRefusedWithATableBesideTheSea) {
  v1::QueryColumnsRequest request = Request(testing::DescribedWaves());
  request.mutable_options()->set_table("survey");
  v1::QueryColumnsResponse response;
  const grpc::Status status = QueryColumns(request, response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("options.table is 'survey'"));
  EXPECT_THAT(status.error_details(), HasSubstr("options.table"));
}

TEST_F(SeaQueries, NameTheFieldOfTheSeaThatIsWrong) {
  v1::StreamColumnsRequest request;
  *request.mutable_query() = Request({.wind_speed_10m = -1});
  v1::QueryColumnsResponse response;
  const grpc::Status alone = QueryColumns(request.query(), response);
  EXPECT_EQ(alone.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(alone.error_details(), HasSubstr("sea.wind_speed"));
  grpc::ClientContext context;
  const auto stream = stub_->StreamColumns(&context);
  stream->Write(request);
  v1::StreamColumnsResponse answer;
  EXPECT_FALSE(stream->Read(&answer));
  EXPECT_THAT(stream->Finish().error_details(), HasSubstr("query.sea.wind_speed"));
}

TEST_F(SeaQueries, GetTheTableAsAFile) {
  v1::CompileSeaRequest request;
  *request.mutable_sea() = client::ToWire(testing::MeasuredWaves());
  v1::CompileSeaResponse response;
  ASSERT_TRUE(Call(&v1::UncertaintyService::Stub::CompileSea, request, response).ok());
  const UncertaintyTable table = Compiled(testing::MeasuredWaves());
  EXPECT_EQ(response.table().reference().digest(), table.digest());
  EXPECT_EQ(response.table().axes_size(), 6);
  EXPECT_TRUE(response.table().has_sea());
  EXPECT_EQ(response.file(), "");
  request.set_with_file(true);
  ASSERT_TRUE(Call(&v1::UncertaintyService::Stub::CompileSea, request, response).ok());
  EXPECT_EQ(OrDie(DecodeTable(response.file())).digest(), table.digest());
  EXPECT_LT(response.file().size(), kMaxMessageBytes / 4);
}

TEST_F(SeaQueries, NeedASeaToCompile) {
  v1::CompileSeaResponse response;
  const grpc::Status status = Call(&v1::UncertaintyService::Stub::CompileSea, v1::CompileSeaRequest(), response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("sea is missing"));
}

}  // namespace
}  // namespace albtpu::server
