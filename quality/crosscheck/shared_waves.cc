#include "quality/crosscheck/shared_waves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

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
constexpr double kTurn = 2 * std::numbers::pi;

// A length as whole steps, which are longer where it is long, and back.
struct Steps {
  double from, step;  // m
  int first;          // The number at `from`.
};
constexpr Steps kSteps[] = {{0, 0.05, 0}, {1, 0.25, 20}, {4, 1, 32}, {16, 4, 44}};

int StepOf(double length) {
  const Steps& of = *std::ranges::find_if(std::rbegin(kSteps), std::rend(kSteps),
                                          [length](const Steps& each) { return length >= each.from; });
  return of.first + static_cast<int>(std::lround((length - of.from) / of.step));
}

double LengthOf(int step) {
  const Steps& of = *std::ranges::find_if(std::rbegin(kSteps), std::rend(kSteps),
                                          [step](const Steps& each) { return step >= each.first; });
  return of.from + (step - of.first) * of.step;
}

constexpr int kDistances = 44 + static_cast<int>((SharedWaves::kReach - 16) / 4) + 1;
constexpr int kDirections = 72;  // in a turn
constexpr int kLatest = static_cast<int>(SharedWaves::kPause / kTimeStep + 0.5), kTimes = 2 * kLatest + 1;

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
    const std::vector<Eigen::Matrix2f> unknown(std::size_t{kTimes} * kDistances * kDirections,
                                               Eigen::Matrix2f::Constant(std::numeric_limits<float>::quiet_NaN()));
    found = sea.of_footprints.emplace(of_width, Footprint{std::move(waves), whole, unknown}).first;
  }
  Footprint& footprint = found->second;
  const int distance = StepOf(apart.norm()), time = static_cast<int>(std::lround(later / kTimeStep));
  const auto direction =
      std::lround(std::atan2(apart.y(), apart.x()) / kTurn * kDirections + kDirections) % kDirections;
  Eigen::Matrix2f* const ring = &footprint.known[std::size_t{kDirections} * ((time + kLatest) * kDistances + distance)];
  if (std::isnan(ring[0](0, 0))) {
    const WavesAtDistance waves = footprint.waves.AtDistance(LengthOf(distance), time * kTimeStep);
    const Vector2d east = sea.to_map.transpose().col(0);  // On the axes of the sea.
    const double turned = std::atan2(east.y(), east.x());
    for (int each = 0; each < kDirections; ++each) {
      const Matrix2d slopes = waves.Towards(turned + each * kTurn / kDirections).slopes;
      ring[each] = (sea.to_map * slopes * sea.to_map.transpose()).cast<float>();
    }
  }
  const Vector2d of_a(a.along_x, a.along_y), of_b(b.along_x, b.along_y);
  const Matrix2d& whole = footprint.whole;
  const double shared = of_a.dot(ring[direction].cast<double>() * of_b);
  const double slopes = shared / std::sqrt(of_a.dot(whole * of_a) * of_b.dot(whole * of_b));
  // The height errs by tan(r) g m along the beam and by g^2 |m|^2 / 2, with the gain g and the slopes m.
  const double first = double{a.tangent} * b.tangent;
  const double second = std::pow(1 - 1 / kSeaWaterIndex, 2) * sea.slope_variance;
  return (first * slopes + second * slopes * slopes) / (first + second);
}

}  // namespace albtpu::quality
