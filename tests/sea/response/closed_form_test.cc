#include "sea/response/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "sea/spectra/wind_sea.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;

SmallSlopeUncertainty Of(double wind_speed, BeamOptions beam) {
  return ClosedForm(SeaState(wind_speed, kFullyDeveloped), beam, kRefractiveIndex);
}

// Computed independently of this code, to 0.01 degree.
TEST(ClosedForm, HasTheKnownRefractionOfASmallFootprintOnAFullyDevelopedSea) {
  constexpr double kPrinted = 0.005;
  const BeamOptions nadir{.footprint = 0.25}, slanted{.incidence = 20 * kDegree, .footprint = 0.25};
  EXPECT_NEAR(Of(2, nadir).refraction_along_wind / kDegree, 1.68, kPrinted);
  EXPECT_NEAR(Of(2, nadir).refraction_cross_wind / kDegree, 1.42, kPrinted);
  EXPECT_NEAR(Of(5.25, nadir).refraction_along_wind / kDegree, 2.94, kPrinted);
  EXPECT_NEAR(Of(5.25, nadir).refraction_cross_wind / kDegree, 2.48, kPrinted);
  EXPECT_NEAR(Of(2, slanted).refraction_along_wind / kDegree, 1.92, kPrinted);
  EXPECT_NEAR(Of(5.25, slanted).refraction_along_wind / kDegree, 3.38, kPrinted);
}

// Without the filter of a footprint the refraction is the gain times the slope, whose variances are in the ratio 7 to
// 5.
TEST(ClosedForm, OfAVanishingFootprintIsTheGainTimesTheSlope) {
  const SeaState sea(5, kFullyDeveloped);
  const SmallSlopeUncertainty uncertainty = ClosedForm(sea, {.footprint = 1e-7}, kRefractiveIndex);
  const double mean_square_slope = SlopeCovariance(sea).trace(), g = 1 - 1 / kRefractiveIndex;
  EXPECT_NEAR(uncertainty.refraction_along_wind, 2 * g * std::sqrt(7.0 / 12 * mean_square_slope), 1e-7);
  EXPECT_NEAR(uncertainty.refraction_cross_wind, 2 * g * std::sqrt(5.0 / 12 * mean_square_slope), 1e-7);
  EXPECT_NEAR(uncertainty.thu_per_depth, 2 * g * std::sqrt(mean_square_slope), 1e-7);
}

TEST(ClosedForm, HasNoFirstOrderVerticalErrorAtNadir) { EXPECT_EQ(Of(5, {.footprint = 0.25}).tvu_per_depth, 0); }

// In the plane of incidence a small change of the tangent changes the path d sqrt(1 + t^2) by d sin(theta_r), and the
// reported depth by cos(theta_r) times that.
TEST(ClosedForm, DerivesTvuFromTheInPlaneRefraction) {
  const SmallSlopeUncertainty along = Of(5, {.incidence = 0.3, .azimuth = 0, .footprint = 0.5});
  const double refracted = StillWaterRefraction(0.3, kRefractiveIndex);
  EXPECT_NEAR(along.tvu_per_depth, along.refraction_along_wind * std::sin(refracted) * std::cos(refracted), 1e-15);
}

TEST(ClosedForm, IsTheSameInEveryQuadrantOfAzimuth) {
  const auto at = [](double degrees) {
    return Of(5, {.incidence = 0.3, .azimuth = degrees * kDegree, .footprint = 0.5});
  };
  for (const double degrees : {-30.0, 150.0, 210.0}) {
    EXPECT_NEAR(at(degrees).refraction_along_wind, at(30).refraction_along_wind, 1e-14);
    EXPECT_NEAR(at(degrees).tvu_per_depth, at(30).tvu_per_depth, 1e-14);
  }
}

TEST(ClosedForm, FallsAsTheFootprintGrows) {
  double before = std::numeric_limits<double>::infinity();
  for (const double footprint : {0.1, 0.25, 1.0, 4.0}) {
    const double refraction = Of(5, {.footprint = footprint}).refraction_along_wind;
    EXPECT_LT(refraction, before);
    before = refraction;
  }
}

TEST(ClosedForm, FallsAsMoreWavesAreCorrectedFor) {
  const BeamOptions beam{.incidence = 0.3, .footprint = 0.5};
  for (const SpectrumModel* model : kSpectrumModels) {
    SeaOptions options{.waves = WindSea{.wind_speed_10m = 8, .model = model}};
    double before = ClosedForm(SeaState(options), beam, kRefractiveIndex).thu_per_depth;
    for (const double corrected_above : {100.0, 30.0, 10.0, 3.0, 1.0, 0.5}) {
      options.corrected_above = corrected_above;
      const double thu = ClosedForm(SeaState(options), beam, kRefractiveIndex).thu_per_depth;
      EXPECT_LT(thu, before) << model->key << ", " << corrected_above << " m";
      before = thu;
    }
  }
}

constexpr double kPi = std::numbers::pi;

class FootprintOfProfile : public ::testing::TestWithParam<BeamProfile> {};
INSTANTIATE_TEST_SUITE_P(, FootprintOfProfile, ::testing::Values(BeamProfile::kUniform, BeamProfile::kGaussian),
                         [](const auto& test) { return std::string(Name(test.param)); });

// The integral of the relative irradiance over the plane, in squared diameters.
double Power(BeamProfile profile) { return profile == BeamProfile::kUniform ? kPi / 4 : kPi / 8; }

// Midpoint rule in the radius up to `radius`; the edge of the uniform beam falls between two steps.
double PowerWithin(BeamProfile profile, double radius) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double r = radius * (i + 0.5) / kSteps;
    sum += RelativeIrradiance(profile, r * r) * 2 * kPi * r * radius / kSteps;
  }
  return sum;
}

TEST_P(FootprintOfProfile, HasItsName) { EXPECT_EQ(FindBeamProfile(Name(GetParam())), GetParam()); }

TEST_P(FootprintOfProfile, IsNormalizedByItsPower) {
  EXPECT_NEAR(PowerWithin(GetParam(), 2) / Power(GetParam()), 1, 1e-4);
  EXPECT_EQ(RelativeIrradiance(GetParam(), 0), 1);
}

TEST_P(FootprintOfProfile, HoldsTheStatedPowerWithinItsRadius) {
  for (const double power : {0.1, 0.5, 0.9, 0.999})
    EXPECT_NEAR(PowerWithin(GetParam(), RadiusOfPower(GetParam(), power)) / Power(GetParam()), power, 1e-6) << power;
}

// The convolution of the irradiance with itself, by the midpoint rule on a grid.
TEST_P(FootprintOfProfile, OverlapsItselfAsItsConvolutionSays) {
  constexpr int kHalf = 400;
  constexpr double kStep = 1.6 / kHalf;  // to 1.6 diameters, where a gaussian beam has ended
  const auto convolution = [](double apart) {
    double sum = 0;
    for (int i = -kHalf; i < kHalf; ++i) {
      for (int j = -kHalf; j < kHalf; ++j) {
        const double x = (i + 0.5) * kStep, y = (j + 0.5) * kStep;
        sum += RelativeIrradiance(GetParam(), x * x + y * y) *
               RelativeIrradiance(GetParam(), (x - apart) * (x - apart) + y * y) * kStep * kStep;
      }
    }
    return sum;
  };
  const double itself = convolution(0);
  // Cells of the grid on the edge of the uniform beam: a length of pi diameters, half a step, with random signs.
  const double tolerance = GetParam() == BeamProfile::kUniform ? 2e-3 : 1e-9;
  for (const double apart : {0.1, 0.35, 0.7, 0.95})
    EXPECT_NEAR(convolution(apart) / itself, FootprintOverlap(GetParam(), apart), tolerance) << apart;
}

TEST_P(FootprintOfProfile, OverlapsItselfWhollyWhereItIs) { EXPECT_EQ(FootprintOverlap(GetParam(), 0), 1); }

TEST(UniformFootprint, HasNoOverlapBeyondItsDiameter) {
  EXPECT_EQ(FootprintOverlap(BeamProfile::kUniform, 1), 0);
  EXPECT_EQ(FootprintOverlap(BeamProfile::kUniform, 1.5), 0);
  EXPECT_GT(FootprintOverlap(BeamProfile::kUniform, 0.999), 0);
}

TEST(UniformFootprint, EndsAtItsDiameter) {
  EXPECT_EQ(RelativeIrradiance(BeamProfile::kUniform, 0.2499), 1);
  EXPECT_EQ(RelativeIrradiance(BeamProfile::kUniform, 0.2501), 0);
}

TEST(GaussianFootprint, FallsToOneOverESquaredAtItsDiameter) {
  EXPECT_NEAR(RelativeIrradiance(BeamProfile::kGaussian, 0.25), std::exp(-2), 1e-15);
}

TEST(FindBeamProfile, KnowsNoOthers) { EXPECT_FALSE(FindBeamProfile("ring").has_value()); }

TEST(WidthOnWater, IsTheDiameterOverTheCosineOfTheIncidence) {
  EXPECT_EQ(WidthOnWater({.footprint = 0.5}), 0.5);
  EXPECT_NEAR(WidthOnWater({.incidence = kPi / 3, .footprint = 0.5}), 1, 1e-15);
  EXPECT_EQ(WidthOnWater({.footprint = 0.5, .profile = BeamProfile::kGaussian}), 1);
}

// A gaussian beam of twice the diameter's width leaves out exp(-8) of its power.
TEST(WidthOnWater, HoldsAGaussianBeam) {
  EXPECT_NEAR(RadiusOfPower(BeamProfile::kGaussian, 1 - std::exp(-8)), 1, 1e-12);
}

// W is the Fourier transform of the irradiance over its power: the mean of cos(k . x) over the ellipse on the water.
TEST_P(FootprintOfProfile, AveragesAWaveAsTheFourierTransformOfItsIrradiance) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5, .footprint = 0.8, .profile = GetParam()};
  constexpr int kRadii = 2000, kTurns = 64;
  constexpr double kEnd = 2;  // diameters
  for (const double k : {1e-4, 0.5, 4.0, 9.0}) {
    for (const double psi : {0.0, 1.3}) {
      double sum = 0;
      for (int i = 0; i < kRadii; ++i) {
        const double r = kEnd * (i + 0.5) / kRadii;
        for (int j = 0; j < kTurns; ++j) {
          const double turn = 2 * kPi * (j + 0.5) / kTurns;
          const double along = beam.footprint * r * std::cos(turn) / std::cos(beam.incidence);
          const double across = beam.footprint * r * std::sin(turn);
          sum += RelativeIrradiance(GetParam(), r * r) *
                 std::cos(k * (along * std::cos(psi - beam.azimuth) + across * std::sin(psi - beam.azimuth))) * r *
                 (kEnd / kRadii) * (2 * kPi / kTurns);
        }
      }
      EXPECT_NEAR(sum / Power(GetParam()), FootprintAverage(beam, k, psi), 1e-5) << k << ", " << psi;
      EXPECT_EQ(FootprintPower(beam, k, psi), std::pow(FootprintAverage(beam, k, psi), 2));
    }
  }
}

}  // namespace
}  // namespace albtpu
