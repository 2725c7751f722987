#include "sea/response/closed_form.h"

#include <gtest/gtest.h>

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();
constexpr double kDegree = 0.017453292519943295;

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

}  // namespace
}  // namespace albtpu
