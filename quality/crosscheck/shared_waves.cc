#include "quality/crosscheck/shared_waves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

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
constexpr Steps kSteps[] = {{0, 0.05, 0}, {1, 0.25, 20}, {4, 1, 32}, {16, 4, 44}, {64, 8, 56}};

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

constexpr int kDistances = 56 + static_cast<int>((SharedWaves::kReach - 64) / 8) + 1;
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
  return pulses_->Add(sea);
}

SharedWaves::Footprint& SharedWaves::Sea::FootprintOf(double width) const {
  const double clamped = std::clamp(width, kLeastFootprint, kMostFootprint);
  const int step = static_cast<int>(std::lround(std::log(clamped) / kFootprintStep));
  const auto found = of_footprints.find(step);
  if (found != of_footprints.end()) return found->second;
  const double rounded = std::clamp(std::exp(step * kFootprintStep), kLeastFootprint, kMostFootprint);
  FootprintWaves under = waves->Under({.footprint = rounded});
  const WaveCovariance one = under.Whole();
  Footprint made{std::move(under), to_map * one.slopes * to_map.transpose(), one.heights, {}};
  made.known.resize(std::size_t{kTimes} * kDistances);
  return of_footprints.emplace(step, std::move(made)).first->second;
}

const SharedWaves::Ring& SharedWaves::Sea::RingOf(Footprint& footprint, int distance, int time) const {
  std::unique_ptr<const Ring>& known =
      footprint.known[static_cast<std::size_t>((time + kLatest) * kDistances + distance)];
  if (known != nullptr) return *known;
  const WavesAtDistance at_distance = footprint.waves.AtDistance(LengthOf(distance), time * kTimeStep);
  const Vector2d east = to_map.transpose().col(0);  // On the axes of the sea.
  const double turned = std::atan2(east.y(), east.x());
  auto ring = std::make_unique<Ring>();
  for (std::size_t each = 0; each < kDirections; ++each) {
    const WaveCovariance towards = at_distance.Towards(turned + static_cast<double>(each) * kTurn / kDirections);
    ring->slopes[each] = (to_map * towards.slopes * to_map.transpose()).cast<float>();
    ring->heights[each] = static_cast<float>(towards.heights);
  }
  known = std::move(ring);
  return *known;
}

SeaParts SharedWaves::operator()(const PulseOnWater& a, const PulseOnWater& b) const {
  if (a.sea != b.sea || a.sea == PulseOnWater::kNoSea) return {};
  const double later = a.time != 0 && b.time != 0 ? b.time - a.time : 0;
  const Vector2d apart(b.x - a.x, b.y - a.y);
  if (!(std::abs(later) <= kPause && apart.squaredNorm() <= kReach * kReach)) return {};
  const Sea& sea = seas_[a.sea];
  if (!(sea.slope_variance > 0)) return {};
  Footprint& footprint = sea.FootprintOf(std::sqrt(double{a.footprint} * b.footprint));
  const Ring& ring = sea.RingOf(footprint, StepOf(apart.norm()), static_cast<int>(std::lround(later / kTimeStep)));
  const auto turned = std::lround((std::atan2(apart.y(), apart.x()) / kTurn + 1) * kDirections);
  const auto direction = static_cast<std::size_t>(turned) % kDirections;
  const Vector2d of_a(a.along_x, a.along_y), of_b(b.along_x, b.along_y);
  const Matrix2d& whole = footprint.whole;
  const double shared = of_a.dot(ring.slopes[direction].cast<double>() * of_b);
  const double slopes = shared / std::sqrt(of_a.dot(whole * of_a) * of_b.dot(whole * of_b));
  // The height errs by tan(r) g m along the beam and by g^2 |m|^2 / 2, with the gain g and the slopes m.
  const double first = double{a.tangent} * b.tangent;
  const double second = std::pow(1 - 1 / kSeaWaterIndex, 2) * sea.slope_variance;
  return {.slopes = (first * slopes + second * slopes * slopes) / (first + second),
          .heights = ring.heights[direction] / footprint.height};
}

SeaOfPulses SharedWaves::At(const PointOfBeam& point, std::uint16_t sea) const {
  if (sea == PulseOnWater::kNoSea) return {};
  return (*pulses_)(sea, point.incidence, point.azimuth, point.footprint, {});
}

}  // namespace albtpu::quality
