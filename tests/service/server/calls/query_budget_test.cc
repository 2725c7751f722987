// The whole budget, through a running server. tests/service/client/budget_source_test.cc compares its bits, of each
// coverage and each form of a sea, with those in process.
#include <gmock/gmock.h>

#include <cmath>

#include "service/client/wire.h"
#include "service/server/ground/limits.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using testing::BudgetMemory;
using testing::BudgetPulseMemory;
using ::testing::ElementsAre;
using ::testing::SizeIs;

class QueryBudget : public ServedTables {
 protected:
  // A request about these pulses for all quantities, with the usual options.
  static v1::QueryBudgetRequest Request(const BudgetPulseMemory& pulses) {
    v1::QueryBudgetRequest request;
    BudgetMemory all(1);
    client::ToWire(testing::UsualOptions(), pulses.columns(), all.columns(), request);
    request.mutable_options()->set_table("survey");
    ColumnMessage bytes;
    bytes.Add(request);
    client::AddPulses(pulses.columns(), bytes);
    grpc::ByteBuffer buffer = bytes.Finish();
    grpc::Slice slice;
    EXPECT_TRUE(buffer.DumpToSingleSlice(&slice).ok());
    EXPECT_TRUE(request.ParseFromArray(slice.begin(), static_cast<int>(slice.size())));
    return request;
  }
};

TEST_F(QueryBudget, AnswersTheTotalIfNoQuantityIsNamed) {
  v1::QueryBudgetRequest request = Request(testing::RandomBudgetPulses(5));
  const v1::QueryBudgetResponse all = Ask(request);
  request.clear_quantities();
  const v1::QueryBudgetResponse total = Ask(request);
  EXPECT_EQ(total.budget().total_thu(), all.budget().total_thu());
  EXPECT_EQ(total.budget().total_tvu(), all.budget().total_tvu());
  EXPECT_EQ(total.budget().thu_air(), "");
  EXPECT_EQ(total.budget().covariance_total(), "");
  EXPECT_EQ(total.budget().best_s44_orders(), "");
}

TEST_F(QueryBudget, TakesOneNumberForAllPulsesFromEitherMessage) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(4);
  for (auto& column : pulses.axes) column.resize(1);
  for (auto& column : pulses.inputs) column.resize(std::min<std::size_t>(column.size(), 1));
  pulses[BudgetInput::kRoll] = {-2, -1, 0, 1};  // Alone says how many there are.
  v1::QueryBudgetRequest request = Request(pulses);
  request.mutable_pulses()->set_depth(Column(pulses.axes[Index(AxisId::kDepth)]));
  const v1::QueryBudgetResponse response = Ask(request);
  EXPECT_EQ(response.pulse_count(), 4);
  for (auto& column : pulses.axes) column.resize(4, column[0]);
  for (auto& column : pulses.inputs)
    if (column.size() == 1) column.resize(4, column[0]);
  EXPECT_EQ(Ask(Request(pulses)).SerializeAsString(), response.SerializeAsString());
}

TEST_F(QueryBudget, GivesAPulseOfAnInvalidAircraftItsOwnOutcome) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
  pulses[BudgetInput::kAltitude] = {400, 0, 400};
  pulses.axes[Index(AxisId::kIncidence)] = {5, 5, 90};
  const v1::QueryBudgetResponse response = Ask(Request(pulses));
  EXPECT_THAT(Bytes(response.outcomes()),
              ElementsAre(v1::OUTCOME_INTERPOLATED, v1::OUTCOME_INVALID, v1::OUTCOME_OUT_OF_DOMAIN));
  EXPECT_THAT(Bytes(response.outcome_axes()), ElementsAre(0, v1::AXIS_UNSPECIFIED, v1::AXIS_INCIDENCE));
  const std::vector<float> thu = Floats(response.budget().total_thu());
  EXPECT_TRUE(std::isfinite(thu[0]) && std::isnan(thu[1]) && std::isnan(thu[2]));
}

TEST_F(QueryBudget, AnswersAsManyPulsesAsAMessageHolds) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(1);
  pulses.axes[Index(AxisId::kDepth)].assign(kMaxPulses, 5);
  pulses.size = kMaxPulses;
  v1::QueryBudgetRequest request = Request(pulses);
  request.clear_quantities();
  EXPECT_THAT(Bytes(Ask(request).outcomes()), SizeIs(kMaxPulses));
}

TEST_F(QueryBudget, IsCountedByOutcome) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(3);
  pulses[BudgetInput::kPitch] = {0, NAN, 0};
  Ask(Request(pulses));
  double invalid = 0;
  for (const prometheus::MetricFamily& family : metrics_.registry->Collect()) {
    if (family.name != "albtpu_pulses_total") continue;
    for (const prometheus::ClientMetric& metric : family.metric)
      for (const auto& label : metric.label) invalid += label.value == "aircraft" ? metric.counter.value : 0;
  }
  EXPECT_EQ(invalid, 1);
}

}  // namespace
}  // namespace albtpu::server
