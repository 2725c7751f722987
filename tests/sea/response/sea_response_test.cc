#include "sea/response/sea_response.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sea/quadrature/gauss_quadrature.h"
#include "sea/response/closed_form.h"
#include "sea/response/refraction.h"
#include "tests/sea/response/seas.h"

namespace albtpu {
namespace {

constexpr double kN = kRefractiveIndex;
const BeamProfile kProfiles[] = {BeamProfile::kUniform, BeamProfile::kGaussian};

void ExpectSame(const BeamResponse& a, const BeamResponse& b, double relative) {
  EXPECT_LT((a.covariance_per_depth - b.covariance_per_depth).norm(),
            relative * b.covariance_per_depth.norm());
  EXPECT_LT((a.covariance_at_surface - b.covariance_at_surface).norm(),
            10 * relative * b.covariance_at_surface.norm());
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
        const BeamOptions beam{
            .incidence = incidence, .azimuth = 0.6, .footprint = footprint, .profile = profile};
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
    const double azimuth = 0.3, tau = std::tan(incidence),
                 still = std::cos(StillWaterRefraction(incidence, kN));
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

// At nadir the path is longer by half the squared tangent.
TEST(SeaResponse, HasTheVerticalBiasOfTheMeanSquareSlopeAtNadir) {
  const SeaResponse sea(WindSeaOf(8, kElfouhailyModel, 0.05), kN);
  const double g = 1 - 1 / kN;
  EXPECT_NEAR(sea({.footprint = 0.5}).BiasVertical(1) / (-0.5 * g * g * sea.slope_covariance().trace()), 1,
              1e-3);
  EXPECT_NEAR(sea({.footprint = 0.5}).BiasAlongBeam(1), 0, 1e-14);
}

TEST(SeaResponse, IsTheSameForASeaTurnedWithItsBeam) {
  for (const double angle : {0.4, 1.9}) {
    const BeamOptions beam{.incidence = 0.4, .azimuth = 0.3, .footprint = 0.8};
    BeamOptions turned = beam;
    turned.azimuth += angle;
    const BeamResponse straight = SeaResponse(CrossingSea(), kN)(beam);
    BeamResponse expected = straight;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    expected.covariance_per_depth = turn * straight.covariance_per_depth * turn.transpose();
    expected.covariance_at_surface = turn * straight.covariance_at_surface * turn.transpose();
    expected.mean_per_depth = turn * straight.mean_per_depth;
    ExpectSame(SeaResponse(Rotated(CrossingSea(), angle), kN)(turned), expected, 1e-6);
  }
}

TEST(SeaResponse, IsTheSameForABeamOrASeaTurnedByHalfATurn) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 0.3, .footprint = 0.8};
  const BeamResponse straight = SeaResponse(CrossingSea(), kN)(beam);
  ExpectSame(SeaResponse(Rotated(CrossingSea(), std::numbers::pi), kN)(beam), straight, 1e-12);
  BeamOptions back = beam;
  back.azimuth += std::numbers::pi;
  const BeamResponse other = SeaResponse(CrossingSea(), kN)(back);
  EXPECT_NEAR(other.refraction_along_wind(), straight.refraction_along_wind(), 1e-12);
  EXPECT_NEAR(other.Thu(3), straight.Thu(3), 1e-12);
  EXPECT_NEAR(other.Tvu(3), straight.Tvu(3), 1e-12);
  EXPECT_NEAR(other.BiasAlongBeam(3), straight.BiasAlongBeam(3), 1e-12);
}

TEST(SeaResponse, IsMirroredInAMirroredSea) {
  const BeamOptions beam{.incidence = 0.4, .azimuth = 0.3, .footprint = 0.8};
  BeamOptions mirrored = beam;
  mirrored.azimuth = -beam.azimuth;
  const BeamResponse straight = SeaResponse(CrossingSea(), kN)(beam);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1, -1, 1).asDiagonal();
  BeamResponse expected = straight;
  expected.covariance_per_depth = mirror * straight.covariance_per_depth * mirror;
  expected.covariance_at_surface = mirror * straight.covariance_at_surface * mirror;
  expected.mean_per_depth = mirror * straight.mean_per_depth;
  ExpectSame(SeaResponse(Mirrored(CrossingSea()), kN)(mirrored), expected, 1e-6);
}

// Swell across the wind: azimuths of 60 and 120 degrees are different beams.
TEST(SeaResponse, DoesNotFoldTheAzimuthOfACrossingSea) {
  const SeaResponse sea(CrossingSea(), kN);
  const double sixty = sea({.incidence = 0.4, .azimuth = 1.047, .footprint = 0.8}).Tvu(10);
  EXPECT_GT(std::abs(sea({.incidence = 0.4, .azimuth = 2.094, .footprint = 0.8}).Tvu(10) / sixty - 1), 0.02);
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

}  // namespace
}  // namespace albtpu
