// The echo of the green surface, of light that is scattered once, against photons that are scattered as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "budget/water/green_surface.h"
#include "sea/angle.h"
#include "tests/every_case.h"
#include "tests/validation/physics/green_surface_walk.h"

namespace albtpu {
namespace {

// 1/m, with the fraction that is scattered back.
struct Water {
  double absorption, scattering, fraction;

  double of_beam() const { return absorption + scattering; }
  double first() const { return absorption + fraction * scattering; }
  double diffuse() const { return std::sqrt(absorption * (absorption + 6 * fraction * scattering)); }
};
// Albedos of 0.8 from a clear sea to a harbour, then one of 0.9, and other particles.
const std::vector<Water> kWaters = {{0.07, 0.28, 0.0183}, {0.2, 0.8, 0.0183}, {0.5, 2, 0.0183}, {1, 4, 0.0183},
                                    {0.2, 1.8, 0.0183},   {0.2, 0.8, 0.01},   {0.2, 0.8, 0.03}};

using albtpu::testing::EveryCase;

std::vector<WalkedEcho> Walk(const Water& water, GreenSurfaceWalk walk) {
  walk.absorption = water.absorption, walk.scattering = water.scattering;
  return WalkGreenSurface(PhaseFunction::FournierForand(water.fraction), walk, 1);
}

// A walk that is right has no other attenuation than this one, at any incidence and detector.
TEST(GreenSurfaceEcho, OfLightScatteredOnceHasTheAttenuationOfTheBeam) {
  const auto once = [](const WalkedEcho& echo) -> const std::vector<double>& { return echo.once; };
  for (const double degrees : {0.0, 20.0})
    for (const Water& water : {kWaters[0], kWaters[2]}) {
      const auto pools = Walk(water, {.incidence = RadiansOfDegrees(degrees), .longest = 4, .photons = 10'000});
      for (const EchoDetector detector : {EchoDetector::kHalf, EchoDetector::kPeak})
        for (const double glint : {0.0, 0.5, 3.0}) {  // ns
          const WaterReceiver receiver{.detector = detector, .pulse_length = 1.5};
          const WalkedDelay walked = DelayOf(pools, once, glint, receiver);
          EXPECT_NEAR(walked.delay, GreenSurfaceDelay(glint, water.of_beam(), receiver),
                      std::max(0.001, 3 * walked.standard_error))
              << degrees << " degrees, " << water.absorption << ", glint " << glint;
        }
    }
}

// What is scattered forwards stays in a field of view of metres: a + B b, and neither the attenuation of the beam nor
// that of light that was scattered many times. With ALBTPU_EVERY_CASE=1 it prints long pulses and peaks, too.
TEST(GreenSurfaceEcho, OfAllLightHasTheAttenuationOfWhatIsScatteredBack) {
  const std::vector<double> fields = {0.3, 1, 5};
  const std::vector<double> pulses = EveryCase() ? std::vector<double>{1.5, 5} : std::vector<double>{1.5};
  for (std::size_t i = 0; i < kWaters.size(); ++i) {
    const Water& water = kWaters[i];
    if (!EveryCase() && i != 1 && i != 2) continue;
    const auto pools = Walk(water, {.fields_of_view = fields, .longest = EveryCase() ? 14.0 : 4.0});
    for (const double pulse : pulses)
      for (const EchoDetector detector : {EchoDetector::kHalf, EchoDetector::kPeak})
        for (const double glint : {0.0, 0.3, 1.0})  // lengths of the pulse
          for (std::size_t field = 0; field < fields.size(); ++field) {
            const auto seen = [field](const WalkedEcho& echo) -> const std::vector<double>& {
              return echo.seen[field];
            };
            const WaterReceiver receiver{.detector = detector, .pulse_length = pulse};
            const WalkedDelay walked = DelayOf(pools, seen, glint * pulse, receiver);
            const auto over = [&](double attenuation) {
              return walked.delay - GreenSurfaceDelay(glint * pulse, attenuation, receiver);
            };
            const bool half = detector == EchoDetector::kHalf;
            if (EveryCase())
              std::printf(
                  "a %.2f b %.2f 1/m B %.4f, %.1f ns %s, glint %.1f, view %.1f m: %.1f +- %.1f mm, formula with a + B "
                  "b "
                  "b %+.1f, with K %+.1f, with a + b %+.1f\n",
                  water.absorption, water.scattering, water.fraction, pulse, half ? "half" : "peak", glint,
                  fields[field], 1e3 * walked.delay, 1e3 * walked.standard_error, -1e3 * over(water.first()),
                  -1e3 * over(water.diffuse()), -1e3 * over(water.of_beam()));
            // Without a glint, turbid water sends back enough light that was scattered more often to be seen.
            if (half && pulse < 2 && fields[field] >= 1 && (glint > 0 || water.first() < 0.3)) {
              EXPECT_NEAR(over(water.first()), 0, std::max(0.001, 3 * walked.standard_error))
                  << water.absorption << " " << glint << " " << fields[field];
            }
          }
  }
}

}  // namespace
}  // namespace albtpu
