#include "generator/monte_carlo/monte_carlo.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "generator/campaign/unit.h"
#include "sea/response/closed_form.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;

SeaCase ModerateSea(std::vector<BeamOptions> beams) {
  SeaCase sea_case;
  sea_case.sea.waves = WindSea{.wind_speed_10m = 4};
  sea_case.beams = std::move(beams);
  sea_case.depths = {0, 5, 20};
  return sea_case;
}

Effort Exactly(int realizations) { return {.realizations = realizations, .most_realizations = realizations}; }

void ExpectWithinErrors(const Estimate& a, const Estimate& b) {
  EXPECT_NEAR(a.value, b.value, 3.5 * std::hypot(a.standard_error, b.standard_error));
}

TEST(MonteCarlo, HasNoErrorsOverACalm) {
  SeaCase sea_case = ModerateSea({{.footprint = 0.25}, {.incidence = 0.3, .azimuth = 0.5, .footprint = 2}});
  sea_case.sea.waves = WindSea{.wind_speed_10m = 0};
  for (const Estimator estimator : {Estimator::kControlVariate, Estimator::kPlain}) {
    const SeaCaseResult result =
        Simulate(sea_case,
                 {.realizations = 10, .most_realizations = 1000, .relative_error = 0.01, .estimator = estimator}, 5, 6);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.realizations, 0);
    ASSERT_EQ(result.beams.size(), 2);
    for (const BeamUncertainty& beam : result.beams) {
      ASSERT_EQ(beam.thu.size(), sea_case.depths.size());
      std::vector<Estimate> all = {beam.refraction_along_wind, beam.refraction_cross_wind};
      for (const auto* values : {&beam.thu, &beam.tvu, &beam.bias_along_beam, &beam.bias_vertical})
        all.insert(all.end(), values->begin(), values->end());
      for (const Estimate& estimate : all) EXPECT_TRUE(estimate.value == 0 && estimate.standard_error == 0);
    }
  }
}

TEST(MonteCarlo, DoesNotDependOnTheNumberOfThreads) {
  const SeaCase sea_case = ModerateSea({{.footprint = 0.25}, {.incidence = 0.3, .azimuth = 0.5, .footprint = 0.25}});
  const auto run = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] { return EncodeResult(Simulate(sea_case, Exactly(101), 5, 6)); });
  };
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 3);
  const std::string one = run(1);
  for (const int threads : {2, 3}) EXPECT_EQ(run(threads), one);
}

TEST(MonteCarlo, DependsOnSeedAndCell) {
  const SeaCase sea_case = ModerateSea({{.footprint = 0.25}});
  const auto refraction = [&](std::uint64_t seed, std::uint32_t cell) {
    return Simulate(sea_case, Exactly(20), seed, cell).beams[0].refraction_along_wind.value;
  };
  EXPECT_EQ(refraction(1, 1), refraction(1, 1));
  EXPECT_NE(refraction(1, 1), refraction(2, 1));
  EXPECT_NE(refraction(1, 1), refraction(1, 2));
}

// The mean path exceeds the depth by half of g^2 times the mean square slope (mss), whatever the wavelength: the waves
// on the grid and the unresolved ones add up. The next order is about mss times that.
TEST(MonteCarlo, FindsTheSecondOrderBiasOfTheBottomAtNadir) {
  const SeaCase sea_case = ModerateSea({{.footprint = 0.25}});
  const SeaCaseResult result = Simulate(sea_case, Exactly(2000), 1, 0);
  const double g = 1 - 1 / kRefractiveIndex;
  const double mss = SlopeCovariance(SeaState(4, std::numeric_limits<double>::infinity())).trace();
  const Estimate bias = result.beams[0].bias_vertical[2];
  const double expected = -0.5 * g * g * mss * sea_case.depths[2];
  EXPECT_NEAR(bias.value, expected, 3 * bias.standard_error - mss * expected);
}

TEST(MonteCarlo, AgreesBetweenTheQuadrantsOfTheAzimuth) {
  const auto at = [](double azimuth, std::uint32_t cell) {
    return Simulate(ModerateSea({{.incidence = 0.35, .azimuth = azimuth * kDegree, .footprint = 0.25}}), Exactly(1500),
                    1, cell)
        .beams[0];
  };
  const BeamUncertainty first = at(30, 0);
  for (const double azimuth : {-30.0, 150.0, 210.0}) {
    const BeamUncertainty other = at(azimuth, 1 + static_cast<std::uint32_t>(azimuth + 30));
    ExpectWithinErrors(first.refraction_along_wind, other.refraction_along_wind);
    ExpectWithinErrors(first.refraction_cross_wind, other.refraction_cross_wind);
    ExpectWithinErrors(first.thu[2], other.thu[2]);
    ExpectWithinErrors(first.tvu[2], other.tvu[2]);
    ExpectWithinErrors(first.bias_along_beam[2], other.bias_along_beam[2]);
    ExpectWithinErrors(first.bias_vertical[2], other.bias_vertical[2]);
  }
}

// At great depth, THU is the refraction times the depth: both come from the same tangents.
TEST(MonteCarlo, HasAHorizontalUncertaintyOfRefractionTimesDepth) {
  SeaCase sea_case = ModerateSea({{.footprint = 0.25}});
  sea_case.depths = {100};
  const BeamUncertainty beam = Simulate(sea_case, Exactly(500), 1, 0).beams[0];
  const double both = std::hypot(beam.refraction_along_wind.value, beam.refraction_cross_wind.value);
  EXPECT_NEAR(beam.thu[0].value / 100 / both, 1,
              0.003);  // tangent against angle, and heights in the footprint
}

TEST(MonteCarlo, ContinuesUntilTheStandardErrorIsSmallEnough) {
  const SeaCase sea_case = ModerateSea({{.incidence = 0.35, .footprint = 0.25}});
  const SeaCaseResult result = Simulate(
      sea_case,
      {.realizations = 50, .most_realizations = 20000, .relative_error = 0.03, .estimator = Estimator::kPlain}, 1, 0);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ((result.realizations - 50) % kBatch, 0);
  EXPECT_GT(result.realizations, 300);  // 1 / sqrt(2 n) is 0.03 at n = 556
  EXPECT_LT(result.realizations, 5000);
  EXPECT_LE(result.beams[0].tvu[1].standard_error, 0.03 * result.beams[0].tvu[1].value);
  EXPECT_LE(result.beams[0].thu[1].standard_error, 0.03 * result.beams[0].thu[1].value);
}

TEST(MonteCarlo, ReportsAStandardErrorThatIsNotSmallEnough) {
  const SeaCase sea_case = ModerateSea({{.incidence = 0.35, .footprint = 0.25}});
  const SeaCaseResult result =
      Simulate(sea_case, {.realizations = 50, .most_realizations = 320, .relative_error = 1e-5}, 1, 0);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.realizations, 320);
}

TEST(MonteCarlo, TracesThePointSourceOfTheLaboratory) {
  SeaCase laboratory = ModerateSea({{.footprint = 0.25, .source_height = 4}});
  laboratory.sea.waves = WindSea{.wind_speed_10m = 4, .fetch = 1e4};
  SeaCase survey = ModerateSea({{.footprint = 0.25}});
  survey.sea.waves = laboratory.sea.waves;
  const BeamUncertainty diverging = Simulate(laboratory, Exactly(1500), 1, 0).beams[0];
  const BeamUncertainty collimated = Simulate(survey, Exactly(1500), 1, 1).beams[0];
  // The mean direction has the same response to the mean slope; the divergence of 0.03 rad is a second-order effect.
  ExpectWithinErrors(diverging.refraction_along_wind, collimated.refraction_along_wind);
}

// Slopes of 3 standard deviations turn away from the beam at an incidence of atan(1 / (3 deviations)).
TEST(CheckTraceable, RefusesBeamsAtWhichWavesHideEachOther) {
  SeaCase sea_case = ModerateSea({{}});
  sea_case.sea.waves = WindSea{.wind_speed_10m = 15};
  const Eigen::Matrix2d slopes = SlopeCovariance(SeaState(sea_case.sea));
  for (const int axis : {0, 1}) {
    const double steepest = std::atan(1 / (3 * std::sqrt(slopes(axis, axis))));
    sea_case.beams = {{.incidence = 0.999 * steepest, .azimuth = axis * 90 * kDegree, .footprint = 1}};
    EXPECT_TRUE(CheckTraceable(sea_case).ok());
    sea_case.beams.push_back({.incidence = 1.001 * steepest, .azimuth = axis * 90 * kDegree, .footprint = 1});
    EXPECT_TRUE(absl::IsInvalidArgument(CheckTraceable(sea_case)));
  }
  sea_case.sea.waves = WindSea{.wind_speed_10m = 0};
  EXPECT_TRUE(CheckTraceable(sea_case).ok());
}

TEST(CheckTraceable, RefusesPointSourcesBelowCrests) {
  SeaCase sea_case = ModerateSea({{.footprint = 1}});
  const double crests = 6 * std::sqrt(ElevationVariance(SeaState(sea_case.sea)));
  sea_case.beams[0].source_height = 1.001 * crests;
  EXPECT_TRUE(CheckTraceable(sea_case).ok());
  sea_case.beams[0].source_height = 0.999 * crests;
  const std::string message(CheckTraceable(sea_case).message());
  for (const double named : {0.999 * crests, crests / 6, crests})
    EXPECT_NE(message.find(absl::StrFormat("%.3g", named)), std::string::npos) << message;
}

TEST(MonteCarlo, RecordsTheDiscretization) {
  SeaCase sea_case = ModerateSea({{.footprint = 0.25}});
  sea_case.discretization = Discretization{.patch_per_beam = 3, .points_per_footprint = 20, .rays = 123};
  const SeaCaseResult result = Simulate(sea_case, Exactly(2), 1, 0);
  EXPECT_EQ(result.rays, 123);
  EXPECT_DOUBLE_EQ(result.patch_length, 0.75);
  EXPECT_DOUBLE_EQ(result.spacing, 0.0125);
  EXPECT_GT(result.footprint_slope_fraction, 0.9);
  EXPECT_GT(result.resolved_slope_fraction, 0);
  EXPECT_LT(result.resolved_slope_fraction, 1);
}

}  // namespace
}  // namespace albtpu
