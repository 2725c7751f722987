// The whole budget, through a running server.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/server/ground/limits.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/service/known_seas.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using testing::BudgetMemory;
using testing::BudgetPulseMemory;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
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

  v1::QueryBudgetResponse Ask(const v1::QueryBudgetRequest& request) {
    v1::QueryBudgetResponse response;
    const grpc::Status status = Call(&v1::UncertaintyService::Stub::QueryBudget, request, response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  // The request fails because of this field.
  void ExpectRefused(const v1::QueryBudgetRequest& request, const std::string& field, const std::string& message) {
    v1::QueryBudgetResponse response;
    const grpc::Status status = Call(&v1::UncertaintyService::Stub::QueryBudget, request, response);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << field;
    EXPECT_THAT(status.error_message(), HasSubstr(message));
    EXPECT_EQ(FieldOf(status), field);
  }
};

std::vector<int> Bytes(const std::string& column) { return {column.begin(), column.end()}; }

// Every column of a response has the bits of the same query in process.
void ExpectSame(const v1::QueryBudgetResponse& response, const BudgetMemory& expected) {
  EXPECT_EQ(response.outcomes(), std::string(expected.outcomes.begin(), expected.outcomes.end()));
  EXPECT_EQ(response.outcome_axes(), std::string(expected.outcome_axes.begin(), expected.outcome_axes.end()));
  const v1::BudgetColumns& budget = response.budget();
  EXPECT_EQ(budget.best_s44_orders(), std::string(expected.best_s44_orders.begin(), expected.best_s44_orders.end()));
  const auto same = [&](const std::string& column, BudgetQuantity quantity) {
    std::string bytes;
    for (std::size_t i = 0; i < ColumnCount(quantity); ++i)
      bytes += Column(expected.numbers[FirstColumn(quantity) + i]);
    EXPECT_TRUE(column == bytes) << static_cast<int>(quantity);
  };
  using enum BudgetQuantity;
  same(budget.total_thu(), kTotalThu);
  same(budget.total_tvu(), kTotalTvu);
  same(budget.thu_air(), kThuAir);
  same(budget.tvu_air(), kTvuAir);
  same(budget.thu_sea(), kThuSea);
  same(budget.tvu_sea(), kTvuSea);
  same(budget.bias_along_beam(), kBiasAlongBeam);
  same(budget.bias_vertical(), kBiasVertical);
  same(budget.covariance_total(), kCovarianceTotal);
  same(budget.covariance_air(), kCovarianceAir);
  same(budget.covariance_sea(), kCovarianceSea);
  same(budget.covariance_pulse(), kCovariancePulse);
  same(budget.covariance_line(), kCovarianceLine);
  same(budget.covariance_survey(), kCovarianceSurvey);
}

BudgetMemory InProcess(const UncertaintyTable& table, const BudgetPulses& pulses,
                       const BudgetOptions& options = testing::UsualOptions()) {
  BudgetMemory expected(pulses.pulses.size);
  QueryBudgetOnAllCores(ColumnInterpolator(table), pulses, options, expected.columns());
  return expected;
}

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

TEST_F(QueryBudget, OfOneSigmaIsHalfThatOfTwo) {
  v1::QueryBudgetRequest request = Request(testing::RandomBudgetPulses(50));
  request.mutable_options()->set_coverage(v1::COVERAGE_UNSPECIFIED);
  const v1::QueryBudgetResponse two = Ask(request);
  EXPECT_EQ(two.coverage(), v1::COVERAGE_TWO_SIGMA);
  request.mutable_options()->set_coverage(v1::COVERAGE_ONE_SIGMA);
  const v1::QueryBudgetResponse one = Ask(request);
  EXPECT_EQ(one.coverage(), v1::COVERAGE_ONE_SIGMA);
  const std::vector<float> thu = Floats(one.budget().total_thu()), twice = Floats(two.budget().total_thu());
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(2 * thu[i], twice[i]);
  EXPECT_EQ(one.budget().covariance_total(), two.budget().covariance_total());
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
  ExpectSame(response, InProcess(survey_, pulses.columns()));
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

TEST_F(QueryBudget, IsAnsweredOnASeaWithTheAxisOfThatSea) {
  for (const KnownSea& sea : testing::SeasOfAllForms()) {
    BudgetPulseMemory pulses = testing::RandomBudgetPulses(20);
    v1::QueryBudgetRequest request = Request(pulses);
    request.mutable_options()->clear_table();
    request.mutable_pulses()->clear_wind_speed();
    *request.mutable_sea() = client::ToWire(sea);
    const v1::QueryBudgetResponse response = Ask(request);
    const UncertaintyTable table = OrDie(CompileSea(SeaCompiler(), sea));
    EXPECT_EQ(response.table().digest(), table.digest());
    const SeaSummary summary = SummaryOfSea(table).value();
    EXPECT_EQ(response.sea().x_azimuth(), summary.x_azimuth);
    BudgetPulses columns = pulses.columns();
    columns.pulses.axis[Index(AxisId::kWindSpeed)] = columns.pulses.axis[Index(AxisId::kFetch)] = {};
    columns.sea_axis = summary.x_azimuth;
    ExpectSame(response, InProcess(table, columns));
  }
}

TEST_F(QueryBudget, RefusesOptionsOutOfRangeByTheirPath) {
  const v1::QueryBudgetRequest valid = Request(testing::RandomBudgetPulses(2));
  const auto refuse = [&](const std::function<void(v1::BudgetOptions&)>& change, const std::string& field) {
    v1::QueryBudgetRequest request = valid;
    change(*request.mutable_options());
    ExpectRefused(request, field, field);
  };
  using Options = v1::BudgetOptions;
  refuse([](Options& o) { o.clear_located(); }, "options.located");
  refuse([](Options& o) { o.set_located(static_cast<v1::SurfaceLocation>(4)); }, "options.located");
  refuse([](Options& o) { o.set_coverage(static_cast<v1::Coverage>(4)); }, "options.coverage");
  refuse([](Options& o) { o.mutable_errors()->set_scan(-1); }, "options.errors.scan");
  refuse([](Options& o) { o.mutable_errors()->set_time(INFINITY); }, "options.errors.time");
  refuse([](Options& o) { o.mutable_errors()->mutable_attitude()->set_heading(NAN); },
         "options.errors.attitude.heading");
  refuse([](Options& o) { o.mutable_lever_arm()->set_down(NAN); }, "options.lever_arm.down");
  refuse([](Options& o) { o.set_refractive_index(2.1); }, "options.refractive_index");
  refuse([](Options& o) { o.set_refractive_index(0); }, "options.refractive_index");
  refuse([](Options& o) { o.set_datum(-1); }, "options.datum");
  refuse([](Options& o) { o.set_sea_axis(NAN); }, "options.sea_axis");
  refuse([](Options& o) { o.set_sea_axis(1e300); }, "options.sea_axis");
}

TEST_F(QueryBudget, RefusesColumnsThatCannotBeRead) {
  const v1::QueryBudgetRequest valid = Request(testing::RandomBudgetPulses(3));
  v1::QueryBudgetRequest request = valid;
  request.mutable_aircraft()->set_roll("12345");
  ExpectRefused(request, "aircraft.roll", "column 'roll' has 5 bytes");
  request = valid;
  request.mutable_aircraft()->set_roll(Column({1, 2}));
  ExpectRefused(request, "aircraft.roll", "column 'roll' has 2 numbers");
  request = valid;
  request.mutable_aircraft()->clear_altitude();
  ExpectRefused(request, "aircraft.altitude", "column 'altitude' is empty");
  request = valid;
  request.clear_pulses();
  request.clear_aircraft();
  ExpectRefused(request, "pulses", "there are no pulses");
  request = valid;
  request.add_quantities(v1::BUDGET_QUANTITY_UNSPECIFIED);
  ExpectRefused(request, "quantities", "BUDGET_QUANTITY_UNSPECIFIED");
}

TEST_F(QueryBudget, RefusesMorePulsesThanItsAnswerMayHold) {
  BudgetPulseMemory pulses = testing::RandomBudgetPulses(1);
  pulses.axes[Index(AxisId::kDepth)].assign(kMaxPulses, 5);
  pulses.size = kMaxPulses;
  v1::QueryBudgetRequest request = Request(pulses);
  ExpectRefused(request, "pulses", "a message takes");
  request.clear_quantities();
  EXPECT_THAT(Bytes(Ask(request).outcomes()), SizeIs(kMaxPulses));
  request.mutable_pulses()->mutable_depth()->append(4, '\0');
  ExpectRefused(request, "pulses.depth", "pulses at most");
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
