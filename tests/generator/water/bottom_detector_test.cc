#include "generator/water/bottom_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "generator/math/random_stream.h"

namespace albtpu {
namespace {

// A skewed echo whose late light comes from farther ahead; a bottom that falls by `tilt` delays each photon, and loses
// some of it, in proportion to its point.
Echo SkewedEcho(double tilt) {
  Echo echo(0.0005);
  UniformStream random(1, 0, 0);
  for (int i = 0; i < 20'000; ++i) {
    const double late = -0.1 * std::log(random.Next()), ahead = 0.3 * late + 0.2 * (random.Next() - 0.5);
    const double loss = 3 * ahead + 2 * late;
    echo.Add(late + tilt * ahead, ahead, 1 - tilt * loss, {.delay = ahead, .loss = loss});
  }
  echo.Add(0, 0, 20'000, {});
  return echo;
}

TEST(BottomDetector, FindsASinglePointAtItsTime) {
  Echo echo(0.001);
  echo.Add(0.25, 0.5, 3, {.delay = 0.6, .loss = 2});
  for (const double pulse : {0.02, 0.1, 0.5}) {
    const auto bottom = DetectBottom(echo, pulse);
    ASSERT_TRUE(bottom.has_value());
    // Splitting light between the two nearest of 40 steps of a pulse widens it by up to 0.04 %.
    EXPECT_NEAR(bottom->width / pulse, 1, 5e-4);
    for (const Detection& detection : bottom->by) {
      EXPECT_NEAR(detection.time, 0.25, 3e-4 * pulse);
      EXPECT_NEAR(detection.by_tilt, 0.6, 1e-4);
    }
  }
}

TEST(BottomDetector, OrdersItsDetectorsOnASkewedEcho) {
  const auto bottom = DetectBottom(SkewedEcho(0), 0.1);
  ASSERT_TRUE(bottom.has_value());
  const double half = bottom->by[Index(Detector::kHalf)].time;
  const double peak = bottom->by[Index(Detector::kPeak)].time;
  const double centroid = bottom->by[Index(Detector::kCentroid)].time;
  EXPECT_GT(half, 0);
  EXPECT_GT(peak, half);
  EXPECT_GT(centroid, peak);
  EXPECT_LT(centroid, 0.05);  // The mean of all light.
  EXPECT_GT(bottom->width, 0.1);
}

TEST(BottomDetector, KnowsHowATiltChangesItsTime) {
  const double tilt = 1e-3;
  const auto level = DetectBottom(SkewedEcho(0), 0.1);
  const auto falls = DetectBottom(SkewedEcho(tilt), 0.1), rises = DetectBottom(SkewedEcho(-tilt), 0.1);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    const double seen = (falls->by[d].time - rises->by[d].time) / (2 * tilt);
    EXPECT_NEAR(seen, level->by[d].by_tilt, 2e-4) << kDetectorNames[d];
    EXPECT_GT(std::abs(seen), 5e-4) << kDetectorNames[d];
  }
}

// Light that is lost at a time leaves an echo as if the rest had been there alone.
TEST(BottomDetector, SeesLostLightAlone) {
  const auto echo = [](double tilt) {
    Echo tilted(0.0005);
    tilted.Add(0, 0, 2, {});
    tilted.Add(0.05, 0, 1 - tilt, {.loss = 1});
    return tilted;
  };
  Echo level = echo(0), by_loss(0.0005);
  by_loss.Add(0, 0, 2, {});
  by_loss.Add(0.05, 0, 1, {});
  by_loss.AddLoss(0.05, 1);
  const double tilt = 1e-3;
  const auto found = DetectBottom(level, 0.1), apart = DetectBottom(by_loss, 0.1);
  const auto less = DetectBottom(echo(tilt), 0.1), more = DetectBottom(echo(-tilt), 0.1);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    EXPECT_NEAR((less->by[d].time - more->by[d].time) / (2 * tilt), found->by[d].by_tilt, 1e-4) << kDetectorNames[d];
    EXPECT_LT(found->by[d].by_tilt, -2e-3) << kDetectorNames[d];
    EXPECT_EQ(apart->by[d].by_tilt, found->by[d].by_tilt) << kDetectorNames[d];
  }
}

TEST(BottomDetector, FindsNothingInTheDark) {
  EXPECT_FALSE(DetectBottom(Echo(0.001), 0.1).has_value());
  Echo endless(0.001);
  for (double time = 0; time < Echo::kLatest - 0.01; time += 0.001) endless.Add(time, 0, 1, {});
  EXPECT_FALSE(DetectBottom(endless, 3).has_value());
}

// In clear water the closed form is that of light drawn over a Gaussian footprint.
TEST(BottomDetector, KnowsClearWaterInClosedForm) {
  const EchoSetup setup{.incidence = 0.4, .refracted = 0.3, .footprint = 0.5, .step = 0.001};
  const double spread = setup.footprint / 4 / std::cos(setup.incidence);
  const double slope = std::sin(setup.incidence) / setup.group_index;
  Echo echo(setup.step);
  const int draws = 20'001;
  for (int i = 0; i < draws; ++i) {
    const double u = -6 + 12.0 * i / (draws - 1);
    const double ahead = spread * u;
    echo.Add(slope * ahead, ahead, std::exp(-u * u / 2), {.delay = ahead / std::cos(setup.refracted)});
  }
  const double pulse = 0.08;
  const auto drawn = DetectBottom(echo, pulse);
  const DetectedBottom clear = ClearBottom(setup, pulse);
  ASSERT_TRUE(drawn.has_value());
  EXPECT_NEAR(drawn->width, clear.width, 2e-4);
  for (const Detector detector : kDetectors) {
    const std::size_t d = Index(detector);
    EXPECT_NEAR(drawn->by[d].time, clear.by[d].time, 1e-4) << kDetectorNames[d];
    EXPECT_NEAR(drawn->by[d].by_tilt, clear.by[d].by_tilt, 5e-4) << kDetectorNames[d];
  }
  EXPECT_LT(clear.by[Index(Detector::kHalf)].time, -0.01);
}

}  // namespace
}  // namespace albtpu
