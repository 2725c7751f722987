#include "budget/water/green_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "sea/response/closed_form.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

using Eigen::Vector3d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

WaterReceiver Receiver(EchoDetector detector, double pulse_length) {
  return {.detector = detector, .field_of_view = 5, .pulse_length = pulse_length};
}

// The waveform in small steps: glint, and every layer of the water for itself.
double DelayOfLayers(double glint, double attenuation, const WaterReceiver& receiver) {
  const double sigma = receiver.pulse_length / (2 * std::sqrt(2 * std::log(2))), step = sigma / 60;
  const int before = static_cast<int>(6 * sigma / step), all = 4 * before;
  const auto pulse = [&](double t) {
    return std::exp(-t * t / (2 * sigma * sigma)) / (sigma * std::sqrt(2 * std::numbers::pi));
  };
  std::vector<double> echo(static_cast<std::size_t>(all));
  for (int i = 0; i < all; ++i) {
    const double t = (i - before) * step;
    double& sum = echo[static_cast<std::size_t>(i)] = glint * pulse(t);
    for (double later = step / 2; later < t + 6 * sigma; later += step) {
      const double path = kLightSpeed * later / (2 * receiver.group_index);
      sum += step * pulse(t - later) * std::exp(-2 * attenuation * path);
    }
  }
  const auto peak = std::max_element(echo.begin(), echo.end());
  double place = static_cast<double>(peak - echo.begin());
  if (receiver.detector == EchoDetector::kHalf) {
    const auto over = std::find_if(echo.begin(), echo.end(), [&](double e) { return e >= *peak / 2; });
    place = static_cast<double>(over - echo.begin()) - (*over - *peak / 2) / (*over - *(over - 1));
    place += receiver.pulse_length / 2 / step;
  }
  return kLightSpeed / 2 * (place - before) * step;
}

TEST(GreenSurfaceDelay, IsThatOfTheLayersOfTheWater) {
  for (const EchoDetector detector : {EchoDetector::kPeak, EchoDetector::kHalf})
    for (const double pulse_length : {1.5, 5.0})
      for (const double attenuation : {0.05, 0.3, 2.0})
        for (const double glint : {0.0, 0.3, 2.0, 20.0}) {
          const WaterReceiver receiver = Receiver(detector, pulse_length);
          // A peak is found to a step of the twin, a half to a small part of it.
          const double tolerance = detector == EchoDetector::kPeak ? 0.006 * pulse_length : 0.0002 * pulse_length;
          EXPECT_NEAR(GreenSurfaceDelay(glint, attenuation, receiver), DelayOfLayers(glint, attenuation, receiver),
                      tolerance)
              << glint << " " << attenuation;
        }
}

TEST(GreenSurfaceDelay, IsNoneOfAGlint) {
  for (const EchoDetector detector : {EchoDetector::kPeak, EchoDetector::kHalf}) {
    EXPECT_NEAR(GreenSurfaceDelay(kInfinite, 0.3, Receiver(detector, 2)), 0, 1e-8);
    EXPECT_NEAR(GreenSurfaceDelay(1e6, 0.3, Receiver(detector, 2)), 0, 1e-5);
  }
}

// In clear water its light is a step: half of it is there when the middle of the pulse is, and half a pulse is added.
TEST(GreenSurfaceDelay, IsHalfAPulseInClearWater) {
  EXPECT_NEAR(GreenSurfaceDelay(0, 1e-7, Receiver(EchoDetector::kHalf, 2)), kLightSpeed / 2 * 1, 1e-4);
}

TEST(GreenSurfaceOf, HasTheMomentsOfDrawnSurveys) {
  const WaterReceiver receiver = Receiver(EchoDetector::kHalf, 2);
  const WaterOptics optics{.attenuation = 0.3, .attenuation_log_sigma = 0.2};
  const GreenSurface surface = GreenSurfaceOf(optics, receiver);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even;
  std::exponential_distribution<double> facet;
  double sum = 0, squares = 0, spread = 0;
  constexpr int kSurveys = 150, kPulses = 100;
  for (int survey = 0; survey < kSurveys; ++survey) {
    const double attenuation = 0.3 * std::exp(0.2 * normal(random));
    const double wanted = even(random) * GreenSurfaceDelay(0, attenuation, receiver);
    std::vector<double> shares(kPulses);
    for (double& share : shares) share = facet(random);
    const auto moments = [&](double glint) {
      double mean = 0, mean_square = 0;
      for (const double share : shares) {
        const double delay = GreenSurfaceDelay(glint * share, attenuation, receiver);
        mean += delay / kPulses;
        mean_square += delay * delay / kPulses;
      }
      return std::pair(mean, mean_square - mean * mean);
    };
    double low = -8, high = 10;  // of the logarithm of the glint
    for (int i = 0; i < 14; ++i) (moments(std::exp((low + high) / 2)).first > wanted ? low : high) = (low + high) / 2;
    const auto [mean, variance] = moments(std::exp((low + high) / 2));
    sum += mean / kSurveys;
    squares += mean * mean / kSurveys;
    spread += variance / kSurveys;
  }
  EXPECT_NEAR(surface.mean, sum, 4 * surface.unknown / std::sqrt(kSurveys));
  EXPECT_NEAR(surface.unknown, std::sqrt(squares - sum * sum), 0.15 * surface.unknown);
  EXPECT_NEAR(surface.spread, std::sqrt(spread), 0.1 * surface.spread);
}

// The point of the measured times, ray by ray, where the surface is found `far` too far along the beam.
TEST(ShiftBySurfaceOf, IsThatOfAPointOfTheMeasuredTimes) {
  constexpr double kIndex = 1.34, kFar = 0.1, kPath = 7;
  for (const double degrees : {0.0, 10.0, 20.0, 40.0}) {
    const double incidence = degrees * std::numbers::pi / 180;
    const Vector3d air(std::sin(incidence), 0, -std::cos(incidence)), water = Refract(air, Vector3d::UnitZ(), kIndex);
    const Vector3d truth = kPath * water;
    // The time in water is shorter by that of `kFar` in air.
    const Vector3d reported = kFar * air + (kPath - kFar / kIndex) * water;
    const ShiftBySurface shift = ShiftBySurfaceOf(incidence, kIndex);
    EXPECT_NEAR(kFar * shift.along, (reported - truth).x(), 1e-12);
    EXPECT_NEAR(-kFar * shift.down, (reported - truth).z(), 1e-12);
  }
  EXPECT_NEAR(ShiftBySurfaceOf(0, kIndex).down, 0.2537, 1e-4);  // a quarter
}

// Points of surveys whose green surfaces are drawn lie within the total as often as it says, once its bias is taken
// away: a system of two centimetres of range.
TEST(GreenSurfaceOf, CoversPointsOfDrawnSurveys) {
  const WaterReceiver receiver = Receiver(EchoDetector::kHalf, 2);
  constexpr double kAttenuation = 0.5, kIndex = 1.34, kRange = 0.02, kOffset = 0.02;
  const GreenSurface surface = GreenSurfaceOf({.attenuation = kAttenuation}, receiver);
  std::vector<double> delays;  // by the logarithm of the glint, from -9 to 9
  for (int i = 0; i <= 360; ++i) delays.push_back(GreenSurfaceDelay(std::exp(-9 + i * 0.05), kAttenuation, receiver));
  const auto delay_at = [&](double log_glint) {
    const double place = std::clamp((log_glint + 9) / 0.05, 0.0, 359.999);
    const auto left = static_cast<std::size_t>(place);
    return std::lerp(delays[left], delays[left + 1], place - static_cast<double>(left));
  };
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> even;
  std::exponential_distribution<double> facet;
  for (const double degrees : {0.0, 20.0}) {
    const ShiftBySurface shift = ShiftBySurfaceOf(degrees * std::numbers::pi / 180, kIndex);
    const double down = std::sqrt(1 - std::pow(std::sin(degrees * std::numbers::pi / 180) / kIndex, 2)) / kIndex;
    const double sigma = std::sqrt(std::pow(down * kRange, 2) + std::pow(kOffset, 2) +
                                   std::pow(shift.down, 2) *
                                       (kRange * kRange + std::pow(surface.spread, 2) + std::pow(surface.unknown, 2)));
    constexpr int kSurveys = 4000, kPulses = 50;
    int within = 0;
    for (int survey = 0; survey < kSurveys; ++survey) {
      std::vector<double> logs(kPulses);
      for (double& log : logs) log = std::log(facet(random));
      // The glint of the survey: its mean delay is uniform.
      const double wanted = even(random) * GreenSurfaceDelay(0, kAttenuation, receiver);
      double low = -9, high = 12;
      for (int i = 0; i < 24; ++i) {
        double mean = 0;
        for (const double log : logs) mean += delay_at((low + high) / 2 + log) / kPulses;
        (mean > wanted ? low : high) = (low + high) / 2;
      }
      const double offset = kOffset * normal(random);
      for (const double log : logs) {
        const double far = delay_at((low + high) / 2 + log) - surface.mean + kRange * normal(random);
        within += std::abs(shift.down * far + down * kRange * normal(random) + offset) <= 1.96 * sigma;
      }
    }
    EXPECT_NEAR(within / double{kSurveys * kPulses}, 0.95, 0.01) << degrees;
  }
}

}  // namespace
}  // namespace albtpu
