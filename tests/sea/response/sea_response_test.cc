#include "sea/response/sea_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sea/quadrature/hankel_lattice.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
void ExpectSame(const BeamResponse& a, const BeamResponse& b, double relative) {
  EXPECT_LT((a.covariance_per_depth - b.covariance_per_depth).norm(), relative * b.covariance_per_depth.norm());
  EXPECT_LT((a.covariance_at_surface - b.covariance_at_surface).norm(), 10 * relative * b.covariance_at_surface.norm());
  EXPECT_LT((a.mean_per_depth - b.mean_per_depth).norm(), relative * b.mean_per_depth.norm());
}

// The third order in slope takes 0.3 of the mean square slope, here 1e-4, off the gain. The rest is the quadrature of
// FootprintSlopes: half of 1e-3 of the variance.
TEST(SeaResponse, IsTheClosedFormOfSmallSlopes) {
  constexpr double kScale = 0.05;
  const SeaResponse sea(WindSeaOf(8, kElfouhailyModel, kScale), kN);
  const SeaState state(
      SeaOptions{.waves = WindSea{.wind_speed_10m = 8, .model = &kElfouhailyModel}, .height_scale = kScale});
  for (const BeamProfile profile : kProfiles) {
    for (const double incidence : {0.0, 0.2, 0.5}) {
      for (const double footprint : {0.2, 1.0, 5.0}) {
        const BeamOptions beam{.incidence = incidence, .azimuth = 0.6, .footprint = footprint, .profile = profile};
        const SmallSlopeUncertainty exact = ClosedForm(state, beam, kN);
        const BeamResponse ours = sea(beam);
        EXPECT_NEAR(ours.refraction_along_wind() / exact.refraction_along_wind, 1, 6e-4);
        EXPECT_NEAR(ours.refraction_cross_wind() / exact.refraction_cross_wind, 1, 6e-4);
        EXPECT_NEAR(ours.Thu(1e6) / 1e6 / exact.thu_per_depth, 1, 6e-4);
        if (incidence > 0) {
          EXPECT_NEAR(ours.Tvu(1e6) / 1e6 / exact.tvu_per_depth, 1, 6e-4);
        }
      }
    }
  }
}

// In a footprint far smaller than all waves a beam is one ray, whose slopes are normal with the weight of the area that
// faces the beam: its variance is an integral over these slopes. The theory leaves out what is of sixth order in slope
// in the variance: the squared mean square slope relative to it.
TEST(SeaResponse, OfASingleRayIsTheVarianceOverTheSlopesThatFaceIt) {
  const HarmonicSpectrum sea = Swell(0.2, 0.4, 0.7, 0.7, 0.3);
  const SeaResponse response(sea, kN);
  const Eigen::Matrix2d slopes = response.slope_covariance();
  const double mss = slopes.trace();
  ASSERT_GT(mss, 0.03);
  const Eigen::Matrix2d root = slopes.llt().matrixL();
  for (const double incidence : {0.0, 0.05, 0.3, 0.5}) {
    const double azimuth = 0.3, tau = std::tan(incidence), still = std::cos(StillWaterRefraction(incidence, kN));
    const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
    const Eigen::Vector3d incident(std::sin(incidence) * along.x(), std::sin(incidence) * along.y(),
                                   -std::cos(incidence));
    double weights = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (const QuadratureNode& u : GaussHermite(40)) {
      for (const QuadratureNode& v : GaussHermite(40)) {
        const Eigen::Vector2d slope = root * Eigen::Vector2d(u.at, v.at);
        const RefractedRay ray = RefractAtSlope(incident, slope, kN);
        const Eigen::Vector3d error(-ray.tangent.x(), -ray.tangent.y(), -still * ray.secant);
        const double weight = u.weight * v.weight * std::max(0.0, 1 + tau * along.dot(slope));
        weights += weight;
        mean += weight * error;
        squares += weight * error * error.transpose();
      }
    }
    mean /= weights;
    const Eigen::Matrix3d exact = squares / weights - mean * mean.transpose();
    const Eigen::Matrix3d ours =
        response({.incidence = incidence, .azimuth = azimuth, .footprint = 0.02}).covariance_per_depth;
    const Eigen::Vector3d scale = exact.diagonal().cwiseSqrt();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(ours(i, j), exact(i, j), (mss * mss + 2e-3) * scale[i] * scale[j])
            << "incidence " << incidence << ", element " << i << j;
      }
    }
  }
}

// The slow twin, an independent derivation. With Gamma and H_i of the whole sea, the mean ray has a part linear in the
// waves and one quadratic in them ("Finite slopes" in docs/physics.md). Two waves k and k' make
//     q_i = W(k + k') ((tau . k) (Gamma_i . k) + (tau . k') (Gamma_i . k') - k . H_i k') / 2,
// which adds 2 Psi(k) Psi(k') q_i q_j to the covariance. The heights of all waves, of the variance v, spread the
// footprint: a wave is reduced by exp(-v (tau . k)^2 / 2) besides W, here to first order.
TEST(SeaResponse, IsASumOverWavesAndPairsOfWaves) {
  const HarmonicSpectrum sea = Swell(2e-4, 4, 0.9, 0.5, 0.2);
  const SeaResponse response(sea, kN);
  struct Wave {
    double variance;
    Eigen::Vector2d k;  // along and across the azimuth
    Eigen::Vector3d shifted;
  };
  for (const BeamProfile profile : kProfiles) {
    for (const double diameter : {0.3, 1.5, 2.5}) {
      const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5, .footprint = diameter, .profile = profile};
      const double tau = std::tan(beam.incidence), c = std::cos(beam.azimuth), s = std::sin(beam.azimuth);
      const Eigen::Matrix2d axes = (Eigen::Matrix2d() << c, -s, s, c).finished();
      const EffectiveGains gains =
          EffectiveGainsOf(beam.incidence, kN, axes.transpose() * response.slope_covariance() * axes);
      const auto average = [&](const Eigen::Vector2d& k) {
        return FootprintAverage(beam, k.norm(), std::atan2(k.y(), k.x()) + beam.azimuth);
      };
      std::vector<Wave> waves;
      double variance = 0;
      ForEachWave(sea, 36, [&](double power, const Eigen::Vector2d& k) {
        const Eigen::Vector2d turned = axes.transpose() * k;
        variance += power;
        if (power > 1e-10) waves.push_back({power, turned, tau * turned.x() * (gains.gain * turned)});
      });
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (const Wave& one : waves) {
        const Eigen::Vector3d linear = average(one.k) * (gains.gain * one.k);
        sum += one.variance * (1 - variance * std::pow(tau * one.k.x(), 2)) * linear * linear.transpose();
        for (const Wave& other : waves) {
          Eigen::Vector3d pair = one.shifted + other.shifted;
          for (int i = 0; i < 3; ++i) pair[i] -= one.k.dot(gains.curvature[i] * other.k);
          pair *= average(one.k + other.k);
          sum += 0.5 * one.variance * other.variance * pair * pair.transpose();
        }
      }
      Eigen::Matrix3d errors = Eigen::Matrix3d::Zero();
      errors.topLeftCorner<2, 2>() = -axes;
      errors(2, 2) = -std::cos(StillWaterRefraction(beam.incidence, kN));
      const Eigen::Matrix3d twin = errors * sum * errors.transpose();
      const Eigen::Matrix3d ours = response(beam).covariance_per_depth;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          EXPECT_NEAR(ours(i, j), twin(i, j), 0.005 * std::sqrt(twin(i, i) * twin(j, j)))
              << Name(profile) << ", " << diameter << " m, element " << i << j;
        }
      }
    }
  }
}

// At nadir the path is longer by half the squared tangent.
TEST(SeaResponse, HasTheVerticalBiasOfTheMeanSquareSlopeAtNadir) {
  const SeaResponse sea(WindSeaOf(8, kElfouhailyModel, 0.05), kN);
  const double g = 1 - 1 / kN;
  EXPECT_NEAR(sea({.footprint = 0.5}).BiasVertical(1) / (-0.5 * g * g * sea.slope_covariance().trace()), 1, 1e-3);
  EXPECT_NEAR(sea({.footprint = 0.5}).BiasAlongBeam(1), 0, 1e-14);
}

// Beams on which what changes nothing is tried.
const BeamOptions kBeams[] = {
    {.incidence = 0, .azimuth = 0.3, .footprint = 0.5},
    {.incidence = 0.4, .azimuth = 0.3, .footprint = 0.2},
    {.incidence = 0.5, .azimuth = 2.2, .footprint = 6},
    {.incidence = 0.3, .azimuth = 4.1, .footprint = 1, .profile = BeamProfile::kGaussian},
};

// `response` with x, y and z taken to those of `turn`.
BeamResponse Turned(BeamResponse response, const Eigen::Matrix3d& turn) {
  response.covariance_per_depth = turn * response.covariance_per_depth * turn.transpose();
  response.covariance_at_surface = turn * response.covariance_at_surface * turn.transpose();
  response.mean_per_depth = turn * response.mean_per_depth;
  response.azimuth = turn.topLeftCorner<2, 2>() * response.azimuth;
  return response;
}

TEST(SeaResponse, IsTheSameForASeaTurnedWithItsBeam) {
  for (const double angle : {0.4, 1.9, 3.6}) {
    const SeaResponse sea(CrossingSea(), kN), turned_sea(Rotated(CrossingSea(), angle), kN);
    for (const BeamOptions& beam : kBeams) {
      BeamOptions turned = beam;
      turned.azimuth += angle;
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const BeamResponse expected = Turned(sea(beam), turn), ours = turned_sea(turned);
      ExpectSame(ours, expected, 1e-6);
      EXPECT_NEAR(ours.Thu(3) / expected.Thu(3), 1, 1e-6);
      EXPECT_NEAR(ours.Tvu(3) / expected.Tvu(3), 1, 1e-6);
      EXPECT_NEAR(ours.BiasAlongBeam(3), expected.BiasAlongBeam(3), 1e-6);
      EXPECT_NEAR(ours.BiasVertical(3), expected.BiasVertical(3), 1e-6);
    }
  }
}

// A frozen surface looks the same from either side.
TEST(SeaResponse, IsTheSameForABeamOrASeaTurnedByHalfATurn) {
  const SeaResponse sea(CrossingSea(), kN), turned(Rotated(CrossingSea(), std::numbers::pi), kN);
  for (const BeamOptions& beam : kBeams) {
    ExpectSame(turned(beam), sea(beam), 1e-9);
    BeamOptions back = beam;
    back.azimuth += std::numbers::pi;
    const Eigen::Matrix3d half_turn = Eigen::Vector3d(-1, -1, 1).asDiagonal();
    ExpectSame(sea(back), Turned(sea(beam), half_turn), 1e-9);
  }
}

TEST(SeaResponse, IsMirroredInAMirroredSea) {
  const SeaResponse sea(CrossingSea(), kN), mirrored_sea(Mirrored(CrossingSea()), kN);
  for (const BeamOptions& beam : kBeams) {
    BeamOptions mirrored = beam;
    mirrored.azimuth = -beam.azimuth;
    const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
    ExpectSame(mirrored_sea(mirrored), Turned(sea(beam), mirror), 1e-6);
  }
}

// Swell across the wind: azimuths of 60 and 120 degrees are different beams.
TEST(SeaResponse, DoesNotFoldTheAzimuthOfACrossingSea) {
  const SeaResponse sea(CrossingSea(), kN);
  const double sixty = sea({.incidence = 0.4, .azimuth = 1.047, .footprint = 0.8}).Tvu(10);
  EXPECT_GT(std::abs(sea({.incidence = 0.4, .azimuth = 2.094, .footprint = 0.8}).Tvu(10) / sixty - 1), 0.02);
}

TEST(SeaResponse, OfSeveralFootprintsIsThatOfEachAlone) {
  const std::vector<double> footprints = {0.2, 1, 4};
  const SeaResponse sea(CrossingSea(), kN);
  for (const BeamProfile profile : kProfiles) {
    std::vector<FootprintKernel> kernels;
    for (const double footprint : footprints) kernels.emplace_back(profile, footprint);
    for (const double incidence : {0.0, 0.1, 0.4}) {
      for (const double azimuth : {0.0, 1.0, 2.5}) {
        const std::vector<BeamResponse> beams = sea.AlongDirection(incidence, azimuth, kernels);
        for (std::size_t f = 0; f < footprints.size(); ++f) {
          const BeamResponse alone =
              sea({.incidence = incidence, .azimuth = azimuth, .footprint = footprints[f], .profile = profile});
          EXPECT_EQ(beams[f].azimuth, alone.azimuth);
          // Blocks of products are as long as the widest footprint needs, and round otherwise.
          EXPECT_LT((beams[f].covariance_per_depth - alone.covariance_per_depth).norm(),
                    1e-5 * alone.covariance_per_depth.norm());
          EXPECT_NEAR(beams[f].Thu(0), alone.Thu(0), 1e-4 * alone.Thu(0));
          EXPECT_NEAR(beams[f].BiasAlongBeam(1), alone.BiasAlongBeam(1), 1e-12);
        }
      }
    }
  }
}

TEST(SeaResponse, OfACalmSeaIsExactlyNothing) {
  HarmonicSpectrum calm = WindSeaOf(5);
  std::fill(calm.s.begin(), calm.s.end(), 0);
  const BeamResponse beam = SeaResponse(calm, kN)({.incidence = 0.4, .azimuth = 1, .footprint = 0.5});
  EXPECT_EQ(beam.refraction_along_wind(), 0);
  EXPECT_EQ(beam.Thu(10), 0);
  EXPECT_EQ(beam.Tvu(10), 0);
  EXPECT_NEAR(beam.BiasAlongBeam(10), 0, 1e-14);
  EXPECT_NEAR(beam.BiasVertical(10), 0, 1e-14);
}

BeamResponse Example() {
  BeamResponse beam;
  beam.covariance_per_depth << 4e-4, 1e-5, 2e-5, 1e-5, 3e-4, 0, 2e-5, 0, 9e-6;
  beam.covariance_at_surface << 1e-6, 0, 0, 0, 2e-6, 0, 0, 0, 1e-8;
  beam.mean_per_depth << 0.003, -0.004, 0.002;
  beam.azimuth << 0.6, 0.8;
  return beam;
}

TEST(BeamResponse, AddsTheVariancesOfSurfaceAndDepth) {
  EXPECT_DOUBLE_EQ(Example().Thu(0), 2 * std::sqrt(3e-6));
  EXPECT_DOUBLE_EQ(Example().Thu(10), 2 * std::sqrt(100 * 7e-4 + 3e-6));
  EXPECT_DOUBLE_EQ(Example().Tvu(10), 2 * std::sqrt(100 * 9e-6 + 1e-8));
}

TEST(BeamResponse, TakesTheBiasAlongTheBeam) {
  EXPECT_NEAR(Example().BiasAlongBeam(10), 10 * (0.6 * 0.003 - 0.8 * 0.004), 1e-15);
  EXPECT_DOUBLE_EQ(Example().BiasVertical(10), 0.02);
}

// The next order is some 10 K^2.
TEST(BeamResponse, HasTheDeviationOfTheAngleOfANormalTangent) {
  const BeamResponse beam = Example();
  double mean = 0, squares = 0;
  for (const auto& [at, weight] : GaussHermite(20)) {
    const double angle = std::atan(beam.mean_per_depth.x() + std::sqrt(beam.covariance_per_depth(0, 0)) * at);
    mean += weight * angle;
    squares += weight * angle * angle;
  }
  EXPECT_NEAR(beam.refraction_along_wind() / (2 * std::sqrt(squares - mean * mean)), 1, 10 * 4e-4 * 4e-4);
}

}  // namespace
}  // namespace albtpu
