#include "generator/surface/sea_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>

#include "generator/surface/discretization.h"
#include "sea/sampled_spectrum.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

const auto kEverything = [](double, double) { return 1.0; };

struct SeaAndBeam {
  double wind_speed, fetch;
  BeamOptions beam;
  const SpectrumModel* model = &kApelModel;

  SeaState Sea() const {
    return SeaState({.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = model}});
  }
};

// Footprints narrower than, comparable to and wider than the waves; short and unlimited fetch.
const std::vector<SeaAndBeam> kCases = {
    {2, kFullyDeveloped, {.footprint = 0.25}},
    {2, 1e3, {.incidence = 0.35, .footprint = 1}},
    {5, kFullyDeveloped, {.incidence = 0.35, .azimuth = 0.8, .footprint = 0.25}},
    {5, 100, {.footprint = 0.5, .profile = BeamProfile::kGaussian}},
    {10, 1e4, {.incidence = 0.35, .footprint = 2, .profile = BeamProfile::kGaussian}},
    {15, kFullyDeveloped, {.incidence = 0.436, .footprint = 0.1}},
    {15, kFullyDeveloped, {.incidence = 0.436, .azimuth = 1.57, .footprint = 5}},
    {1, kFullyDeveloped, {.incidence = 0.436, .footprint = 1.5}, &kElfouhailyModel},
    {4, 1e3, {.incidence = 0.2, .azimuth = 0.8, .footprint = 1.5}, &kElfouhailyModel},
    {15, 1e3, {.incidence = 0.436, .footprint = 5}, &kElfouhailyModel},
    {9, kFullyDeveloped, {.incidence = 0.436, .footprint = 0.5}, &kElfouhailyModel},
};

// The excess of the sum over the drawn waves, which needs no random draw. Two standard deviations of refraction and THU
// have half of it.
TEST(SurfaceModel, HasTheSlopeVariancesOfTheClosedFormOverTheFootprint) {
  for (const SeaAndBeam& c : kCases) {
    const SeaState sea = c.Sea();
    const SurfaceModel model(sea, c.beam, ChooseDiscretization(sea, {c.beam}));
    const auto seen = [&](double k, double psi) { return FootprintPower(c.beam, k, psi); };
    const Eigen::Matrix2d exact = SlopeCovariance(sea, seen);
    const Eigen::Matrix2d excess = (model.FacetSlopeCovariance(seen) - exact) / (exact.trace() / 2);
    EXPECT_LE(excess.diagonal().cwiseAbs().maxCoeff(), 0.0015)
        << excess << " at " << c.wind_speed << " m/s, " << c.fetch << " m, " << c.beam.footprint << " m";
  }
}

// A swell of three lines of the lattice, beside which the spectrum is 0: in a narrow ring one node alone has slope.
TEST(LongWaveModel, IsFiniteWhereARingHasSlopeAtOneNode) {
  HarmonicSpectrum swell = FlatSea(SeaWavenumbers(), 1);
  std::fill_n(swell.s.begin() + 75, 3, 0.4);
  for (std::size_t i = 0; i < swell.k.size(); ++i)
    if (swell.k[i] > 2.1 && swell.k[i] < 300) swell.s[i] = 0.003 * std::pow(swell.k[i], -3);
  const SeaState sea(
      {.waves = KnownWaves{std::make_shared<SampledSpectrum>(swell, SpectrumText{"swell", "a test", "none"})}});
  for (double all_patch = 10; all_patch < 60; all_patch *= 1.002) {
    const LongWaveModel model(sea, CrossFade(all_patch / 2, all_patch));
    for (const LongWaveModel::Wave& wave : model.waves())
      ASSERT_TRUE(std::isfinite(wave.variance) && wave.wavenumber.allFinite()) << all_patch;
  }
}

// Waves that all travel in a narrow range of directions about `psi` [rad], of which harmonic 2 n has the mean `r2` to
// the power n^2, as a normal distribution has. With an `r2` of 1 they travel in one direction.
SeaState NarrowSwell(double r2, double psi) {
  HarmonicSpectrum swell = FlatSea(SeaWavenumbers(), 2);
  for (std::size_t i = 0; i < swell.k.size(); ++i) {
    const double off_peak = std::log(swell.k[i] / 0.05) / 0.2;
    swell.s[i] = 5 * std::exp(-0.5 * off_peak * off_peak);
    for (std::size_t n = 0; n < 2; ++n) {
      const double harmonic = 2 * static_cast<double>(n + 1), mean = std::pow(r2, harmonic * harmonic / 4);
      swell.a[n][i] = mean * std::cos(harmonic * psi);
      swell.b[n][i] = mean * std::sin(harmonic * psi);
    }
  }
  return SeaState(
      {.waves = KnownWaves{std::make_shared<SampledSpectrum>(swell, SpectrumText{"swell", "a test", "none"})}});
}

// The swell travels between two of twelve directions, and along one of them. Trapezoids, fine enough to count as exact.
TEST(LongWaveModel, HasTheSlopesOfNarrowSwellInEveryDirection) {
  const CrossFade share(9, 19);
  constexpr double kStep = 5e-3, kTurn = std::numbers::pi / 720;
  for (const double r2 : {0.5, 0.9, 0.98, 0.995, 1.0}) {
    for (const double psi : {0.0, 0.07, 0.1309, 0.2, 0.9, 1.5}) {
      const SeaState sea = NarrowSwell(r2, psi);
      Eigen::Matrix2d exact = Eigen::Matrix2d::Zero();
      for (double k = sea.energetic_range().lowest; k < sea.energetic_range().highest; k *= std::exp(kStep)) {
        for (int j = 0; j < 720; ++j) {
          const double towards = j * kTurn;
          const Eigen::Vector2d wave(k * std::cos(towards), k * std::sin(towards));
          exact += 2 * sea.Psi(k, towards) * k * k * kStep * kTurn * wave * wave.transpose();
        }
      }
      const Eigen::Matrix2d error = LongWaveModel(sea, share).SlopeCovariance(kEverything) - exact;
      EXPECT_LT(error.cwiseAbs().maxCoeff(), 2e-3 * exact.trace()) << r2 << ", " << psi << '\n'
                                                                   << error / exact.trace();
    }
  }
}

// Published tables are computed with them.
TEST(LongWaveModel, HasTwelveDirectionsForEveryWindSea) {
  for (const SpectrumModel* spectrum : kSpectrumModels) {
    for (const double spreading : {0.5, 2.0, 30.0}) {
      const SeaState sea(
          {.waves = WindSea{.wind_speed_10m = 7, .fetch = 1e4, .model = spectrum, .spreading = spreading}});
      const LongWaveModel model(sea, CrossFade(9, 19));
      for (const LongWaveModel::Wave& wave : model.waves()) {
        const double sectors = 12 * std::atan2(wave.wavenumber.y(), wave.wavenumber.x()) / std::numbers::pi;
        EXPECT_NEAR(sectors - 0.5, std::round(sectors - 0.5), 1e-9) << spectrum->key << ", " << spreading;
      }
    }
  }
}

// Where the footprint is narrower than the waves, as it is in most surveys, plane waves have nearly all of its slope.
TEST(SurfaceModel, HasNoExcessOfSlopeUnderFootprintsNarrowerThanTheWaves) {
  for (const SpectrumModel* spectrum : kSpectrumModels) {
    for (const double wind_speed : {3.0, 6.0, 12.0}) {
      const SeaAndBeam c{wind_speed, kFullyDeveloped, {.incidence = 0.35, .footprint = 0.5}, spectrum};
      const SeaState sea = c.Sea();
      const SurfaceModel model(sea, c.beam, ChooseDiscretization(sea, {c.beam}));
      const auto seen = [&](double k, double psi) { return FootprintPower(c.beam, k, psi); };
      const Eigen::Matrix2d exact = SlopeCovariance(sea, seen), drawn = model.FacetSlopeCovariance(seen);
      for (const int axis : {0, 1}) EXPECT_NEAR(drawn(axis, axis) / exact(axis, axis), 1, 2e-4) << wind_speed;
    }
  }
}

// Nothing is lost in the transition from plane waves to modes of the patch, and waves below the grid have next to no
// height.
TEST(SurfaceModel, HasTheElevationVarianceOfTheSea) {
  for (const SeaAndBeam& c : kCases) {
    const SeaState sea = c.Sea();
    const SurfaceModel model(sea, c.beam, ChooseDiscretization(sea, {c.beam}));
    EXPECT_NEAR(model.elevation_variance() / ElevationVariance(sea), 1, 0.01)
        << c.wind_speed << " m/s, " << c.fetch << " m, " << c.beam.footprint << " m";
  }
}

// At great incidences over rough water, the local surface is wider than 2.5 beams.
TEST(SurfaceModel, HasAPatchWiderThanTheLocalSurface) {
  for (const double incidence : {0.0, 0.5, 1.047}) {
    for (const BeamProfile profile : {BeamProfile::kUniform, BeamProfile::kGaussian}) {
      const BeamOptions widest{.incidence = incidence, .footprint = 0.1, .profile = profile};
      const SurfaceModel model(SeaState(15, kFullyDeveloped), widest,
                               {.patch_per_beam = 2.5, .points_per_footprint = 64, .rays = 1});
      EXPECT_LT(model.local_points(), model.patch().size()) << incidence;
    }
  }
}

class ModerateSea : public ::testing::Test {
 protected:
  const SeaState sea_{7, 1e4};
  const BeamOptions options_{.incidence = 0.35, .azimuth = 0.8, .footprint = 0.5};
  const SurfaceModel model_{sea_, options_, {.patch_per_beam = 4, .points_per_footprint = 32, .rays = 1}};
};

// The plane waves are interpolated from nodes, 84 along the side of the patch. Lagrange's cubic errs by at most 3/128
// of the fourth difference along one axis, and by 5/4 of that along the other.
TEST_F(ModerateSea, IsTheSumOfThePatchAndThePlaneWavesAtEveryPoint) {
  const int size = model_.patch().size();
  const auto& waves = model_.long_waves().waves();
  const double node_spacing = static_cast<double>(std::lround(size / 84.0)) * model_.patch().spacing();
  const Beam beam(options_, 1);
  double squares = 0;
  int count = 0;
  for (std::uint32_t realization = 0; realization < 5; ++realization) {
    NormalStream stream(1, 0, realization);
    const Eigen::VectorXcd amplitudes = model_.long_waves().Draw(stream);
    const std::vector<double> patch = model_.patch().Draw(stream);
    const double elevation =
        HeightOfIntersection(model_.long_waves(), amplitudes, Eigen::Vector2d::Zero(), beam.per_height());
    const Eigen::Vector2d origin = elevation * beam.per_height();
    double bound = 1e-12;
    for (std::size_t m = 0; m < waves.size(); ++m) {
      const Eigen::Vector2d phase = waves[m].wavenumber * node_spacing;
      bound += std::abs(amplitudes[m]) * 3.0 / 128 * (std::pow(phase.x(), 4) + 1.25 * std::pow(phase.y(), 4));
    }

    const SeaSurface::LocalSurface local = SeaSurface(model_, NormalStream(1, 0, realization)).SurfaceUnder(beam);
    EXPECT_NEAR(local.elevation, elevation, 1e-12);
    const int half = static_cast<int>(std::lround(local.heights.reach() / local.heights.spacing()));
    for (int i = -half; i <= half; ++i) {
      for (int j = -half; j <= half; ++j) {
        const Eigen::Vector2d x = Eigen::Vector2d(i, j) * local.heights.spacing();
        double direct = -elevation;
        for (std::size_t m = 0; m < waves.size(); ++m)
          direct += (amplitudes[m] * std::polar(1.0, waves[m].wavenumber.dot(origin + x))).real();
        const double long_waves =
            local.heights.FacetAt(x).HeightAt(x) - patch[((i + size) % size) * size + (j + size) % size];
        ASSERT_NEAR(long_waves, direct, bound) << i << ", " << j;
        squares += std::pow(long_waves - direct, 2);
        ++count;
      }
    }
  }
  // The root mean square error, compared with the heights of the waves in the patch.
  EXPECT_LT(std::sqrt(squares / count), 0.003 * std::sqrt(model_.patch().elevation_variance()));
}

TEST_F(ModerateSea, ExtendsBeyondTheRaysOfItsBeam) {
  const Beam beam(options_, 1000);
  const SeaSurface::LocalSurface local = SeaSurface(model_, NormalStream(1, 0, 0)).SurfaceUnder(beam);
  for (const Ray& ray : beam.Rays(local.elevation)) {
    const Hit hit = Intersect(local.heights, ray);
    EXPECT_LT((ray.at_zero + hit.height * ray.per_height()).cwiseAbs().maxCoeff(), local.heights.reach());
  }
}

// Elevation and slope of one facet at the centre of a vertical beam are normal variables. Their variances over n draws
// have the relative standard error sqrt(2/n).
TEST_F(ModerateSea, HasTheVariancesOfTheSpectrum) {
  constexpr int kDraws = 2000;
  const Beam nadir({.footprint = options_.footprint}, 1);
  double elevation = 0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    const SeaSurface::LocalSurface local = SeaSurface(model_, NormalStream(2, 0, draw)).SurfaceUnder(nadir);
    const HeightField::Facet facet = local.heights.FacetAt({0, 0});
    elevation += std::pow(local.elevation + facet.HeightAt({0, 0}), 2) / kDraws;
    slope += facet.slope.cwiseAbs2() / kDraws;
  }
  const double four_standard_errors = 4 * std::sqrt(2.0 / kDraws);
  EXPECT_NEAR(elevation / model_.elevation_variance(), 1, four_standard_errors);
  const Eigen::Matrix2d expected = model_.FacetSlopeCovariance(kEverything);
  EXPECT_NEAR(slope.x() / expected(0, 0), 1, four_standard_errors);
  EXPECT_NEAR(slope.y() / expected(1, 1), 1, four_standard_errors);
}

TEST_F(ModerateSea, IsAFunctionOfTheStreamAlone) {
  const Beam beam(options_, 1);
  const auto height = [&](std::uint32_t realization) {
    return SeaSurface(model_, NormalStream(1, 0, realization))
        .SurfaceUnder(beam)
        .heights.FacetAt({0.1, 0})
        .height_at_origin;
  };
  EXPECT_EQ(height(3), height(3));
  EXPECT_NE(height(3), height(4));
}

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
