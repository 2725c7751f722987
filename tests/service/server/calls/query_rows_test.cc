#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "service/server/ground/limits.h"
#include "tables/coverage.h"
#include "tables/s44.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

class QueryPulses : public ServedTables {
 protected:
  static v1::QueryPulsesRequest Request(const v1::Pulse& pulse, const v1::QueryOptions& options = {}) {
    v1::QueryPulsesRequest request;
    *request.mutable_options() = options;
    *request.add_pulses() = pulse;
    return request;
  }

  v1::PulseUncertainty AskOne(const v1::Pulse& pulse, const v1::QueryOptions& options = {}) {
    const v1::QueryPulsesResponse response = Ask(Request(pulse, options));
    EXPECT_EQ(response.uncertainties_size(), 1);
    return response.uncertainties(0);
  }
};

// The server computes in single precision, within 1e-5 of the reference implementation (column_query.h). A number that
// the reference does not have is absent.
void ExpectNear(const v1::SeaSurface& wire, const std::array<float, kQuantityCount>& values) {
  for (std::size_t q = 0; q < kQuantityCount; ++q) {
    const std::string name(Describe(kQuantities[q]).name);
    const google::protobuf::FieldDescriptor* field = v1::SeaSurface::descriptor()->FindFieldByName(name);
    EXPECT_EQ(wire.GetReflection()->HasField(wire, field), !std::isnan(values[q])) << name;
    if (std::isnan(values[q])) continue;
    EXPECT_NEAR(wire.GetReflection()->GetFloat(wire, field), values[q], 1e-5 * std::abs(values[q])) << name;
  }
}

TEST_F(QueryPulses, InterpolatesTheNamedTable) {
  const UncertaintyTable first = testing::SyntheticTable({.factor = 2}),
                         second = testing::SyntheticTable({.factor = 3});
  const std::pair<const char*, const UncertaintyTable&> tables[] = {{"", survey_},      {"survey", survey_},
                                                                    {"twice", second},  {"twice/2", second},
                                                                    {"twice/1", first}, {"published", published_}};
  for (const auto& [name, table] : tables) {
    SCOPED_TRACE(name);
    v1::QueryOptions options;
    options.set_table(name);
    const v1::PulseUncertainty plain = AskOne(WirePulse(), options);
    EXPECT_EQ(plain.outcome(), v1::OUTCOME_INTERPOLATED);
    EXPECT_EQ(plain.axis(), v1::AXIS_UNSPECIFIED);
    EXPECT_FALSE(plain.azimuth_absent() || plain.has_sea_surface_standard_error() || plain.has_s44());
    options.set_standard_errors(true);
    const PulseUncertainty reference = Interpolate(table, TablesPulse());
    for (const auto& [wire, coverage] :
         {std::pair(v1::COVERAGE_UNSPECIFIED, Coverage::kTwoSigma), std::pair(v1::COVERAGE_P95, Coverage::kP95)}) {
      options.set_coverage(wire);
      const v1::PulseUncertainty answer = AskOne(WirePulse(), options);
      ExpectNear(answer.sea_surface(), WithCoverage(reference, coverage).values);
      ExpectNear(answer.sea_surface_standard_error(), WithCoverage(reference, coverage).standard_errors);
    }
  }
}

TEST_F(QueryPulses, NamesTheTableAndTheCoverage) {
  v1::QueryPulsesRequest request = Request(WirePulse());
  const v1::QueryPulsesResponse response = Ask(request);
  EXPECT_EQ(response.table().name(), "survey");
  EXPECT_EQ(response.table().id(), survey_.provenance().id);
  EXPECT_EQ(response.table().version(), survey_.provenance().version);
  EXPECT_EQ(response.table().digest(), survey_.digest());
  EXPECT_EQ(response.coverage(), v1::COVERAGE_TWO_SIGMA);
  request.mutable_options()->set_coverage(v1::COVERAGE_P95);
  EXPECT_EQ(Ask(request).coverage(), v1::COVERAGE_P95);
}

TEST_F(QueryPulses, MayLackFetchAndAzimuth) {
  v1::Pulse pulse = WirePulse();
  Pulse reference = TablesPulse();
  pulse.clear_fetch();  // A fully developed sea.
  reference.fetch = kInfinity;
  ExpectNear(AskOne(pulse).sea_surface(), Interpolate(survey_, reference).values);
  pulse.clear_azimuth();  // The worse of 0 and 90 degrees.
  reference.azimuth.reset();
  const v1::PulseUncertainty answer = AskOne(pulse);
  EXPECT_TRUE(answer.azimuth_absent());
  ExpectNear(answer.sea_surface(), Interpolate(survey_, reference).values);
}

TEST_F(QueryPulses, ComparesWithS44At95PercentAtAnyCoverage) {
  const PulseUncertainty p95 = WithCoverage(Interpolate(survey_, TablesPulse()), Coverage::kP95);
  const float thu = p95[Quantity::kThu], tvu = p95[Quantity::kTvu];
  v1::QueryOptions options;
  options.set_best_s44_order(true);
  options.set_s44_order(v1::S44_ORDER_1B);
  for (v1::Coverage coverage : {v1::COVERAGE_TWO_SIGMA, v1::COVERAGE_P95}) {
    options.set_coverage(coverage);
    const v1::S44 s44 = AskOne(WirePulse(), options).s44();
    EXPECT_EQ(s44.best_order(), static_cast<int>(*BestOrder(thu, tvu, 3)) + 1);
    EXPECT_EQ(s44.remaining_thu(), static_cast<float>(*RemainingBudget(ThuLimit(S44Order::k1b, 3), thu)));
    EXPECT_EQ(s44.remaining_tvu(), static_cast<float>(*RemainingBudget(TvuLimit(S44Order::k1b, 3), tvu)));
  }
}

TEST_F(QueryPulses, AnswersOnlyTheRequestedPartOfS44) {
  v1::QueryOptions options;
  options.set_best_s44_order(true);
  EXPECT_FALSE(AskOne(WirePulse(), options).s44().has_remaining_thu());
  options.set_best_s44_order(false);
  options.set_s44_order(v1::S44_ORDER_EXCLUSIVE);
  EXPECT_EQ(AskOne(WirePulse(), options).s44().best_order(), v1::S44_ORDER_UNSPECIFIED);
}

TEST_F(QueryPulses, GivesAPulseWithoutNumbersItsOutcomeAndAxis) {
  using Change = void (*)(v1::Pulse&);
  const std::tuple<Change, v1::Outcome, v1::Axis> cases[] = {
      {[](v1::Pulse& p) { p.set_wind_speed(-1); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_WIND_SPEED},
      {[](v1::Pulse& p) { p.set_wind_speed(10.1f); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_WIND_SPEED},
      {[](v1::Pulse& p) { p.set_fetch(999); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_FETCH},
      {[](v1::Pulse& p) { p.set_incidence(-0.1f); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_INCIDENCE},
      {[](v1::Pulse& p) { p.set_footprint(0); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_FOOTPRINT},
      {[](v1::Pulse& p) { p.set_depth(-0.5f); }, v1::OUTCOME_OUT_OF_DOMAIN, v1::AXIS_DEPTH},
      {[](v1::Pulse& p) { p.set_incidence(kNaN); }, v1::OUTCOME_INVALID, v1::AXIS_INCIDENCE},
      {[](v1::Pulse& p) { p.set_incidence(kInfinity); }, v1::OUTCOME_INVALID, v1::AXIS_INCIDENCE},
      {[](v1::Pulse& p) { p.set_fetch(-kInfinity); }, v1::OUTCOME_INVALID, v1::AXIS_FETCH},
      {[](v1::Pulse& p) { p.clear_wind_speed(); }, v1::OUTCOME_INVALID, v1::AXIS_WIND_SPEED},
      {[](v1::Pulse& p) { p.clear_incidence(); }, v1::OUTCOME_INVALID, v1::AXIS_INCIDENCE},
      {[](v1::Pulse& p) { p.clear_footprint(); }, v1::OUTCOME_INVALID, v1::AXIS_FOOTPRINT},
      {[](v1::Pulse& p) { p.clear_depth(); }, v1::OUTCOME_INVALID, v1::AXIS_DEPTH}};
  for (const auto& [change, outcome, axis] : cases) {
    v1::QueryPulsesRequest request = Request(WirePulse());
    request.mutable_options()->set_standard_errors(true);
    request.mutable_options()->set_best_s44_order(true);
    *request.add_pulses() = WirePulse();
    change(*request.mutable_pulses(1));
    const v1::QueryPulsesResponse response = Ask(request);
    EXPECT_EQ(response.uncertainties(0).outcome(), v1::OUTCOME_INTERPOLATED);
    const v1::PulseUncertainty& answer = response.uncertainties(1);
    EXPECT_EQ(answer.outcome(), outcome);
    EXPECT_EQ(answer.axis(), axis);
    EXPECT_FALSE(answer.has_sea_surface() || answer.has_sea_surface_standard_error() || answer.has_s44());
  }
}

TEST_F(QueryPulses, AcceptsAsManyPulsesAsAnAnswerHolds) {
  v1::QueryPulsesRequest request;
  request.mutable_options()->set_best_s44_order(true);
  request.mutable_options()->set_s44_order(v1::S44_ORDER_1A);
  v1::Pulse pulse = WirePulse();
  pulse.clear_azimuth();
  for (std::size_t i = 0; i < kMaxPulses; ++i) *request.add_pulses() = pulse;
  const v1::QueryPulsesResponse without = Ask(request);
  EXPECT_EQ(without.uncertainties_size(), static_cast<int>(kMaxPulses));
  EXPECT_LT(without.ByteSizeLong(), kMaxMessageBytes);

  request.mutable_options()->set_standard_errors(true);
  EXPECT_THAT(StatusOf(request).error_message(), HasSubstr("32768"));
  request.mutable_pulses()->DeleteSubrange(0, static_cast<int>(kMaxPulses - kMaxPulsesWithStandardErrors));
  const v1::QueryPulsesResponse with = Ask(request);
  EXPECT_EQ(with.uncertainties_size(), static_cast<int>(kMaxPulsesWithStandardErrors));
  EXPECT_LT(with.ByteSizeLong(), kMaxMessageBytes);
}

}  // namespace
}  // namespace albtpu::server
