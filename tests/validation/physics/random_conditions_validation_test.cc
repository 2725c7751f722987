// The result of `albtpu-generate point` against the small-slope theory, at random conditions over the domain of a
// survey.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "validation/studies/corrected_waves_study.h"

namespace albtpu {
namespace {

constexpr int kConditions = 40;
constexpr int kRealizations = 200;

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

std::string Describe(const SeaCase& sea_case) {
  const BeamOptions& beam = sea_case.beams[0];
  const WindSea& waves = std::get<WindSea>(sea_case.sea.waves);
  return absl::StrFormat("%g m/s, %g m of fetch, incidence %g, azimuth %g, %g m of footprint, depth %g m",
                         waves.wind_speed_10m, waves.fetch, DegreesOfRadians(beam.incidence),
                         DegreesOfRadians(beam.azimuth), beam.footprint, sea_case.depths[0]);
}

TEST(Point, AgreesWithTheClosedFormUnderRandomConditions) {
  Draws draws;
  int judged = 0;
  // Three quantities each. With this number of standard errors chance alone fails the test in one case of twenty.
  const double k = StandardErrorsFor(3 * kConditions);
  for (std::uint32_t cell = 0; judged < kConditions; ++cell) {
    ASSERT_LT(cell, 3u * kConditions) << "too many footprints average out all waves";
    const SeaCase sea_case = Draw(draws);
    const SeaCaseRatios ratios = CompareWithClosedForm(sea_case, kRealizations, 1, cell);
    if (ratios.seen_fraction < kMinSeenFraction) continue;
    ++judged;
    const ClosedFormRatio& beam = ratios.beams[0];
    EXPECT_LE(ExcessInStandardErrors(beam.along, beam.allowed), k) << "along wind at " << Describe(sea_case);
    EXPECT_LE(ExcessInStandardErrors(beam.cross, beam.allowed), k) << "cross wind at " << Describe(sea_case);
    EXPECT_LE(ExcessInStandardErrors(beam.thu, beam.allowed), k) << "THU at " << Describe(sea_case);
    // The comparison is meaningful only if the standard error is small compared with the bound.
    EXPECT_LT(beam.thu.standard_error, 0.03) << Describe(sea_case);
  }
}

}  // namespace
}  // namespace albtpu
