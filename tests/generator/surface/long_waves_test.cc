#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "generator/surface/sea_surface.h"

namespace albtpu {
namespace {

constexpr double kFullyDeveloped = std::numeric_limits<double>::infinity();
const auto kEverything = [](double, double) { return 1.0; };

double ElevationAt(const LongWaveModel& model, const Eigen::VectorXcd& amplitudes, const Eigen::Vector2d& x) {
  double sum = 0;
  for (std::size_t m = 0; m < model.waves().size(); ++m)
    sum += (amplitudes[m] * std::polar(1.0, model.waves()[m].wavenumber.dot(x))).real();
  return sum;
}

// Waves longer than a patch of 2 m under 10 m/s.
LongWaveModel Model() { return LongWaveModel(SeaState(10, kFullyDeveloped), CrossFade(9, 19)); }

TEST(LongWaves, HaveTheVariancesThatThePatchDoesNotHold) {
  for (const double fetch : {1e3, kFullyDeveloped}) {
    const SeaState sea(10, fetch);
    const CrossFade share(9, 19);
    const LongWaveModel model(sea, share);
    // Trapezoids in log k, fine enough to count as exact.
    double elevation = 0, slope = 0;
    constexpr double kStep = 1e-4;
    for (double k = sea.energetic_range().lowest; k < 19; k *= std::exp(kStep)) {
      elevation += (1 - share(k)) * sea.spectrum()(k) * k * kStep;
      slope += (1 - share(k)) * sea.spectrum()(k) * k * k * k * kStep;
    }
    // Two nodes in a ring of the ratio 2.89 err by at most ln(2.89)^4 / 4320 of the fourth derivative with respect to
    // ln k. The elevation of waves of a given slope, k^-2, has 16 times itself.
    EXPECT_NEAR(model.elevation_variance() / elevation, 1, 16 * std::pow(std::log(2.89), 4) / 4320);
    const Eigen::Matrix2d slopes = model.SlopeCovariance(kEverything);
    EXPECT_NEAR(slopes.trace() / slope, 1, 1e-3);
    EXPECT_NEAR(slopes(0, 0) / slopes.trace(), 7.0 / 12, 1e-9);
    EXPECT_NEAR(slopes(0, 1) / slopes.trace(), 0, 1e-9);
  }
}

TEST(LongWaves, AreDrawnWithTheVarianceOfTheModel) {
  const LongWaveModel model = Model();
  constexpr int kDraws = 4000;
  double squares = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    NormalStream stream(1, 0, draw);
    squares += std::pow(ElevationAt(model, model.Draw(stream), {1.5, -20}), 2) / kDraws;
  }
  EXPECT_NEAR(squares / model.elevation_variance(), 1, 4 * std::sqrt(2.0 / kDraws));  // of a normal variable
}

TEST(LongWaves, AreTheSameWavesAboutAnotherOrigin) {
  const LongWaveModel model = Model();
  NormalStream stream(1, 2, 3);
  const Eigen::VectorXcd amplitudes = model.Draw(stream);
  const Eigen::Vector2d origin(3, -7);
  for (const Eigen::Vector2d& x : {Eigen::Vector2d(0, 0), {1, 2}, {-30, 4}}) {
    EXPECT_NEAR(ElevationAt(model, model.Shifted(amplitudes, origin), x), ElevationAt(model, amplitudes, origin + x),
                1e-12);
  }
}

TEST(LongWaves, SumOnAGridToTheirElevations) {
  const LongWaveModel model = Model();
  NormalStream stream(1, 2, 4);
  const Eigen::VectorXcd amplitudes = model.Draw(stream);
  const std::vector<double> xs = {-3, 0, 1.5, 40}, ys = {-0.2, 7};
  const auto phases = [&](const std::vector<double>& places, int axis) {
    Eigen::MatrixXcd all(places.size(), model.waves().size());
    for (std::size_t p = 0; p < places.size(); ++p)
      for (std::size_t m = 0; m < model.waves().size(); ++m)
        all(p, m) = std::polar(1.0, model.waves()[m].wavenumber[axis] * places[p]);
    return all;
  };
  const Eigen::MatrixXd sum = SumOfWaves(phases(xs, 0), amplitudes, phases(ys, 1));
  for (std::size_t i = 0; i < xs.size(); ++i)
    for (std::size_t j = 0; j < ys.size(); ++j)
      EXPECT_NEAR(sum(i, j), ElevationAt(model, amplitudes, {xs[i], ys[j]}), 1e-12);
}

TEST(HeightOfIntersection, IsTheElevationOfTheLongWavesThere) {
  const LongWaveModel model = Model();
  for (int draw = 0; draw < 100; ++draw) {
    NormalStream stream(1, 4, draw);
    const Eigen::VectorXcd amplitudes = model.Draw(stream);
    for (const double incidence : {0.0, 0.35, 0.44, 0.8}) {
      const Eigen::Vector2d per_height = -std::tan(incidence) * Eigen::Vector2d(std::cos(draw), std::sin(draw));
      const Eigen::Vector2d at_zero(0.3, -0.1);
      const double z = HeightOfIntersection(model, amplitudes, at_zero, per_height);
      EXPECT_NEAR(ElevationAt(model, amplitudes, at_zero + z * per_height), z, 1e-9);
    }
  }
}

}  // namespace
}  // namespace albtpu
