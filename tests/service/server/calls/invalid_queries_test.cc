// Queries that the server refuses, by each of its methods: with the status, the field and the words of one table.
#include <gmock/gmock.h>

#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Stub = v1::UncertaintyService::Stub;

class InvalidQueries : public ServedTables {
 protected:
  void ExpectRefused(const grpc::Status& status, grpc::StatusCode code, const std::string& field,
                     const ::testing::Matcher<std::string>& message) {
    EXPECT_EQ(status.error_code(), code) << status.error_message();
    EXPECT_THAT(status.error_message(), message);
    EXPECT_EQ(FieldOf(status), field);
  }

  // As QueryColumns, QueryBudget with an aircraft, and the second request of StreamColumns, which then ends.
  void ExpectRefused(const v1::QueryOptions& options, const v1::PulseColumns& pulses, grpc::StatusCode code,
                     const std::string& field, const ::testing::Matcher<std::string>& message) {
    v1::QueryColumnsRequest columns;
    *columns.mutable_options() = options;
    *columns.mutable_pulses() = pulses;
    v1::QueryColumnsResponse columns_response;
    ExpectRefused(Call(&Stub::QueryColumns, columns, columns_response), code, field, message);
    v1::QueryBudgetRequest budget;
    budget.mutable_options()->set_table(options.table());
    budget.mutable_options()->set_located(v1::SURFACE_LOCATION_LEVEL);
    *budget.mutable_pulses() = pulses;
    budget.mutable_aircraft()->set_altitude(Column({400}));
    budget.mutable_aircraft()->set_beam_azimuth(Column({90}));
    v1::QueryBudgetResponse budget_response;
    if (pulses.ByteSizeLong() > 0)  // Otherwise its one pulse is that of the aircraft.
      ExpectRefused(Call(&Stub::QueryBudget, budget, budget_response), code, field, message);
    v1::StreamColumnsRequest good, bad;
    *good.mutable_query()->mutable_pulses() = WireColumns(3);
    *bad.mutable_query() = columns;
    grpc::ClientContext context;
    const auto stream = stub_->StreamColumns(&context);
    for (const v1::StreamColumnsRequest& request : {good, bad, good}) stream->Write(request);
    v1::StreamColumnsResponse response;
    ASSERT_TRUE(stream->Read(&response));
    EXPECT_EQ(response.answer().pulse_count(), 3);
    EXPECT_FALSE(stream->Read(&response));
    ExpectRefused(stream->Finish(), code, field.empty() ? "" : "query." + field, message);
  }
};

TEST_F(InvalidQueries, OfColumnsAreRefusedByEachMethod) {
  const auto refuse = [&](const auto& spoil, const std::string& field, const std::string& message) {
    v1::PulseColumns pulses = WireColumns(5);
    spoil(pulses);
    SCOPED_TRACE(message);
    ExpectRefused({}, pulses, grpc::StatusCode::INVALID_ARGUMENT, field, HasSubstr(message));
  };
  refuse([](v1::PulseColumns& pulses) { pulses.Clear(); }, "pulses", "there are no pulses: send at least one");
  refuse(
      [](v1::PulseColumns& pulses) {
        pulses.set_incidence(Column({1, 2, 3}));
      },
      "pulses.incidence", "column 'incidence' has 3 numbers, column 'wind_speed' has 5");
  refuse([](v1::PulseColumns& pulses) { pulses.mutable_azimuth()->append("x"); }, "pulses.azimuth",
         "column 'azimuth' has 21 bytes");
  refuse([](v1::PulseColumns& pulses) { pulses.set_depth("xyz"); }, "pulses.depth", "column 'depth' has 3 bytes");
  refuse([](v1::PulseColumns& pulses) { pulses.clear_depth(); }, "pulses.depth", "column 'depth' is empty");
  refuse([](v1::PulseColumns& pulses) { pulses = WireColumns(kMaxPulses + 1); }, "pulses.wind_speed",
         "column 'wind_speed' has 65537 numbers: ");
}

TEST_F(InvalidQueries, OfRowsAreRefused) {
  const auto refuse = [&](std::size_t count, const ::testing::Matcher<std::string>& message) {
    v1::QueryPulsesRequest request;
    for (std::size_t i = 0; i < count; ++i) *request.add_pulses() = WirePulse();
    v1::QueryPulsesResponse response;
    ExpectRefused(QueryPulses(request, response), grpc::StatusCode::INVALID_ARGUMENT, "pulses", message);
  };
  refuse(0, HasSubstr("send at least one"));
  refuse(kMaxPulses + 1, AllOf(HasSubstr("65537"), HasSubstr("65536")));
}

TEST_F(InvalidQueries, OfAnUnknownTableListTheExistingOnes) {
  v1::QueryPulsesRequest rows;
  *rows.add_pulses() = WirePulse();
  rows.mutable_options()->set_table("slow");
  const auto message = AllOf(HasSubstr("'slow'"), HasSubstr("published, survey, twice/2, twice/1"),
                             Not(HasSubstr(folder_.path().string())));
  v1::QueryPulsesResponse response;
  ExpectRefused(QueryPulses(rows, response), grpc::StatusCode::NOT_FOUND, "", message);
  ExpectRefused(rows.options(), WireColumns(1), grpc::StatusCode::NOT_FOUND, "", message);
}

}  // namespace
}  // namespace albtpu::server
