// The Monte Carlo against the small-slope theory over the domain of surveys: it agrees within the bounds of
// corrected_waves_study.h and three standard errors, which with the control variate are less than 0.5 %.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <vector>

#include "sea/angle.h"
#include "validation/studies/corrected_waves_study.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();
constexpr int kRealizations = 300;
constexpr double kStandardErrors = 3;

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
    const Sea& sea = kSeas[s];
    const SeaCaseRatios ratios = CompareWithClosedForm(SeaCaseOf(sea), kRealizations, 1, static_cast<std::uint32_t>(s));
    for (std::size_t b = 0; b < kDirections.size(); ++b) {
      const ClosedFormRatio& beam = ratios.beams[b];
      const auto expect_within = [&](const char* quantity, const Estimate& ratio) {
        EXPECT_LE(ExcessInStandardErrors(ratio, beam.allowed), kStandardErrors)
            << quantity << " is " << ratio.value << " +- " << ratio.standard_error << " of the closed form at "
            << sea.wind_speed << " m/s, " << sea.fetch << " m of fetch, " << sea.footprint
            << " m of footprint, incidence " << kDirections[b].incidence << ", azimuth " << kDirections[b].azimuth;
      };
      expect_within("along wind", beam.along);
      expect_within("cross wind", beam.cross);
      expect_within("THU", beam.thu);
    }
  }
}

}  // namespace
}  // namespace albtpu
