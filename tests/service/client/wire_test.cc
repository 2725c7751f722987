#include "service/client/wire.h"

#include <gtest/gtest.h>

#include "tests/service/client/column_memory.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

TEST(Wire, AsksForWhatTheColumnsWant) {
  AnswerMemory memory(1);
  AnswerColumns wanted;
  wanted.values[Index(Quantity::kTvu)] = memory.columns().values[Index(Quantity::kTvu)];
  v1::QueryColumnsRequest request;
  ToWire({.coverage = Coverage::kP95, .s44_order = std::nullopt}, wanted, request);
  EXPECT_EQ(request.options().coverage(), v1::COVERAGE_P95);
  EXPECT_FALSE(request.options().standard_errors());
  EXPECT_FALSE(request.options().best_s44_order());
  ASSERT_EQ(request.quantities_size(), 1);
  EXPECT_EQ(request.quantities(0), v1::QUANTITY_TVU);

  v1::QueryColumnsRequest all;
  ToWire({.coverage = Coverage::kTwoSigma, .s44_order = S44Order::k2}, memory.columns(), all);
  EXPECT_TRUE(all.options().standard_errors());
  EXPECT_TRUE(all.options().best_s44_order());
  EXPECT_EQ(all.options().s44_order(), v1::S44_ORDER_2);
  EXPECT_EQ(all.quantities_size(), 6);
}

TEST(Wire, SendsWhatIsAlikeOnceAndWhatIsAbsentNotAtAll) {
  const float one = 1;
  const std::vector<float> depth(1000, 3.0f);
  PulseColumns pulses{.size = 1000, .axis = {}};
  pulses.axis.fill(std::span(&one, 1));
  pulses.axis[Index(AxisId::kAzimuth)] = {};
  pulses.axis[Index(AxisId::kDepth)] = depth;
  v1::PulseColumns columns;
  ToWire(pulses, columns);
  EXPECT_EQ(columns.wind_speed().size(), 4u);
  EXPECT_EQ(columns.azimuth().size(), 0u);
  EXPECT_EQ(columns.depth().size(), 4000u);
}

// An answer for one pulse, as a server should give it.
v1::QueryColumnsResponse GoodResponse() {
  v1::QueryColumnsResponse response;
  response.set_coverage(v1::COVERAGE_TWO_SIGMA);
  response.set_outcomes("\1");
  response.set_outcome_axes(std::string(1, '\0'));
  auto& columns = *response.mutable_sea_surface();
  for (std::string* column :
       {columns.mutable_refraction_along_wind(), columns.mutable_refraction_cross_wind(),
        columns.mutable_thu(), columns.mutable_tvu(), columns.mutable_bias_along_beam(),
        columns.mutable_bias_vertical()}) {
    *column = std::string(4, '\0');
  }
  return response;
}

TEST(Wire, RefusesAnswersThatBreakTheirRules) {
  AnswerMemory memory(1);
  AnswerColumns wanted = memory.columns();
  wanted.standard_errors = {};
  wanted.best_s44_orders = nullptr;
  wanted.remaining_thu = wanted.remaining_tvu = nullptr;
  const auto read = [&](const v1::QueryColumnsResponse& response) {
    return FromWire(response, {}, 1, wanted);
  };
  EXPECT_TRUE(read(GoodResponse()).ok());
  auto response = GoodResponse();
  response.set_coverage(v1::COVERAGE_P95);
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.set_outcomes("\1\1");
  EXPECT_FALSE(read(response).ok());
  for (const char* outcome : {"\7", "\xff"}) {
    response = GoodResponse();
    response.set_outcomes(outcome);
    EXPECT_FALSE(read(response).ok());
  }
  response = GoodResponse();
  response.set_outcome_axes("\7");
  EXPECT_FALSE(read(response).ok());
  response = GoodResponse();
  response.mutable_sea_surface()->set_tvu("short");
  EXPECT_FALSE(read(response).ok());
  wanted.standard_errors[0] = memory.columns().standard_errors[0];
  EXPECT_FALSE(read(GoodResponse()).ok());  // They are not there.
}

}  // namespace
}  // namespace albtpu::client
