// The chosen discretization against one twice as fine.
//
// Halving the spacing and doubling the rays keep the waves, so that two runs differ by little more than the
// discretization error. Doubling the patch draws other waves, but with the control variates two standard deviations
// are still known to 0.4 % or better. The slope variance that the footprint sees of the discrete waves, which
// determines everything in the limit of small slopes, has no random error at all.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <vector>

#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/discretization.h"
#include "generator/surface/sea_surface.h"
#include "sea/spectra/wind_sea.h"
#include "tests/degree.h"

namespace albtpu {
namespace {

using albtpu::testing::kDegree;
constexpr double kAllowed = 0.01;

struct ConvergenceCase {
  double wind_speed, fetch, footprint, incidence;  // of the slanted beam, degrees; the other beam is at nadir
  BeamProfile profile = BeamProfile::kUniform;
};
std::ostream& operator<<(std::ostream& out, const ConvergenceCase& c) {
  return out << c.wind_speed << " m/s, " << c.fetch << " m of fetch, " << c.footprint << " m of footprint";
}

// Footprints below, among and above the wavelengths; light and strong wind, short and unlimited fetch.
const std::vector<ConvergenceCase> kCases = {
    {5, kFullyDeveloped, 0.25, 20},           {3, 1e3, 1, 20},
    {10, 1e4, 2, 20, BeamProfile::kGaussian}, {15, kFullyDeveloped, 5, 25},
    {12, kFullyDeveloped, 0.25, 20},
};

std::vector<BeamOptions> Beams(const ConvergenceCase& c) {
  const BeamOptions nadir{.azimuth = 30 * kDegree, .footprint = c.footprint, .profile = c.profile};
  BeamOptions slanted = nadir;
  slanted.incidence = c.incidence * kDegree;
  return {nadir, slanted};
}

Discretization Chosen(const ConvergenceCase& c) {
  return ChooseDiscretization(SeaState(c.wind_speed, c.fetch), Beams(c));
}

Discretization WithTwiceThePatch(Discretization choice) {
  choice.patch_per_beam *= 2;
  return choice;
}
Discretization WithHalfTheSpacing(Discretization choice) {
  choice.points_per_footprint *= 2;
  return choice;
}
Discretization WithTwiceTheRays(Discretization choice) {
  choice.rays *= 2;
  return choice;
}

std::vector<BeamUncertainty> Simulated(const ConvergenceCase& c, const Discretization& discretization, int realizations,
                                       std::uint32_t cell) {
  SeaCase sea_case;
  sea_case.sea.waves = WindSea{.wind_speed_10m = c.wind_speed, .fetch = c.fetch};
  sea_case.beams = Beams(c);
  sea_case.depths = {10};
  sea_case.discretization = discretization;
  return Simulate(sea_case, {.realizations = realizations, .most_realizations = realizations}, 7, cell).beams;
}

struct ConvergingQuantity {
  const char* name;
  std::function<Estimate(const BeamUncertainty&)> of;
};
const std::vector<ConvergingQuantity> kConvergingQuantities = {
    {"refraction along wind", [](const BeamUncertainty& beam) { return beam.refraction_along_wind; }},
    {"refraction cross wind", [](const BeamUncertainty& beam) { return beam.refraction_cross_wind; }},
    {"THU", [](const BeamUncertainty& beam) { return beam.thu[0]; }},
    {"TVU", [](const BeamUncertainty& beam) { return beam.tvu[0]; }},
};

// Runs every case as chosen and as `refined`: on the same waves, so that both have the same random error, or in a cell
// of its own, where the standard errors of both count.
enum class Waves { kSame, kOther };
void ExpectNoMoreThanAPercent(const std::function<Discretization(Discretization)>& refined, Waves waves) {
  constexpr int kRealizations = 600;
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    const ConvergenceCase& c = kCases[i];
    const Discretization chosen = Chosen(c);
    const auto cell = static_cast<std::uint32_t>(2 * i);
    const std::vector<BeamUncertainty> coarse = Simulated(c, chosen, kRealizations, cell);
    const std::vector<BeamUncertainty> fine =
        Simulated(c, refined(chosen), kRealizations, waves == Waves::kSame ? cell : cell + 1);
    for (const std::size_t beam : {0, 1}) {
      for (const ConvergingQuantity& quantity : kConvergingQuantities) {
        const Estimate before = quantity.of(coarse[beam]), after = quantity.of(fine[beam]);
        const double standard_error = waves == Waves::kSame ? 0
                                                            : std::hypot(before.standard_error / before.value,
                                                                         after.standard_error / after.value);
        EXPECT_NEAR(after.value / before.value, 1, kAllowed + 3 * standard_error)
            << quantity.name << (beam == 0 ? " at nadir, " : " at slant, ") << c;
      }
    }
  }
}

TEST(Convergence, DoublingThePatchChangesNothingByMoreThanOnePercent) {
  ExpectNoMoreThanAPercent(WithTwiceThePatch, Waves::kOther);
}

// A finer grid of the same patch draws the same waves and, in addition, shorter ones.
TEST(Convergence, HalvingTheSpacingChangesNothingByMoreThanOnePercent) {
  ExpectNoMoreThanAPercent(WithHalfTheSpacing, Waves::kSame);
}

TEST(Convergence, DoublingTheRaysChangesNothingByMoreThanOnePercent) {
  ExpectNoMoreThanAPercent(WithTwiceTheRays, Waves::kSame);
}

// Standard deviations scale with the root of the slope variance, along and across the wind.
TEST(Convergence, TheSlopesThatTheFootprintSeesChangeByLessThanOnePercent) {
  for (const ConvergenceCase& c : kCases) {
    const SeaState sea(c.wind_speed, c.fetch);
    const std::vector<BeamOptions> beams = Beams(c);
    const Discretization chosen = Chosen(c);
    const SurfaceModel coarse_surface(sea, WidestBeam(beams), chosen);
    for (const Discretization& refined :
         {WithTwiceThePatch(chosen), WithHalfTheSpacing(chosen), WithHalfTheSpacing(WithTwiceThePatch(chosen))}) {
      const SurfaceModel fine_surface(sea, WidestBeam(beams), refined);
      for (const BeamOptions& beam : beams) {
        const auto seen = [&](double k, double psi) { return FootprintPower(beam, k, psi); };
        const Eigen::Matrix2d coarse = coarse_surface.FacetSlopeCovariance(seen);
        const Eigen::Matrix2d fine = fine_surface.FacetSlopeCovariance(seen);
        for (const int axis : {0, 1}) {
          EXPECT_NEAR(std::sqrt(fine(axis, axis) / coarse(axis, axis)), 1, kAllowed)
              << (axis == 0 ? "along wind, " : "across wind, ") << c;
        }
      }
    }
  }
}

}  // namespace
}  // namespace albtpu
