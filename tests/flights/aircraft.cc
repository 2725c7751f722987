#include "tests/flights/aircraft.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace albtpu::testing {
namespace {

const double kTangentAcross = std::tan(20 * kDegree), kTangentAlong = std::tan(14 * kDegree);

}  // namespace

double RandomNumbers::Uniform(double low, double high) {
  state_ += 0x9E3779B97F4A7C15;
  std::uint64_t bits = state_;
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
  bits ^= bits >> 31;
  return low + (high - low) * (static_cast<double>(bits >> 11) + 0.5) * 0x1p-53;
}

double RandomNumbers::Normal() {  // Box and Muller (1958).
  const double radius = std::sqrt(-2 * std::log(Uniform(0, 1)));
  return radius * std::cos(Uniform(0, 2 * std::numbers::pi));
}

// The mean square of a sinusoid is half the square of its amplitude.
SmoothMotion::SmoothMotion(double mean, double sigma, double lowest, double highest, int terms, RandomNumbers& random)
    : mean_(mean) {
  const double amplitude = sigma * std::sqrt(2.0 / terms);
  for (int i = 0; i < terms; ++i) {
    const double frequency = random.Uniform(lowest, highest);
    sinusoids_.push_back({amplitude, frequency, random.Uniform(0, 2 * std::numbers::pi)});
  }
}

SmoothMotion SmoothMotion::Plus(const SmoothMotion& other) const {
  SmoothMotion sum = *this;
  sum.mean_ += other.mean_;
  sum.sinusoids_.insert(sum.sinusoids_.end(), other.sinusoids_.begin(), other.sinusoids_.end());
  return sum;
}

double SmoothMotion::At(double time) const {
  double value = mean_;
  for (const Sinusoid& s : sinusoids_) value += s.amplitude * std::sin(s.frequency * time + s.phase);
  return value;
}

double SmoothMotion::RateAt(double time) const {
  double rate = 0;
  for (const Sinusoid& s : sinusoids_) rate += s.amplitude * s.frequency * std::cos(s.frequency * time + s.phase);
  return rate;
}

std::optional<ScannerKind> FindScanner(std::string_view name) {
  if (name == "palmer" || name == "cone") return ScannerKind::kCone;
  if (name == "ellipse") return ScannerKind::kEllipse;
  if (name == "raster") return ScannerKind::kRaster;
  return std::nullopt;
}

Eigen::Vector3d BeamDirection(ScannerKind kind, double turns) {
  const double phase = 2 * std::numbers::pi * turns;
  const double along = kind == ScannerKind::kCone ? kTangentAcross : kind == ScannerKind::kEllipse ? kTangentAlong : 0;
  return Eigen::Vector3d(along * std::cos(phase), kTangentAcross * std::sin(phase), 1).normalized();
}

Eigen::Matrix3d Attitude(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

AreaChart::AreaChart(double latitude, double longitude)
    : latitude_(latitude),
      longitude_(longitude),
      metres_per_latitude_(MeridianRadius(latitude)),
      metres_per_longitude_(PrimeVerticalRadius(latitude) * std::cos(latitude)) {}

Geodetic AreaChart::At(double east, double north, double height) const {
  return {latitude_ + north / metres_per_latitude_, longitude_ + east / metres_per_longitude_, height};
}

Eigen::Vector2d AreaChart::EastNorth(const Geodetic& point) const {
  return {std::remainder(point.longitude - longitude_, 2 * std::numbers::pi) * metres_per_longitude_,
          (point.latitude - latitude_) * metres_per_latitude_};
}

Eigen::Matrix3d AircraftState::BodyAxes() const {
  const Eigen::Matrix3d east_north_up = EastNorthUp(position.latitude, position.longitude);
  Eigen::Matrix3d north_east_down;
  north_east_down << east_north_up.col(1), east_north_up.col(0), -east_north_up.col(2);
  return north_east_down * Attitude({roll, pitch, heading});
}

// Amplitudes of a twin-engined aircraft in light turbulence: 1 m/s of speed, metres of drift and height over tens of
// seconds, a few centimetres within seconds; degrees of attitude.
Aircraft::Aircraft(const AreaChart& chart, const Options& options, RandomNumbers& random)
    : chart_(chart),
      options_(options),
      along_(
          SmoothMotion(0, 6 * options.drift, 0.05, 0.2, 4, random).Plus({0, 0.03 * options.drift, 0.5, 2, 4, random})),
      across_(
          SmoothMotion(0, 5 * options.drift, 0.05, 0.2, 4, random).Plus({0, 0.05 * options.drift, 0.5, 2, 4, random})),
      height_(SmoothMotion(options.height, 3 * options.drift, 0.05, 0.3, 4, random)
                  .Plus({0, 0.05 * options.drift, 0.5, 2, 4, random})),
      roll_(SmoothMotion(0, 1.5 * kDegree, 0.1, 0.6, 4, random).Plus({0, 0.4 * kDegree, 0.6, 4, 4, random})),
      pitch_(SmoothMotion(2 * kDegree, kDegree, 0.1, 0.6, 4, random).Plus({0, 0.2 * kDegree, 0.6, 4, 4, random})),
      heading_(SmoothMotion(options.course + options.crab_angle, kDegree, 0.05, 0.4, 4, random)
                   .Plus({0, 0.2 * kDegree, 0.4, 3, 4, random})) {}

Eigen::Vector3d Aircraft::InChart(double time) const {
  const double sine = std::sin(options_.course), cosine = std::cos(options_.course);
  const double along = options_.speed * time + along_.At(time), across = across_.At(time);
  return {options_.east + along * sine + across * cosine, options_.north + along * cosine - across * sine,
          height_.At(time)};
}

AircraftState Aircraft::At(double time) const {
  const double sine = std::sin(options_.course), cosine = std::cos(options_.course);
  const double along_rate = options_.speed + along_.RateAt(time), across_rate = across_.RateAt(time);
  const Eigen::Vector3d in_chart = InChart(time), angles = Angles(time);
  AircraftState state;
  state.position = chart_.At(in_chart.x(), in_chart.y(), in_chart.z());
  // The chart's metres are not those of the ellipsoid away from its origin, nor those of the aircraft's height.
  const Geodetic& here = state.position;
  const double true_north = (MeridianRadius(here.latitude) + here.height) / chart_.metres_per_latitude();
  const double true_east =
      (PrimeVerticalRadius(here.latitude) + here.height) * std::cos(here.latitude) / chart_.metres_per_longitude();
  state.velocity = {(along_rate * cosine - across_rate * sine) * true_north,
                    (along_rate * sine + across_rate * cosine) * true_east, height_.RateAt(time)};
  state.roll = angles.x();
  state.pitch = angles.y();
  state.heading = angles.z();
  return state;
}

}  // namespace albtpu::testing
