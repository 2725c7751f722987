#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "service/server/ground/limits.h"
#include "tables/coverage.h"
#include "tables/s44.h"
#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class QueryPulses : public ServedTables {
 protected:
  v1::QueryPulsesResponse Ask(const v1::QueryPulsesRequest& request) {
    v1::QueryPulsesResponse response;
    const grpc::Status status = ServedTables::QueryPulses(request, response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  v1::PulseUncertainty AskOne(const v1::Pulse& pulse, const v1::QueryOptions& options = {}) {
    v1::QueryPulsesRequest request;
    *request.mutable_options() = options;
    *request.add_pulses() = pulse;
    const v1::QueryPulsesResponse response = Ask(request);
    EXPECT_EQ(response.uncertainties_size(), 1);
    return response.uncertainties(0);
  }

  grpc::Status Fail(const v1::QueryPulsesRequest& request) {
    v1::QueryPulsesResponse response;
    return ServedTables::QueryPulses(request, response);
  }

  v1::QueryPulsesRequest OnePulse() {
    v1::QueryPulsesRequest request;
    *request.add_pulses() = WirePulse();
    return request;
  }
};

// The server computes in single precision, within 1e-5 of the reference implementation (column_query.h).
void ExpectNear(const v1::SeaSurface& wire, const std::array<float, kQuantityCount>& values) {
  const float answered[] = {wire.refraction_along_wind(), wire.refraction_cross_wind(), wire.thu(), wire.tvu(),
                            wire.bias_along_beam(),       wire.bias_vertical()};
  for (std::size_t q = 0; q < kQuantityCount; ++q)
    EXPECT_NEAR(answered[q], values[q], 1e-5 * std::abs(values[q])) << Describe(kQuantities[q]).name;
}

TEST_F(QueryPulses, InterpolatesTheTable) {
  const v1::PulseUncertainty answer = AskOne(WirePulse());
  EXPECT_EQ(answer.outcome(), v1::OUTCOME_INTERPOLATED);
  EXPECT_EQ(answer.axis(), v1::AXIS_UNSPECIFIED);
  EXPECT_FALSE(answer.azimuth_absent());
  ExpectNear(answer.sea_surface(), Interpolate(survey_, TablesPulse()).values);
  EXPECT_FALSE(answer.has_sea_surface_standard_error());
  EXPECT_FALSE(answer.has_s44());
}

TEST_F(QueryPulses, NamesTheTableAndTheCoverage) {
  const v1::QueryPulsesResponse response = Ask(OnePulse());
  EXPECT_EQ(response.table().name(), "survey");
  EXPECT_EQ(response.table().id(), survey_.provenance().id);
  EXPECT_EQ(response.table().version(), survey_.provenance().version);
  EXPECT_EQ(response.table().digest(), survey_.digest());
  EXPECT_EQ(response.coverage(), v1::COVERAGE_TWO_SIGMA);
}

TEST_F(QueryPulses, UsesTheNamedTable) {
  v1::QueryOptions options;
  const std::pair<const char*, float> factors[] = {
      {"survey", 1.0f}, {"twice", 3.0f}, {"twice/2", 3.0f}, {"twice/1", 2.0f}};
  const float thu = Interpolate(survey_, TablesPulse())[Quantity::kThu];
  for (const auto& [name, factor] : factors) {
    options.set_table(name);
    // Each node and the answer are rounded to single precision.
    EXPECT_NEAR(AskOne(WirePulse(), options).sea_surface().thu(), factor * thu, 3e-7 * factor * thu) << name;
  }
}

TEST_F(QueryPulses, OmitsQuantitiesThatTheTableDoesNotHold) {
  v1::QueryOptions options;
  options.set_table("published");
  options.set_standard_errors(true);
  const v1::PulseUncertainty answer = AskOne(WirePulse(), options);
  EXPECT_TRUE(answer.sea_surface().has_thu());
  EXPECT_FALSE(answer.sea_surface().has_bias_along_beam());
  EXPECT_FALSE(answer.sea_surface().has_bias_vertical());
  EXPECT_FALSE(answer.sea_surface_standard_error().has_thu());
}

TEST_F(QueryPulses, ConvertsTo95PercentOnRequest) {
  v1::QueryPulsesRequest request = OnePulse();
  request.mutable_options()->set_coverage(v1::COVERAGE_P95);
  request.mutable_options()->set_standard_errors(true);
  const v1::QueryPulsesResponse response = Ask(request);
  const PulseUncertainty p95 = WithCoverage(Interpolate(survey_, TablesPulse()), Coverage::kP95);
  EXPECT_EQ(response.coverage(), v1::COVERAGE_P95);
  ExpectNear(response.uncertainties(0).sea_surface(), p95.values);
  ExpectNear(response.uncertainties(0).sea_surface_standard_error(), p95.standard_errors);
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

TEST_F(QueryPulses, TreatsAnAbsentFetchAsAFullyDevelopedSea) {
  v1::Pulse pulse = WirePulse();
  pulse.set_fetch(kInfinity);
  const v1::PulseUncertainty infinite = AskOne(pulse);
  pulse.clear_fetch();
  EXPECT_EQ(AskOne(pulse).SerializeAsString(), infinite.SerializeAsString());
  EXPECT_EQ(infinite.outcome(), v1::OUTCOME_INTERPOLATED);
}

TEST_F(QueryPulses, UsesTheWorseOf0And90DegreesWithoutAzimuthAndReportsIt) {
  v1::Pulse pulse = WirePulse();
  pulse.clear_azimuth();
  const v1::PulseUncertainty answer = AskOne(pulse);
  Pulse absent = TablesPulse();
  absent.azimuth.reset();
  EXPECT_TRUE(answer.azimuth_absent());
  ExpectNear(answer.sea_surface(), Interpolate(survey_, absent).values);
}

TEST_F(QueryPulses, NamesTheAxisThatIsOutOfDomainAndGivesNoNumbers) {
  using Setter = void (v1::Pulse::*)(float);
  struct Case {
    Setter set;
    float value;
    v1::Axis axis;
  };
  for (const Case& c :
       {Case{&v1::Pulse::set_wind_speed, -1, v1::AXIS_WIND_SPEED},
        Case{&v1::Pulse::set_wind_speed, 10.1f, v1::AXIS_WIND_SPEED}, Case{&v1::Pulse::set_fetch, 999, v1::AXIS_FETCH},
        Case{&v1::Pulse::set_incidence, -0.1f, v1::AXIS_INCIDENCE},
        Case{&v1::Pulse::set_footprint, 0, v1::AXIS_FOOTPRINT}, Case{&v1::Pulse::set_depth, -0.5f, v1::AXIS_DEPTH}}) {
    v1::Pulse pulse = WirePulse();
    (pulse.*c.set)(c.value);
    v1::QueryOptions options;
    options.set_standard_errors(true);
    options.set_best_s44_order(true);
    const v1::PulseUncertainty answer = AskOne(pulse, options);
    EXPECT_EQ(answer.outcome(), v1::OUTCOME_OUT_OF_DOMAIN);
    EXPECT_EQ(answer.axis(), c.axis);
    EXPECT_FALSE(answer.has_sea_surface());
    EXPECT_FALSE(answer.has_sea_surface_standard_error());
    EXPECT_FALSE(answer.has_s44());
  }
}

TEST_F(QueryPulses, MarksPulsesThatAreNotFiniteInvalid) {
  for (float value : {kNaN, kInfinity, -kInfinity}) {
    v1::Pulse pulse = WirePulse();
    pulse.set_incidence(value);
    const v1::PulseUncertainty answer = AskOne(pulse);
    EXPECT_EQ(answer.outcome(), v1::OUTCOME_INVALID) << value;
    EXPECT_EQ(answer.axis(), v1::AXIS_INCIDENCE) << value;
  }
  v1::Pulse pulse = WirePulse();
  pulse.set_fetch(-kInfinity);
  EXPECT_EQ(AskOne(pulse).outcome(), v1::OUTCOME_INVALID);
}

TEST_F(QueryPulses, MarksOnlyThePulseWithAMissingCoordinateInvalid) {
  using Clearer = void (v1::Pulse::*)();
  const std::pair<Clearer, v1::Axis> cases[] = {{&v1::Pulse::clear_wind_speed, v1::AXIS_WIND_SPEED},
                                                {&v1::Pulse::clear_incidence, v1::AXIS_INCIDENCE},
                                                {&v1::Pulse::clear_footprint, v1::AXIS_FOOTPRINT},
                                                {&v1::Pulse::clear_depth, v1::AXIS_DEPTH}};
  for (const auto& [clear, axis] : cases) {
    v1::QueryPulsesRequest request = OnePulse();
    v1::Pulse* pulse = request.add_pulses();
    *pulse = WirePulse();
    (pulse->*clear)();
    const v1::QueryPulsesResponse response = Ask(request);
    EXPECT_EQ(response.uncertainties(0).outcome(), v1::OUTCOME_INTERPOLATED);
    EXPECT_EQ(response.uncertainties(1).outcome(), v1::OUTCOME_INVALID);
    EXPECT_EQ(response.uncertainties(1).axis(), axis);
  }
}

TEST_F(QueryPulses, RejectsInvalidEnumNumbers) {
  v1::QueryPulsesRequest coverage = OnePulse();
  coverage.mutable_options()->set_coverage(static_cast<v1::Coverage>(7));
  EXPECT_EQ(Fail(coverage).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(Fail(coverage).error_message(), HasSubstr("options.coverage is 7"));
  v1::QueryPulsesRequest order = OnePulse();
  order.mutable_options()->set_s44_order(static_cast<v1::S44Order>(-1));
  EXPECT_EQ(Fail(order).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(Fail(order).error_message(), HasSubstr("options.s44_order is -1"));
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
  EXPECT_THAT(Fail(request).error_message(), HasSubstr("32768"));
  request.mutable_pulses()->DeleteSubrange(0, static_cast<int>(kMaxPulses - kMaxPulsesWithStandardErrors));
  const v1::QueryPulsesResponse with = Ask(request);
  EXPECT_EQ(with.uncertainties_size(), static_cast<int>(kMaxPulsesWithStandardErrors));
  EXPECT_LT(with.ByteSizeLong(), kMaxMessageBytes);
}

}  // namespace
}  // namespace albtpu::server
