#include "tests/flights/reported_points.h"

#include <Eigen/Geometry>
#include <cmath>

namespace albtpu::testing {
namespace {

constexpr std::uint64_t kStream = 7;  // Apart from the numbers of a survey without errors.
constexpr std::array<double, 6> kSigmas = {kPositionSigma, kPositionSigma, kHeightSigma,
                                           kRollSigma,     kRollSigma,     kHeadingSigma};
// rad/s: the errors of satellite and inertial navigation last for tens of seconds to minutes.
constexpr double kSlowest = 0.02, kFastest = 0.15;
constexpr int kTerms = 40;  // So many sinusoids are nearly normal.

// Two unit vectors across `beam`.
std::array<Eigen::Vector3d, 2> Across(const Eigen::Vector3d& beam) {
  const Eigen::Vector3d first = beam.unitOrthogonal();
  return {first, beam.cross(first)};
}

}  // namespace

ReportedPoints::ReportedPoints(const ReportingErrors& errors, const Eigen::Vector3d& lever_arm, double range_noise,
                               int lines, std::uint64_t seed)
    : errors_(errors), lever_arm_(lever_arm), range_noise_(range_noise), random_(seed + kStream) {
  const auto error = [&](std::size_t i) {
    return SmoothMotion(0, errors.trajectory ? kSigmas[i] : 0, kSlowest, kFastest, kTerms, random_);
  };
  for (int line = 0; line < lines; ++line)
    of_lines_.push_back({error(0), error(1), error(2), error(3), error(4), error(5)});
}

Eigen::Vector3d ReportedPoints::Refracted(const BeamPath& path, const Eigen::Vector3d& beam) {
  if (errors_.slope_along == 0 && errors_.slope_across == 0) return path.water_direction;
  const Geodetic here = GeodeticFrom(path.water_point);
  const Eigen::Matrix3d axes = EastNorthUp(here.latitude, here.longitude);
  const double sine = std::sin(errors_.wind_from), cosine = std::cos(errors_.wind_from);
  const Eigen::Vector3d along = axes.col(0) * sine + axes.col(1) * cosine, up = axes.col(2);
  const Eigen::Vector3d slopes =
      errors_.slope_along * random_.Normal() * along + errors_.slope_across * random_.Normal() * up.cross(along);
  return Refract(beam, (up - slopes).normalized());
}

void ReportedPoints::Receive(int line, double since_start, const AircraftState& aircraft,
                             const Eigen::Vector3d& in_body, const BeamPath& path) {
  const std::array<SmoothMotion, 6>& errors = of_lines_[static_cast<std::size_t>(line)];
  const auto at = [&](std::size_t i) { return errors[i].At(since_start); };
  AircraftState reported = aircraft;
  reported.roll += at(3);
  reported.pitch += at(4);
  reported.heading += at(5);
  const Eigen::Matrix3d body = reported.BodyAxes();
  const Eigen::Matrix3d axes = EastNorthUp(reported.position.latitude, reported.position.longitude);
  sensor_ = EarthCentred(reported.position) + body * lever_arm_ + at(0) * axes.col(1) + at(1) * axes.col(0) -
            at(2) * axes.col(2);
  Eigen::Vector3d scanned = in_body;
  for (const Eigen::Vector3d& across : Across(in_body)) scanned += errors_.scan * random_.Normal() * across;
  in_air_ = body * scanned.normalized();
  surface_noise_ = range_noise_ * random_.Normal();
  at_water_ = sensor_ + (path.slant_range + surface_noise_) * in_air_;
  const Geodetic here = GeodeticFrom(at_water_);
  in_water_ = Refract(in_air_, EastNorthUp(here.latitude, here.longitude).col(2));
}

Eigen::Vector3d ReportedPoints::ReportedOnLand(double range) const {
  return sensor_ + (range + surface_noise_) * in_air_;
}

Eigen::Vector3d ReportedPoints::Reported(double way) {
  if (way == 0) return at_water_;
  const double noise = range_noise_ * random_.Normal();
  return at_water_ + (way + (noise - surface_noise_) / kIndexOfWater) * in_water_;
}

}  // namespace albtpu::testing
