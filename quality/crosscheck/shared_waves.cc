#include "quality/crosscheck/shared_waves.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/water_index.h"

namespace albtpu::quality {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kFootprintStep = 0.1;                         // Of its logarithm.
constexpr double kLeastFootprint = 0.01, kMostFootprint = 10;  // m, of MovingWaves.
constexpr double kTimeStep = 0.1;                              // s

// A length as whole steps, which are longer where it is long, and back.
struct Steps {
  double from, step;  // m
  int first;          // The number at `from`.
};
constexpr Steps kSteps[] = {{0, 0.05, 0}, {1, 0.25, 20}, {4, 1, 32}, {16, 4, 44}};

int StepOf(double length) {
  const double size = std::abs(length);
  const Steps& of = *std::ranges::find_if(std::rbegin(kSteps), std::rend(kSteps),
                                          [size](const Steps& each) { return size >= each.from; });
  const int step = of.first + static_cast<int>(std::lround((size - of.from) / of.step));
  return length < 0 ? -step : step;
}

constexpr int kFarthest = 44 + static_cast<int>((SharedWaves::kReach - 16) / 4);
constexpr int kLatest = static_cast<int>(SharedWaves::kPause / kTimeStep + 0.5);
constexpr int kPlaces = 2 * kFarthest + 1, kTimes = 2 * kLatest + 1;

double LengthOf(int step) {
  const int size = std::abs(step);
  const Steps& of = *std::ranges::find_if(std::rbegin(kSteps), std::rend(kSteps),
                                          [size](const Steps& each) { return size >= each.first; });
  const double length = of.from + (size - of.first) * of.step;
  return step < 0 ? -length : length;
}

// From the axes of a sea, x towards `x_azimuth`, to east and north.
Matrix2d ToMap(double x_azimuth) {
  const double sine = std::sin(x_azimuth), cosine = std::cos(x_azimuth);
  return Matrix2d{{sine, -cosine}, {cosine, sine}};
}

}  // namespace

PulseOnWater PulseOnWater::Of(const PointOfBeam& point, double time, std::uint16_t sea) {
  const double azimuth = RadiansOfDegrees(point.azimuth), east = std::sin(azimuth), north = std::cos(azimuth);
  const double tangent = std::tan(StillWaterRefraction(RadiansOfDegrees(point.incidence), kSeaWaterIndex));
  return {.x = point.x - point.depth * tangent * east,
          .y = point.y - point.depth * tangent * north,
          .time = time,
          .along_x = static_cast<float>(east),
          .along_y = static_cast<float>(north),
          .tangent = static_cast<float>(tangent),
          .footprint = static_cast<float>(point.footprint),
          .sea = sea};
}

std::uint16_t SharedWaves::Add(const SeaOfSource& sea) {
  auto waves = std::make_unique<const MovingWaves>(sea.spectrum);
  const double variance = waves->AtPoints().Whole().slopes.trace() / 2;
  seas_.push_back({std::move(waves), ToMap(sea.x_azimuth), variance, {}});
  return static_cast<std::uint16_t>(seas_.size() - 1);
}

double SharedWaves::operator()(const PulseOnWater& a, const PulseOnWater& b) const {
  if (a.sea != b.sea || a.sea == PulseOnWater::kNoSea) return 0;
  const double later = a.time != 0 && b.time != 0 ? b.time - a.time : 0;
  const Vector2d apart(b.x - a.x, b.y - a.y);
  if (!(std::abs(later) <= kPause && apart.squaredNorm() <= kReach * kReach)) return 0;
  const Sea& sea = seas_[a.sea];
  if (!(sea.slope_variance > 0)) return 0;
  const double width = std::clamp(std::sqrt(double{a.footprint} * b.footprint), kLeastFootprint, kMostFootprint);
  const int of_width = static_cast<int>(std::lround(std::log(width) / kFootprintStep));
  auto found = sea.of_footprints.find(of_width);
  if (found == sea.of_footprints.end()) {
    const double rounded = std::clamp(std::exp(of_width * kFootprintStep), kLeastFootprint, kMostFootprint);
    FootprintWaves waves = sea.waves->Under({.footprint = rounded});
    const Matrix2d whole = sea.to_map * waves.Whole().slopes * sea.to_map.transpose();
    const std::vector<Eigen::Matrix2f> unknown(std::size_t{kPlaces} * kPlaces * kTimes,
                                               Eigen::Matrix2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    found = sea.of_footprints.emplace(of_width, Footprint{std::move(waves), whole, unknown}).first;
  }
  Footprint& footprint = found->second;
  const int x = StepOf(apart.x()), y = StepOf(apart.y()), t = static_cast<int>(std::lround(later / kTimeStep));
  Eigen::Matrix2f& known =
      footprint.known[static_cast<std::size_t>(((t + kLatest) * kPlaces + y + kFarthest) * kPlaces + x + kFarthest)];
  if (std::isnan(known(0, 0))) {
    const Vector2d rounded = sea.to_map.transpose() * Vector2d(LengthOf(x), LengthOf(y));
    const Matrix2d slopes = footprint.waves.Between(rounded, t * kTimeStep).slopes;
    known = (sea.to_map * slopes * sea.to_map.transpose()).cast<float>();
  }
  const Vector2d of_a(a.along_x, a.along_y), of_b(b.along_x, b.along_y);
  const Matrix2d& whole = footprint.whole;
  const double shared = of_a.dot(known.cast<double>() * of_b);
  const double slopes = shared / std::sqrt(of_a.dot(whole * of_a) * of_b.dot(whole * of_b));
  // The height errs by tan(r) g m along the beam and by g^2 |m|^2 / 2, with the gain g and the slopes m.
  const double first = double{a.tangent} * b.tangent;
  const double second = std::pow(1 - 1 / kSeaWaterIndex, 2) * sea.slope_variance;
  return (first * slopes + second * slopes * slopes) / (first + second);
}

}  // namespace albtpu::quality
