// Queries that the server refuses: one table of cases for rows, columns, streams, budgets and seas.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "service/server/ground/limits.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Le;
using ::testing::Not;
using ::testing::SizeIs;

class InvalidQueries : public ServedTables {
 protected:
  static v1::QueryPulsesRequest Rows(std::size_t count = 1) {
    v1::QueryPulsesRequest request;
    for (std::size_t i = 0; i < count; ++i) *request.add_pulses() = WirePulse();
    return request;
  }

  static v1::QueryColumnsRequest Columns(const v1::PulseColumns& pulses = WireColumns(3)) {
    v1::QueryColumnsRequest request;
    *request.mutable_pulses() = pulses;
    return request;
  }

  static v1::QueryBudgetRequest Budget(const v1::PulseColumns& pulses = WireColumns(3)) {
    v1::QueryBudgetRequest request;
    request.mutable_options()->set_located(v1::SURFACE_LOCATION_LEVEL);
    *request.mutable_pulses() = pulses;
    request.mutable_aircraft()->set_altitude(Column({400}));
    request.mutable_aircraft()->set_beam_azimuth(Column({90}));
    return request;
  }

  // The status of a stream whose second request is invalid.
  grpc::Status StatusOfStream(const v1::QueryColumnsRequest& invalid) {
    v1::StreamColumnsRequest good, bad;
    *good.mutable_query() = Columns();
    *bad.mutable_query() = invalid;
    grpc::ClientContext context;
    const auto stream = stub_->StreamColumns(&context);
    for (const v1::StreamColumnsRequest& request : {good, bad, good}) stream->Write(request);
    v1::StreamColumnsResponse response;
    EXPECT_TRUE(stream->Read(&response));
    EXPECT_EQ(response.answer().pulse_count(), 3);
    EXPECT_FALSE(stream->Read(&response));
    return stream->Finish();
  }

  // Refused because of a field, with a message. Columns are refused in a stream, too.
  template <typename Request>
  void ExpectRefused(const Request& request, const std::string& field, const ::testing::Matcher<std::string>& message,
                     grpc::StatusCode code = grpc::StatusCode::INVALID_ARGUMENT) {
    SCOPED_TRACE(field);
    const auto expect = [&](const grpc::Status& status, const std::string& path) {
      EXPECT_EQ(status.error_code(), code) << status.error_message();
      EXPECT_THAT(status.error_message(), message);
      EXPECT_EQ(FieldOf(status), path);
    };
    expect(StatusOf(request), field);
    if constexpr (std::is_same_v<Request, v1::QueryColumnsRequest>)
      expect(StatusOfStream(request), field.empty() ? "" : "query." + field);
  }

  // A valid request with its options changed, refused by the path of the option.
  template <typename Request, typename Options>
  void ExpectRefusedOption(Request request, void (*change)(Options&), const std::string& path) {
    change(*request.mutable_options());
    ExpectRefused(request, path, HasSubstr(path));
  }
};

TEST_F(InvalidQueries, OfColumnsAreRefusedByEachMethod) {
  const auto refuse = [&](const v1::PulseColumns& pulses, const std::string& field, const std::string& message) {
    ExpectRefused(Columns(pulses), field, HasSubstr(message));
    v1::QueryBudgetRequest budget = Budget(pulses);
    if (pulses.ByteSizeLong() == 0) budget.clear_aircraft();  // Of which there would be one pulse.
    ExpectRefused(budget, field, HasSubstr(message));
  };
  refuse({}, "pulses", "there are no pulses");
  refuse(WireColumns(kMaxPulses + 1), "pulses.wind_speed", "column 'wind_speed' has 65537 numbers: ");
  v1::PulseColumns pulses = WireColumns(5);
  pulses.set_incidence(Column({1, 2, 3}));
  refuse(pulses, "pulses.incidence", "column 'incidence' has 3 numbers, column 'wind_speed' has 5");
  pulses = WireColumns(5);
  pulses.mutable_azimuth()->append("x");
  refuse(pulses, "pulses.azimuth", "column 'azimuth' has 21 bytes");
  pulses.set_azimuth("xyz");
  refuse(pulses, "pulses.azimuth", "column 'azimuth' has 3 bytes");
  pulses = WireColumns(5);
  pulses.clear_depth();
  refuse(pulses, "pulses.depth", "column 'depth' is empty");
}

TEST_F(InvalidQueries, OfNoRowsOrTooManyAreRefused) {
  ExpectRefused(Rows(0), "pulses", HasSubstr("send at least one"));
  ExpectRefused(Rows(kMaxPulses + 1), "pulses", AllOf(HasSubstr("65537"), HasSubstr("65536")));
}

TEST_F(InvalidQueries, OfAnUnknownTableListTheExistingOnes) {
  const auto refuse = [&](auto request) {
    request.mutable_options()->set_table("slow");
    ExpectRefused(request, "",
                  AllOf(HasSubstr("'slow'"), HasSubstr("published, survey, twice/2, twice/1"),
                        Not(HasSubstr(folder_.path().string()))),
                  grpc::StatusCode::NOT_FOUND);
  };
  refuse(Rows());
  refuse(Columns());
  refuse(Budget());
}

TEST_F(InvalidQueries, OfOptionsOutOfRangeAreRefusedByTheirPath) {
  const auto refuse = [&](void (*change)(v1::QueryOptions&), const std::string& path) {
    ExpectRefusedOption(Rows(), change, path);
    ExpectRefusedOption(Columns(), change, path);
  };
  refuse([](auto& o) { o.set_coverage(static_cast<v1::Coverage>(7)); }, "options.coverage");
  refuse([](auto& o) { o.set_s44_order(static_cast<v1::S44Order>(-1)); }, "options.s44_order");
  const auto of_budget = [&](void (*change)(v1::BudgetOptions&), const std::string& path) {
    ExpectRefusedOption(Budget(), change, path);
  };
  of_budget([](auto& o) { o.clear_located(); }, "options.located");
  of_budget([](auto& o) { o.set_located(static_cast<v1::SurfaceLocation>(4)); }, "options.located");
  of_budget([](auto& o) { o.set_coverage(static_cast<v1::Coverage>(4)); }, "options.coverage");
  of_budget([](auto& o) { o.mutable_errors()->set_scan(-1); }, "options.errors.scan");
  of_budget([](auto& o) { o.mutable_errors()->set_time(INFINITY); }, "options.errors.time");
  of_budget([](auto& o) { o.mutable_errors()->mutable_attitude()->set_heading(NAN); },
            "options.errors.attitude.heading");
  of_budget([](auto& o) { o.mutable_lever_arm()->set_down(NAN); }, "options.lever_arm.down");
  of_budget([](auto& o) { o.set_refractive_index(2.1); }, "options.refractive_index");
  of_budget([](auto& o) { o.set_refractive_index(0); }, "options.refractive_index");
  of_budget([](auto& o) { o.set_datum(-1); }, "options.datum");
  of_budget([](auto& o) { o.set_extra_horizontal(-1); }, "options.extra_horizontal");
  of_budget([](auto& o) { o.set_extra_vertical(NAN); }, "options.extra_vertical");
  of_budget([](auto& o) { o.set_sea_axis(NAN); }, "options.sea_axis");
  of_budget([](auto& o) { o.set_sea_axis(1e300); }, "options.sea_axis");
}

TEST_F(InvalidQueries, OfAnAircraftThatCannotBeReadAreRefused) {
  v1::QueryBudgetRequest request = Budget();
  request.mutable_aircraft()->set_roll("12345");
  ExpectRefused(request, "aircraft.roll", HasSubstr("column 'roll' has 5 bytes"));
  request.mutable_aircraft()->set_roll(Column({1, 2}));
  ExpectRefused(request, "aircraft.roll", HasSubstr("column 'roll' has 2 numbers"));
  request = Budget();
  request.mutable_aircraft()->clear_altitude();
  ExpectRefused(request, "aircraft.altitude", HasSubstr("column 'altitude' is empty"));
}

TEST_F(InvalidQueries, OfQuantitiesThatDoNotExistOrNotFitAreRefused) {
  for (const int number : {0, 7, -1}) {
    v1::QueryColumnsRequest request = Columns();
    request.add_quantities(static_cast<v1::Quantity>(number));
    ExpectRefused(request, "quantities", HasSubstr("quantities"));
  }
  v1::QueryBudgetRequest request = Budget();
  request.add_quantities(v1::BUDGET_QUANTITY_UNSPECIFIED);
  ExpectRefused(request, "quantities", HasSubstr("BUDGET_QUANTITY_UNSPECIFIED"));
  request = Budget(WireColumns(kMaxPulses));
  for (int quantity = 1; quantity < v1::BudgetQuantity_ARRAYSIZE; ++quantity)
    request.add_quantities(static_cast<v1::BudgetQuantity>(quantity));
  ExpectRefused(request, "pulses", HasSubstr("a message takes"));
}

TEST_F(InvalidQueries, OfASeaAreRefusedByTheFieldOfTheSea) {
  v1::QueryColumnsRequest request = Columns();
  request.mutable_sea()->set_wind_speed(-1);
  ExpectRefused(request, "sea.wind_speed", HasSubstr("wind_speed is -1"));
  request.mutable_sea()->set_wind_speed(5);
  request.mutable_options()->set_table("survey");
  ExpectRefused(request, "options.table", HasSubstr("options.table is 'survey'"));
  request.mutable_options()->set_table(std::string(100000, 'x'));  // Metadata would not hold it.
  ExpectRefused(request, "options.table",
                AllOf(HasSubstr("options.table is 'xxx"), SizeIs(Le(kMaxErrorBytes + std::strlen("...")))));
  request.clear_sea();
  ExpectRefused(request, "", HasSubstr("xxx"), grpc::StatusCode::NOT_FOUND);
  ExpectRefused(v1::CompileSeaRequest(), "sea", HasSubstr("sea is missing"));
}

}  // namespace
}  // namespace albtpu::server
