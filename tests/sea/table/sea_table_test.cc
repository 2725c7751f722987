#include "sea/table/sea_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "sea/response/sea_response.h"
#include "sea/spectra/binned_spectrum.h"
#include "sea/spectra/sea_error.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/table/sea_attributes.h"
#include "tables/coverage.h"
#include "tables/query/interpolation.h"
#include "tests/sea/table/table_seas.h"

namespace albtpu {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::infinity();

// One for all tests: making it takes longer than compiling a sea.
const SeaCompiler& Compiler() {
  static const SeaCompiler compiler;
  return compiler;
}

UncertaintyTable Compiled(const SeaDescription& sea, double record_length = kNotMeasured) {
  return Compiler().Compile(sea, record_length).value();
}

BeamOptions BeamOf(const Pulse& pulse) {
  return {.incidence = RadiansOfDegrees(pulse.incidence),
          .azimuth = RadiansOfDegrees(*pulse.azimuth),
          .footprint = pulse.footprint};
}

// The first four quantities, of which none is a bias.
std::array<double, 4> TwoSigma(const BeamResponse& beam, double depth) {
  return {DegreesOfRadians(beam.refraction_along_wind()), DegreesOfRadians(beam.refraction_cross_wind()),
          beam.Thu(depth), beam.Tvu(depth)};
}

// Uniform in the domain, a third of them near nadir.
class RandomPulses {
 public:
  Pulse operator()() {
    return {.incidence = Between(0, ++count_ % 3 == 0 ? 5 : 30),
            .azimuth = Between(-360, 360),
            .footprint = std::exp(Between(std::log(0.1f), std::log(6.0f))),
            .depth = Between(1, 60)};
  }

 private:
  float Between(float first, float last) { return std::uniform_real_distribution<float>(first, last)(random_); }

  int count_ = 0;
  std::mt19937 random_{1};
};

// TVU is |sin| of the angle between beam and crests, rounded over the spread of the waves: linear interpolation over
// the step h errs by h^2 / (8 spread) of its greatest value over the azimuths.
double ToleranceOfTvu(const std::string& sea, const UncertaintyTable& table, Pulse pulse) {
  pulse.azimuth.reset();
  const double step = RadiansOfDegrees(10), spread = RadiansOfDegrees(10);
  const double largest = Interpolate(table, pulse)[Quantity::kTvu];
  return largest * (sea == "narrow swell in a calm" ? step * step / (8 * spread) : 0.01);
}

TEST(SeaTable, InterpolatesBetweenItsNodesWithinOnePercent) {
  for (const auto& [name, sea] : TableSeas()) {
    SCOPED_TRACE(name);
    const UncertaintyTable table = Compiled(sea);
    const SeaResponse response(Describe(sea).spectrum, kSeaWaterIndex);
    RandomPulses pulses;
    std::array<double, 3> squares{};
    constexpr int kPulses = 60;
    for (int i = 0; i < kPulses; ++i) {
      const Pulse pulse = pulses();
      SCOPED_TRACE(testing::Message() << pulse.incidence << " " << *pulse.azimuth << " " << pulse.footprint);
      const PulseUncertainty ours = Interpolate(table, pulse);
      ASSERT_EQ(ours.outcome, Outcome::kInterpolated);
      const std::array<double, 4> exact = TwoSigma(response(BeamOf(pulse)), pulse.depth);
      for (std::size_t q = 0; q < 3; ++q) {
        EXPECT_NEAR(ours.values[q], exact[q], 0.01 * exact[q]) << q;
        squares[q] += std::pow(ours.values[q] / exact[q] - 1, 2) / kPulses;
      }
      EXPECT_NEAR(ours[Quantity::kTvu], exact[3], ToleranceOfTvu(name, table, pulse));
    }
    for (const double square : squares) EXPECT_LT(std::sqrt(square), 0.003);
  }
}

// At nodes there is the error of beam_directions alone.
TEST(SeaTable, IsTheResponseAtItsNodes) {
  const SeaDescription sea = TableSeas()[4].sea;
  const UncertaintyTable table = Compiled(sea);
  const SeaResponse response(Describe(sea).spectrum, kSeaWaterIndex);
  for (const float incidence : {0.0f, 2.5f, 19.0f, 30.0f}) {
    for (const float azimuth : {0.0f, 50.0f, 130.0f, 180.0f}) {
      const Pulse pulse{.incidence = incidence, .azimuth = azimuth, .footprint = 0.7f, .depth = 60};
      const PulseUncertainty ours = Interpolate(table, pulse);
      const BeamResponse beam = response(BeamOf(pulse));
      const std::array<double, 4> exact = TwoSigma(beam, 60);
      for (std::size_t q = 0; q < 4; ++q) EXPECT_NEAR(ours.values[q], exact[q], 5e-4 * exact[q]) << q;
      EXPECT_NEAR(ours[Quantity::kBiasAlongBeam], beam.BiasAlongBeam(60), 1e-5);
      EXPECT_NEAR(ours[Quantity::kBiasVertical], beam.BiasVertical(60), 1e-5);
    }
  }
}

TEST(SeaTable, IsTheSameFromEveryCompilerAndThread) {
  const SeaDescription sea = TableSeas()[4].sea;
  const std::string digest = Compiled(sea).digest();
  EXPECT_EQ(SeaCompiler().Compile(sea, kNotMeasured)->digest(), digest);
  std::array<std::string, 2> digests;
  std::array<std::thread, 2> threads;
  for (std::size_t i = 0; i < 2; ++i) threads[i] = std::thread([&, i] { digests[i] = Compiled(sea).digest(); });
  for (std::thread& thread : threads) thread.join();
  for (const std::string& other : digests) EXPECT_EQ(other, digest);
  EXPECT_NE(Compiled(TableSeas()[5].sea).digest(), digest);
}

TEST(SeaTable, OfACalmWithoutWavesIsZero) {
  const UncertaintyTable table = Compiled(SeaOf(0));
  for (const Quantity quantity : kQuantities) {
    for (const float value : table.variable(quantity)->values) ASSERT_EQ(value, 0) << Describe(quantity).name;
    for (const float error : table.variable(quantity)->standard_errors) ASSERT_EQ(error, 0);
  }
  const Pulse pulse{.incidence = 12, .footprint = 0.6f, .depth = 8};
  const PulseUncertainty none = WithCoverage(Interpolate(table, pulse), Coverage::kP95);
  EXPECT_EQ(none.outcome, Outcome::kInterpolated);
  EXPECT_EQ(none[Quantity::kThu], 0);
  EXPECT_EQ(std::get<double>(table.provenance().attributes.at("share_measured")), 0);
}

// The values of every node, to compare tables whose frames differ.
void ExpectSameValues(const UncertaintyTable& a, const UncertaintyTable& b) {
  for (const Quantity quantity : kQuantities) {
    const std::vector<float>&ours = a.variable(quantity)->values, &theirs = b.variable(quantity)->values;
    for (std::size_t i = 0; i < ours.size(); ++i)
      ASSERT_NEAR(ours[i], theirs[i], 1e-4 * std::abs(theirs[i]) + 1e-6) << Describe(quantity).name << " " << i;
  }
}

TEST(SeaTable, TurnsWithTheSea) {
  for (const double turn : {37.0, 180.0, -200.0}) {
    const auto turned = [&](double turn_by) {
      SeaDescription sea = SeaOf(5, {Waves(0.5, 3.2, turn_by), Waves(1.2, 9, 60 + turn_by, 15, 7)});
      sea.wind_from = RadiansOfDegrees(180 + turn_by);
      return Compiled(sea);
    };
    ExpectSameValues(turned(turn), turned(0));
  }
}

// Frozen waves look alike in both directions.
TEST(SeaTable, DoesNotTellWavesFromThoseOfTheOppositeWay) {
  ExpectSameValues(Compiled(SeaOf(5, {Waves(0.5, 3.2, 0), Waves(1.2, 9, 60 + 180, 15, 7)})),
                   Compiled(SeaOf(5, {Waves(0.5, 3.2, 180), Waves(1.2, 9, 60, 15, 7)})));
}

TEST(SeaTable, OfTheMirroredSeaIsMirrored) {
  const UncertaintyTable sea = Compiled(SeaOf(5, {Waves(1.2, 9, 60, 15, 7)})),
                         mirrored = Compiled(SeaOf(5, {Waves(1.2, 9, -60, 15, 7)}));
  RandomPulses pulses;
  bool has_mirror = true;
  for (int i = 0; i < 50; ++i) {
    Pulse pulse = pulses();
    const PulseUncertainty ours = Interpolate(sea, pulse);
    has_mirror = has_mirror && Interpolate(mirrored, pulse).values == ours.values;
    pulse.azimuth = -*pulse.azimuth;
    const PulseUncertainty theirs = Interpolate(mirrored, pulse);
    for (const Quantity quantity : kQuantities)
      ASSERT_NEAR(ours[quantity], theirs[quantity], 1e-4 * std::abs(ours[quantity]) + 1e-6);
  }
  EXPECT_FALSE(has_mirror);
}

TEST(SeaTable, IsCrosswiseToSwellWhereTheSwellComesFromTheSide) {
  // Swell travels towards 60 degrees of the compass, x towards 0: a beam along the swell's axis has the greatest TVU.
  const UncertaintyTable table = Compiled(SeaOf(0.5, {Waves(1.2, 6, 0, 10), Waves(2, 8, 60, 10)}));
  EXPECT_NEAR(std::get<double>(table.provenance().attributes.at("x_azimuth")), 0, 1e-9);
  Pulse pulse{.incidence = 20, .footprint = 0.5f, .depth = 10};
  const auto tvu_towards = [&](double compass_azimuth) {
    pulse.azimuth = static_cast<float>(BeamAzimuth(compass_azimuth, 0));
    return Interpolate(table, pulse)[Quantity::kTvu];
  };
  EXPECT_GT(tvu_towards(40), 1.5 * tvu_towards(-40));
  EXPECT_GT(tvu_towards(220), 1.5 * tvu_towards(140));
}

TEST(SeaTable, WithoutAzimuthTakesTheWorstOfAllAzimuths) {
  const UncertaintyTable table = Compiled(SeaOf(3, {Waves(1.5, 5.5, 120, 20, 5)}));
  Pulse pulse{.incidence = 16, .footprint = 0.5f, .depth = 10};
  const PulseUncertainty worst = Interpolate(table, pulse);
  EXPECT_TRUE(worst.azimuth_absent);
  PulseUncertainty largest;
  largest.values.fill(0);
  for (int azimuth = 0; azimuth < 180; azimuth += 10) {
    pulse.azimuth = static_cast<float>(azimuth);
    const PulseUncertainty at = Interpolate(table, pulse);
    for (std::size_t q = 0; q < kQuantityCount; ++q)
      if (std::abs(at.values[q]) > std::abs(largest.values[q])) largest.values[q] = at.values[q];
  }
  EXPECT_EQ(worst.values, largest.values);
}

// A sea as a buoy measures it, over half an hour.
SeaDescription MeasuredSea() {
  auto centres = std::make_shared<std::vector<double>>();
  std::vector<DirectionalEnergy> bins;
  const JonswapSpectrum waves({Waves(1, 5, 20)});
  for (double f = 0.05; f < 0.485; f += 0.01) {
    centres->push_back(f);
    bins.push_back(waves(f));
  }
  SeaDescription sea = SeaOf(6);
  sea.waves = std::make_shared<BinnedSpectrum>(centres, bins, 1, 0.4);
  return sea;
}

TEST(SeaTable, HasTheErrorsOfTheSeaAsStandardErrors) {
  const SeaDescription sea = MeasuredSea();
  const UncertaintyTable table = Compiled(sea, 1800);
  const BeamOptions footprint{.footprint = 0.7};
  const double of_slopes = ErrorOfSea(sea, 1800, [&](double k) { return FootprintPower(footprint, k, 0); }).total;
  const double of_mean_square = ErrorOfSea(sea, 1800, [](double) { return 1; }).total;
  EXPECT_GT(of_slopes, 0.01);
  for (const float incidence : {0.0f, 19.0f}) {
    const Pulse pulse{.incidence = incidence, .azimuth = 40, .footprint = 0.7f, .depth = 60};
    const PulseUncertainty at = Interpolate(table, pulse);
    const auto relative = [&](Quantity quantity) {
      return at.standard_errors[Index(quantity)] / std::abs(at[quantity]);
    };
    const double rounding = 1e-5, second_order = 0.01;  // the share in TVU at 19 degrees
    EXPECT_NEAR(relative(Quantity::kRefractionAlongWind), of_slopes / 2, rounding);
    EXPECT_NEAR(relative(Quantity::kRefractionCrossWind), of_slopes / 2, rounding);
    EXPECT_NEAR(relative(Quantity::kThu), of_slopes / 2,
                1e-4 * of_slopes);  // but for the errors at the surface
    EXPECT_NEAR(relative(Quantity::kTvu), of_slopes / (incidence == 0 ? 1 : 2), second_order * of_slopes);
    EXPECT_NEAR(relative(Quantity::kBiasVertical), of_mean_square, rounding);
  }
  EXPECT_TRUE(Compiler().Compile(Describe(sea))->variable(Quantity::kThu)->standard_errors.empty());
}

TEST(SeaTable, SaysOfWhichSeaItIs) {
  SeaDescription sea = MeasuredSea();
  sea.wind_speed_10m.reset();
  sea.water_depth = 12;
  const UncertaintyTable table = Compiled(sea, 1800);
  EXPECT_TRUE(table.is_of_one_sea());
  EXPECT_FALSE(table.is_published());
  const auto& attributes = table.provenance().attributes;
  const auto number = [&](std::string_view name) { return std::get<double>(attributes.at(std::string(name))); };
  const auto text = [&](std::string_view name) { return std::get<std::string>(attributes.at(std::string(name))); };
  const DescribedSea described = Describe(sea);
  EXPECT_EQ(number(sea_attribute::kXAzimuth), DegreesOfRadians(described.x_azimuth));
  EXPECT_NEAR(number(sea_attribute::kSignificantWaveHeight), 1, 0.05);
  EXPECT_EQ(number(sea_attribute::kWindSpeed), described.wind_speed_10m);
  EXPECT_EQ(text(sea_attribute::kWindSource), "waves");
  EXPECT_EQ(number(sea_attribute::kWaterDepth), 12);
  EXPECT_EQ(text(sea_attribute::kTail), "relax");
  EXPECT_EQ(number(sea_attribute::kTailFrom), 0.4);
  EXPECT_GT(number(sea_attribute::kShareMeasured), 0.2);
  EXPECT_LT(number(sea_attribute::kShareMeasured), 0.9);
  EXPECT_NE(text(sea_attribute::kAssumptions).find("the wind speed is derived"), std::string::npos);
  EXPECT_EQ(Compiled(SeaOf(6)).provenance().attributes.count(std::string(sea_attribute::kTail)), 0);
}

TEST(SeaTable, TakesOtherNodesProfilesAndIndices) {
  SeaTableOptions options{.refractive_index = 1.34, .profile = BeamProfile::kGaussian, .nodes = {}};
  options.nodes = {.incidences = {0, 10, 20}, .azimuths = {0, 90, 180}, .footprints = {0.5, 1}, .depths = {0, 10}};
  const SeaDescription sea = SeaOf(8);
  const UncertaintyTable table = SeaCompiler(options).Compile(sea, kNotMeasured).value();
  const Pulse pulse{.incidence = 20, .azimuth = 90, .footprint = 1, .depth = 10};
  BeamOptions beam = BeamOf(pulse);
  beam.profile = BeamProfile::kGaussian;
  const BeamResponse exact = SeaResponse(Describe(sea).spectrum, 1.34)(beam);
  EXPECT_NEAR(Interpolate(table, pulse)[Quantity::kThu], exact.Thu(10), 5e-4 * exact.Thu(10));
  EXPECT_NE(table.provenance().campaign.find("gaussian"), std::string::npos);
}

// All slopes are along x: the variance across is 0 but for rounding, which may make it negative.
TEST(SeaTable, OfLongCrestedWavesHasNoRefractionAcross) {
  const HarmonicSpectrum waves{{0.01, 0.02}, {1, 1}, {{1, 1}}, {{0, 0}}};
  DescribedSea sea;
  sea.spectrum = sea.resolved = Resampled(waves, SeaWavenumbers());
  const absl::StatusOr<UncertaintyTable> table = Compiler().Compile(sea);
  const std::vector<float>& along = table->variable(Quantity::kRefractionAlongWind)->values;
  const std::vector<float>& across = table->variable(Quantity::kRefractionCrossWind)->values;
  // Rounding of the variance in double precision leaves its root.
  EXPECT_LT(across.front(), 1e-7 * along.front());
}

TEST(SeaTable, RefusesASeaThatIsNone) {
  DescribedSea sea = Describe(SeaOf(8));
  sea.spectrum.s[100] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Compiler().Compile(sea).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(SeaTable, RefusesASeaSteeperThanAny) {
  const DescribedSea sea = Describe(SeaOf(8));
  const auto with_slope = [&](double mean_square_slope) {
    DescribedSea steep = sea;
    for (double& each : steep.spectrum.s) each *= mean_square_slope / MeanSquareSlope(sea.spectrum);
    return Compiler().Compile(steep).status();
  };
  EXPECT_TRUE(with_slope(0.499).ok());
  const absl::Status status = with_slope(0.501);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("no sea has more than 0.5"), absl::string_view::npos) << status;
}

TEST(SeaTable, RefusesWavesSoHighThatTheirWindIsInfinite) {
  SeaDescription sea = SeaOf(8, {Waves(1e300, 5, 0)});
  sea.wind_speed_10m.reset();
  const absl::Status status = Compiler().Compile(sea, kNotMeasured).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(status.message().find("check its heights, periods and units"), absl::string_view::npos) << status;
}

}  // namespace
}  // namespace albtpu
