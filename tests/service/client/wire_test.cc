#include "service/client/wire.h"

#include <gtest/gtest.h>

#include "tests/service/client/column_memory.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

TEST(Wire, RequestsTheColumnsThatAreNotNull) {
  AnswerMemory memory(1);
  AnswerColumns requested;
  requested.values[Index(Quantity::kTvu)] = memory.columns().values[Index(Quantity::kTvu)];
  v1::QueryColumnsRequest request;
  ToWire({.coverage = Coverage::kP95, .s44_order = std::nullopt}, requested, request);
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

v1::PulseColumns Sent(const PulseColumns& pulses) {
  ColumnMessage message;
  AddPulses(pulses, message);
  grpc::ByteBuffer bytes = message.Finish();
  grpc::Slice slice;
  EXPECT_TRUE(bytes.DumpToSingleSlice(&slice).ok());
  v1::QueryColumnsRequest request;
  EXPECT_TRUE(request.ParseFromArray(slice.begin(), static_cast<int>(slice.size())));
  return request.pulses();
}

TEST(Wire, SendsConstantColumnsOnceAndAbsentOnesNotAtAll) {
  const float one = 1;
  const std::vector<float> depth(1000, 3.0f);
  PulseColumns pulses{.size = 1000, .axis = {}};
  pulses.axis.fill(std::span(&one, 1));
  pulses.axis[Index(AxisId::kAzimuth)] = {};
  EXPECT_EQ(Sent(pulses).depth().size(), 4000u);  // Otherwise the number of pulses would be lost.
  pulses.axis[Index(AxisId::kDepth)] = depth;
  const v1::PulseColumns columns = Sent(pulses);
  EXPECT_EQ(columns.wind_speed(), std::string(reinterpret_cast<const char*>(&one), 4));
  EXPECT_EQ(columns.azimuth(), "");
  EXPECT_EQ(columns.depth(), std::string(reinterpret_cast<const char*>(depth.data()), 4000));
}

}  // namespace
}  // namespace albtpu::client
