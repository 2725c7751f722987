// The Monte Carlo against the small-slope theory over the domain of surveys: it agrees within the bounds of
// closed_form_ratio.h and some standard errors, which with the control variate are less than 0.5 % at the corners.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/spectra/wind_sea.h"
#include "tests/every_case.h"
#include "validation/studies/closed_form_ratio.h"

namespace albtpu {
namespace {

std::string Describe(const SeaCase& sea_case, const BeamOptions& beam) {
  const WindSea& waves = std::get<WindSea>(sea_case.sea.waves);
  return absl::StrFormat("%g m/s, %g m of fetch, incidence %g, azimuth %g, %g m of footprint, depth %g m",
                         waves.wind_speed_10m, waves.fetch, DegreesOfRadians(beam.incidence),
                         DegreesOfRadians(beam.azimuth), beam.footprint, sea_case.depths[0]);
}

void ExpectAgreement(const SeaCase& sea_case, const SeaCaseRatios& ratios, double standard_errors) {
  for (std::size_t b = 0; b < sea_case.beams.size(); ++b) {
    const ClosedFormRatio& beam = ratios.beams[b];
    for (const auto& [quantity, ratio] :
         {std::pair("along wind", beam.along), {"cross wind", beam.cross}, {"THU", beam.thu}})
      EXPECT_LE(ExcessInStandardErrors(ratio, beam.allowed), standard_errors)
          << quantity << " is " << ratio.value << " +- " << ratio.standard_error << " of the closed form at "
          << Describe(sea_case, sea_case.beams[b]);
  }
}

struct Sea {
  double wind_speed, fetch, footprint;
  BeamProfile profile;
};

// The corners of wind, fetch and footprint, and points between them.
const std::vector<Sea> kSeas = {
    {2, kFullyDeveloped, 0.25, BeamProfile::kUniform},
    {2, 1e3, 0.25, BeamProfile::kGaussian},
    {2, kFullyDeveloped, 4, BeamProfile::kUniform},
    {4, kFullyDeveloped, 1, BeamProfile::kGaussian},
    {5.25, kFullyDeveloped, 0.25, BeamProfile::kUniform},
    {7, 1e4, 1, BeamProfile::kUniform},
    {7, kFullyDeveloped, 2, BeamProfile::kGaussian},
    {12, kFullyDeveloped, 0.25, BeamProfile::kUniform},
    {12, 1e4, 0.25, BeamProfile::kGaussian},
    {12, 1e3, 1, BeamProfile::kGaussian},
    {12, kFullyDeveloped, 4, BeamProfile::kUniform},
};

// Incidence and azimuth, degrees; all beams over a sea see the same surfaces.
struct Direction {
  double incidence, azimuth;
};
const std::vector<Direction> kDirections = {{0, 0}, {10, 45}, {20, 0}, {20, 45}, {20, 90}};

SeaCase SeaCaseOf(const Sea& sea) {
  SeaCase sea_case;
  sea_case.sea.waves = WindSea{.wind_speed_10m = sea.wind_speed, .fetch = sea.fetch};
  sea_case.depths = {10};
  for (const Direction& direction : kDirections) {
    sea_case.beams.push_back({.incidence = RadiansOfDegrees(direction.incidence),
                              .azimuth = RadiansOfDegrees(direction.azimuth),
                              .footprint = sea.footprint,
                              .profile = sea.profile});
  }
  return sea_case;
}

TEST(MonteCarlo, AgreesWithTheClosedForm) {
  for (std::size_t s = 0; s < kSeas.size(); ++s) {
    const SeaCase sea_case = SeaCaseOf(kSeas[s]);
    ExpectAgreement(sea_case, CompareWithClosedForm(sea_case, 300, 1, static_cast<std::uint32_t>(s)), 3);
  }
}

// std::mt19937_64 gives the same numbers on all platforms; the distributions of the standard library do not.
class Draws {
 public:
  double Between(double low, double high) { return low + (high - low) * 0x1p-53 * static_cast<double>(bits_() >> 11); }
  double LogBetween(double low, double high) { return std::exp(Between(std::log(low), std::log(high))); }
  bool OneIn(int n) { return Between(0, n) < 1; }

 private:
  std::mt19937_64 bits_{20180315};
};

SeaCase Draw(Draws& draws) {
  SeaCase sea_case;
  const double wind_speed = draws.Between(1, 15);
  const double fetch = draws.LogBetween(100, 1e6);
  sea_case.sea.waves =
      WindSea{.wind_speed_10m = wind_speed, .fetch = draws.OneIn(4) ? std::numeric_limits<double>::infinity() : fetch};
  sea_case.beams = {{.incidence = RadiansOfDegrees(draws.Between(0, 25)),
                     .azimuth = RadiansOfDegrees(draws.Between(0, 360)),
                     .footprint = draws.LogBetween(0.1, 5),
                     .profile = draws.OneIn(2) ? BeamProfile::kUniform : BeamProfile::kGaussian}};
  sea_case.depths = {draws.LogBetween(1, 50)};
  return sea_case;
}

// The fraction of the slope variance that the footprint passes.
double SeenFraction(const SeaCase& sea_case) {
  const SeaState sea(sea_case.sea);
  const auto seen = [&](double k, double psi) { return FootprintPower(sea_case.beams[0], k, psi); };
  return SlopeCovariance(sea, seen).trace() / SlopeCovariance(sea).trace();
}

// The result of `albtpu-generate point`.
TEST(Point, AgreesWithTheClosedFormUnderRandomConditions) {
  const int kConditions = albtpu::testing::EveryCase() ? 40 : 24;
  constexpr int kRealizations = 200;
  Draws draws;
  int judged = 0;
  // Three quantities each. With this number of standard errors chance alone fails the test in one case of twenty.
  const double k = StandardErrorsFor(3 * kConditions);
  for (std::uint32_t cell = 0; judged < kConditions; ++cell) {
    ASSERT_LT(cell, 3u * kConditions) << "too many footprints average out all waves";
    const SeaCase sea_case = Draw(draws);
    if (SeenFraction(sea_case) < kMinSeenFraction) continue;
    const SeaCaseRatios ratios = CompareWithClosedForm(sea_case, kRealizations, 1, cell);
    ++judged;
    ExpectAgreement(sea_case, ratios, k);
    // The comparison is meaningful only if the standard error is small compared with the bound.
    EXPECT_LT(ratios.beams[0].thu.standard_error, 0.03) << Describe(sea_case, sea_case.beams[0]);
  }
}

}  // namespace
}  // namespace albtpu
