#include "validation/laboratory/virtual_tank.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/ray_tracer.h"
#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "validation/laboratory/wave_staff.h"

namespace albtpu {
namespace {

TankExperiment Small() {
  TankExperiment experiment;
  experiment.beams.push_back(LaboratoryBeam(RadiansOfDegrees(20)));
  experiment.rays = 2000;
  experiment.grid = {0.512, 128};
  experiment.frames = 6;
  return experiment;
}

std::vector<double> LevelWater(const TankExperiment& experiment, double height) {
  return std::vector<double>(static_cast<std::size_t>(experiment.grid.size) * experiment.grid.size, height);
}

TEST(TankSea, HasTheRequestedWaveHeight) {
  EXPECT_NEAR(4 * std::sqrt(ElevationVariance(TankSea(3, 0.009))), 0.009, 1e-12);
}

TEST(VirtualTank, MeasuresNoRefractionInStillWater) {
  const TankExperiment experiment = Small();
  const auto still = [&](int) { return LevelWater(experiment, 0); };
  for (const TankReading& reading : ObserveTank(experiment, still)) {
    EXPECT_LT(reading.full_beam.along_wind.abs().maxCoeff(), 1e-12);
    EXPECT_EQ(reading.arrays.front().along_wind.size(), experiment.frames);
    EXPECT_LT(reading.arrays.front().along_wind.abs().maxCoeff(), 1e-12);
    EXPECT_LT(reading.arrays.front().cross_wind.abs().maxCoeff(), 1e-12);
  }
}

// Water that is lower by h and has no slope does not move a vertical beam; it moves a slanted one by h (tan - tan
// refracted).
TEST(VirtualTank, ReadsAWaterLevelAsRefractionOfASlantedBeamAsThePaperDoes) {
  const TankExperiment experiment = Small();
  const double h = 0.005;
  const auto low = [&](int) { return LevelWater(experiment, -h); };
  const auto readings = ObserveTank(experiment, low);
  EXPECT_LT(std::abs(readings[0].full_beam.along_wind[0]), 1e-6);
  const double incidence = RadiansOfDegrees(20);
  const double shift =
      h * (std::tan(incidence) - std::tan(StillWaterRefraction(incidence, experiment.refractive_index)));
  // The rays of the cone are up to 1.8 degrees off its axis, which changes their mean by a relative 1e-3 or so.
  EXPECT_NEAR(readings[1].full_beam.along_wind[0], std::atan(shift / experiment.depth), 1e-2 * shift / 0.25);
}

TEST(VirtualTank, DoesNotDependOnThreads) {
  const TankExperiment experiment = Small();
  const auto water = IndependentFrames(TankSea(3, 0.009), experiment.grid, 1, 0);
  const auto many = ObserveTank(experiment, water);
  tbb::task_arena one(1);
  one.execute([&] {
    const auto serial = ObserveTank(experiment, water);
    for (std::size_t b = 0; b < many.size(); ++b) {
      EXPECT_TRUE((many[b].arrays[0].along_wind == serial[b].arrays[0].along_wind).all());
      EXPECT_TRUE((many[b].full_beam.cross_wind == serial[b].full_beam.cross_wind).all());
    }
  });
}

TEST(VirtualTank, HasSuccessiveFramesThatContinueEachOther) {
  TankExperiment experiment = Small();
  experiment.frames = 40;
  const auto reading = [&](double rate) {
    return ObserveTank(experiment, SuccessiveFrames(TankSea(3, 0.009), experiment.grid, rate, 1, 0)).front();
  };
  const auto mean_step = [](const Eigen::ArrayXd& angle) {
    const Eigen::Index n = angle.size();
    return (angle.tail(n - 1) - angle.head(n - 1)).square().mean();
  };
  // Waves of a few hertz move little in a millisecond and a lot in 50 ms.
  EXPECT_LT(mean_step(reading(1000).full_beam.along_wind), 0.1 * mean_step(reading(20).full_beam.along_wind));
}

TEST(LightOfFrame, IsTheLightThatTheArraysSample) {
  TankExperiment experiment = Small();
  experiment.beams.resize(1);
  const auto water = IndependentFrames(TankSea(3, 0.009), experiment.grid, 1, 0);
  const auto centroid = [&](const std::vector<double>& heights) {
    return *PhotodiodeArray({}, Eigen::Vector2d(0, 0)).Centroid(LightOfFrame(experiment, heights));
  };
  const double shift = centroid(water(2)).x() - centroid(LevelWater(experiment, 0)).x();
  EXPECT_NEAR(ObserveTank(experiment, water)[0].arrays[0].along_wind[2], std::atan(shift / experiment.depth), 1e-12);
}

constexpr double kN = 1.33;
constexpr double kDepth = 0.25;  // m
const Eigen::Vector2d kOrigin(0, 0);

// The plane of slope (m, 0) through the origin.
HeightField TiltedPlane(double m) { return HeightField({-m, -m, -m, 0, 0, 0, m, m, m}, 3, 1.0); }
HeightField StillWater() { return TiltedPlane(0); }

// Vertical rays on a square lattice of pitch 1 mm, with the symmetry of the array.
std::vector<Ray> VerticalRays() {
  std::vector<Ray> rays;
  for (int i = -125; i < 125; ++i)
    for (int j = -125; j < 125; ++j) rays.push_back({{0, 0, -1}, {0.001 * (i + 0.5), 0.001 * (j + 0.5)}});
  return rays;
}

TEST(PhotodiodeArray, PutsASpotAtTheCentreOfItsPhotodiode) {
  const PhotodiodeArray array({}, {1, 2});
  EXPECT_EQ(array.Centroid({{1.027, 1.976}}).value(), Eigen::Vector2d(1.025, 1.975));
}

TEST(PhotodiodeArray, IsBlindBetweenAndBesideItsPhotodiodes) {
  const PhotodiodeArray array({}, kOrigin);
  EXPECT_FALSE(array.Centroid({{0, 0}, {0.031, 0.025}, {0.029, 0.029}, {0.175, 0.025}, {0.125, -0.131}}));
}

TEST(PhotodiodeArray, WeightsPhotodiodesByTheirLight) {
  const PhotodiodeArray array({}, kOrigin);
  const auto centroid = array.Centroid({{0.025, 0.025}, {0.024, 0.025}, {0.025, 0.026}, {-0.075, 0.025}});
  EXPECT_NEAR(centroid->x(), (3 * 0.025 - 0.075) / 4, 1e-15);
  EXPECT_NEAR(centroid->y(), 0.025, 1e-15);
}

TEST(PhotodiodeArray, HasTheCentroidOfASymmetricalBeamAtItsCentre) {
  const PhotodiodeArray array({}, kOrigin);
  const auto spots = SpotsAtDepth(VerticalRays(), StillWater(), kN, kDepth);
  EXPECT_LT(array.Centroid(spots)->norm(), 1e-15);
}

TEST(SpotsAtDepth, FollowSnellsLawThroughStillWater) {
  const Beam beam({.incidence = 0.3, .azimuth = 0.4, .footprint = 0.25, .source_height = 4}, 50);
  const std::vector<Ray> rays = beam.Rays(0);
  const auto spots = SpotsAtDepth(rays, StillWater(), kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    const Eigen::Vector2d across = rays[r].direction.head<2>();  // its length is the sine of the incidence
    const double tangent = std::tan(std::asin(across.norm() / kN));
    EXPECT_LT((spots[r] - rays[r].at_zero - kDepth * tangent * across.normalized()).norm(), 1e-15);
  }
}

// Vertical light meets a plane of slope m at alpha = atan(m) and leaves it at alpha - asin(sin(alpha) / n) from the
// vertical, towards the higher water.
TEST(SpotsAtDepth, FollowTheClosedFormUnderATiltedPlane) {
  const double m = 0.2, alpha = std::atan(m);
  const double tangent = std::tan(alpha - std::asin(std::sin(alpha) / kN));
  const std::vector<Ray> rays = VerticalRays();
  const auto spots = SpotsAtDepth(rays, TiltedPlane(m), kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); r += 997) {
    const Eigen::Vector2d& x = rays[r].at_zero;
    EXPECT_NEAR(spots[r].x(), x.x() + (kDepth + m * x.x()) * tangent, 1e-15);
    EXPECT_NEAR(spots[r].y(), x.y(), 1e-15);
  }
}

TEST(PhotodiodeArray, FollowsABeamIfItsPhotodiodesLeaveNoGaps) {
  const double m = 0.16, alpha = std::atan(m);
  const double tangent = std::tan(alpha - std::asin(std::sin(alpha) / kN));
  const auto spots = SpotsAtDepth(VerticalRays(), TiltedPlane(m), kN, kDepth);
  const PhotodiodeArray dense({.per_side = 300, .pitch = 0.001, .aperture = 0.001}, kOrigin);
  // The mean of x + (d + m x) t over a beam that is symmetrical in x. A spot is located to half a pitch.
  EXPECT_NEAR(dense.Centroid(spots)->x(), kDepth * tangent, 0.0005);
  EXPECT_NEAR(dense.Centroid(spots)->y(), 0, 1e-12);
}

TEST(SpotsAtDepth, HaveTheCentroidOfTheTracedBeam) {
  constexpr int kPoints = 101;
  std::vector<double> heights(kPoints * kPoints);
  NormalStream(1, 0, 0).Fill(heights);
  for (double& height : heights) height *= 1e-3;
  const HeightField water(std::move(heights), kPoints, 0.005);
  const std::vector<Ray> rays = Beam({.footprint = 0.25}, 2000).Rays(0);  // vertical

  const TracedBeam traced = Trace(rays, water, kN);
  Eigen::Vector2d met = kOrigin, centroid = kOrigin;
  double height = 0;
  const auto spots = SpotsAtDepth(rays, water, kN, kDepth);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    met += rays[r].at_zero / static_cast<double>(rays.size());
    height += Intersect(water, rays[r]).height / static_cast<double>(rays.size());
    centroid += spots[r] / static_cast<double>(rays.size());
  }
  // The tracer measures depth from the mean height of the intersections.
  const Eigen::Vector2d expected = met + (kDepth + height) * traced.tangent + traced.height_tangent;
  EXPECT_LT((centroid - expected).norm(), 1e-14);
  EXPECT_GT((expected - met).norm(), 1e-5);
}

constexpr double kLength = 0.5;  // m
constexpr int kSize = 16;
constexpr double kStep = 2 * std::numbers::pi / kLength;  // rad/m
constexpr int kRealizations = 3000;

const SeaState& Sea() {
  static const SeaState sea(5.25, 30);
  return sea;
}

EvolvingPatch Realization(int r) {
  return EvolvingPatch(Sea(), kLength, kSize, NormalStream(7, 0, static_cast<std::uint32_t>(r)));
}

// The amplitude of exp(i (kx x + ky y)) in the heights of a patch, kx and ky being i and j steps.
std::complex<double> Amplitude(const std::vector<double>& heights, int i, int j) {
  static const std::vector<std::complex<double>> turns = [] {
    std::vector<std::complex<double>> all;
    for (int n = 0; n < kSize; ++n) all.push_back(std::polar(1.0, -2 * std::numbers::pi * n / kSize));
    return all;
  }();
  std::complex<double> sum = 0;
  for (int ix = 0; ix < kSize; ++ix)
    for (int iy = 0; iy < kSize; ++iy) sum += heights[ix * kSize + iy] * turns[(i * ix + j * iy) & (kSize - 1)];
  return sum / static_cast<double>(kSize * kSize);
}

// The power of all modes of the patch on a frozen surface.
double VarianceOfModes() {
  double variance = 0;
  for (int i = 1 - kSize / 2; i < kSize / 2; ++i) {
    for (int j = 1 - kSize / 2; j < kSize / 2; ++j)
      if (i != 0 || j != 0) variance += Sea().Psi(kStep * std::hypot(i, j), std::atan2(j, i)) * kStep * kStep;
  }
  return variance;
}

TEST(EvolvingPatch, HasTheVarianceOfAFrozenSurfaceAtAnyInstant) {
  double sum = 0, sum_of_squares = 0;
  for (int r = 0; r < kRealizations; ++r) {
    double variance = 0;
    for (const double height : Realization(r).HeightsAt(3.7)) variance += height * height / (kSize * kSize);
    sum += variance;
    sum_of_squares += variance * variance;
  }
  const double mean = sum / kRealizations;
  const double error = std::sqrt((sum_of_squares / kRealizations - mean * mean) / kRealizations);
  EXPECT_NEAR(mean, VarianceOfModes(), 4 * error);
  EXPECT_LT(error, 0.03 * mean);
}

// The mean of h(k, t + tau) h*(k, t) is (Psi(k) exp(-i omega tau) + Psi(-k) exp(i omega tau)) / 2 with the
// directional Psi: for tau = 0 the power of a frozen surface; other lags distinguish waves that travel in opposite
// directions.
TEST(EvolvingPatch, HasWavesWithAndAgainstTheWindByTheirSpectrum) {
  constexpr int kModes[][2] = {{1, 0}, {2, 1}, {1, 2}, {0, 3}, {-2, 2}, {-3, 0}, {5, 4}};
  constexpr double kLags[] = {0.0, 0.06};
  std::array<std::array<std::complex<double>, std::size(kModes)>, 2> products{};
  for (int r = 0; r < kRealizations; ++r) {
    const EvolvingPatch patch = Realization(r);
    const auto before = patch.HeightsAt(1.1);
    for (std::size_t l = 0; l < 2; ++l) {
      const auto after = patch.HeightsAt(1.1 + kLags[l]);
      for (std::size_t m = 0; m < std::size(kModes); ++m) {
        const auto [i, j] = kModes[m];
        products[l][m] += Amplitude(after, i, j) * std::conj(Amplitude(before, i, j));
      }
    }
  }
  for (std::size_t l = 0; l < 2; ++l) {
    const double lag = kLags[l];
    for (std::size_t m = 0; m < std::size(kModes); ++m) {
      const auto [i, j] = kModes[m];
      const double k = kStep * std::hypot(i, j), psi = std::atan2(j, i);
      const double cell = Sea().S(k) / k * kStep * kStep;
      const double forth = cell * Sea().spectrum().Spreading(k, psi);
      const double back = cell * Sea().spectrum().Spreading(k, psi + std::numbers::pi);
      const std::complex<double> turn = std::polar(1.0, -AngularFrequency(k) * lag);
      const std::complex<double> expected = 0.5 * (forth * turn + back * std::conj(turn));
      const std::complex<double> found = products[l][m] / static_cast<double>(kRealizations);
      // |h|^2 is exponentially distributed: the standard error of its mean over N is its value over sqrt(N).
      const double error = 0.5 * (forth + back) / std::sqrt(kRealizations);
      EXPECT_NEAR(found.real(), expected.real(), 4 * error) << i << ", " << j << ", lag " << lag;
      EXPECT_NEAR(found.imag(), expected.imag(), 4 * error) << i << ", " << j << ", lag " << lag;
    }
  }
}

// Cosine-2S spreading has no waves straight against the wind, so a wave straight downwind travels alone.
TEST(EvolvingPatch, MovesASingleWaveDownwindAtItsPhaseSpeed) {
  const EvolvingPatch patch = Realization(0);
  const double lag = 0.031;
  const auto before = patch.HeightsAt(0), after = patch.HeightsAt(lag);
  for (int i = 1; i < kSize / 2; ++i) {
    const double k = i * kStep;
    const double way = AngularFrequency(k) / k * lag;  // m downwind: the phase decreases by k times that
    const std::complex<double> moved = Amplitude(before, i, 0) * std::polar(1.0, -k * way);
    EXPECT_LT(std::abs(Amplitude(after, i, 0) - moved), 1e-9 * std::abs(moved)) << i;
  }
}

TEST(EvolvingPatch, IsAFunctionOfItsStream) {
  EXPECT_EQ(Realization(5).HeightsAt(2), Realization(5).HeightsAt(2));
  EXPECT_NE(Realization(5).HeightsAt(2), Realization(6).HeightsAt(2));
}

}  // namespace
}  // namespace albtpu
