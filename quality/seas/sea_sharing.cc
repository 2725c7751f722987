#include "quality/seas/sea_sharing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "budget/air/air_sources.h"
#include "sea/angle.h"
#include "sea/catmull_rom.h"

namespace albtpu::quality {
namespace {

constexpr double kFootprintStep = 0.04;                        // Of its logarithm.
constexpr double kLeastFootprint = 0.01, kMostFootprint = 10;  // m, of BeamCorrelation.

// On the map, of entries on the axes of a sea, x towards `x_azimuth`.
SeaOfPulses::Variances OnMap(const Eigen::Matrix<double, PulsePairs::kEntries, 1>& of, double x_azimuth) {
  const double sine = std::sin(x_azimuth), cosine = std::cos(x_azimuth);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(), errors;
  turn.topLeftCorner<2, 2>() << sine, -cosine, cosine, sine;
  errors << of[0], of[1], of[2], of[1], of[3], of[4], of[2], of[4], of[5];
  return {.errors = turn * errors * turn.transpose(), .height = of[6]};
}

}  // namespace

std::uint16_t SeaSharing::Add(const SeaOfSource& sea) {
  seas_.push_back(std::make_unique<const Sea>(Sea{WaveCorrelation(sea.spectrum), sea.x_azimuth, sea.water_index}));
  return static_cast<std::uint16_t>(seas_.size() - 1);
}

SeaOfPulses SeaSharing::operator()(std::uint16_t source, double incidence, double azimuth, double footprint,
                                   std::span<const Eigen::Vector2d> places) const {
  // A damaged file may have totals beside beams that are not known.
  if (!std::isfinite(incidence) || !(std::abs(azimuth) <= 360) || !std::isfinite(footprint)) return {};
  const double steep = std::clamp(incidence, 0.0, double{kMostIncidence}) / kIncidenceStep;
  const double turned = azimuth / 360 * kAzimuths;
  constexpr int kLast = kIncidences - 1;
  const int width =
      static_cast<int>(std::lround(std::log(std::clamp(footprint, kLeastFootprint, kMostFootprint)) / kFootprintStep));
  const int i = std::min(static_cast<int>(steep), kIncidences - 2);
  const int j = static_cast<int>(std::floor(turned));
  const Key key = {source, width};
  Beams& beams = BeamsOf(key);
  // The vertical variance of a beam grows with the square of its incidence, and at nadir nothing but squares of slopes
  // is left of it, so that a straight line between two steps would be wrong by more than all of it.
  std::array<double, 4> of_incidence = CatmullRomWeights(steep - i);
  if (i + 2 > kLast) {
    // Beyond the last step as the parabola through the last three.
    const double beyond = std::exchange(of_incidence[3], 0);
    of_incidence[2] += 3 * beyond, of_incidence[1] -= 3 * beyond, of_incidence[0] += beyond;
  }
  const std::array<double, 4> of_azimuth = CatmullRomWeights(turned - j);
  const Eigen::VectorXf weights = places.size() > 1 ? pairs_.WeightsOf(places) : Eigen::VectorXf();
  Eigen::Matrix<double, PulsePairs::kEntries, 1> pulse, pairs;
  pulse.setZero(), pairs.setZero();
  for (int di = -1; di <= 2; ++di)
    for (int dj = -1; dj <= 2; ++dj) {
      const double weight =
          of_incidence[static_cast<std::size_t>(di + 1)] * of_azimuth[static_cast<std::size_t>(dj + 1)];
      if (weight == 0) continue;
      // On the other side of the vertical, a beam goes the other way.
      const int steps = std::abs(i + di), half_turn = i + di < 0 ? kAzimuths / 2 : 0;
      const int around = ((j + dj + half_turn) % kAzimuths + kAzimuths) % kAzimuths;
      const Eigen::MatrixXf& each = At(beams, key, steps, steps == 0 ? 0 : around);
      pulse += weight * each.row(0).transpose().cast<double>();
      if (places.size() > 1) pairs += weight * (each.transpose() * weights).cast<double>();
    }
  const Sea& sea = *seas_[source];
  const Eigen::Vector3d raised = ErrorOfSurfaceHeight({.incidence = incidence,
                                                       .beam_azimuth = azimuth,
                                                       .altitude = 1,
                                                       .index = sea.water_index});  // North, east, down.
  return {.pulse = OnMap(pulse, sea.x_azimuth),
          .pairs = OnMap(pairs, sea.x_azimuth),
          .by_height = {raised.y(), raised.x(), -raised.z()}};
}

SeaSharing::Beams& SeaSharing::BeamsOf(const Key& key) const {
  const absl::MutexLock lock(&mutex_);
  std::unique_ptr<Beams>& beams = beams_[key];
  if (beams == nullptr) beams = std::make_unique<Beams>();
  return *beams;
}

const Eigen::MatrixXf& SeaSharing::At(Beams& beams, const Key& key, int incidence, int azimuth) const {
  std::atomic<const Eigen::MatrixXf*>& known = beams.known[static_cast<std::size_t>(incidence * kAzimuths + azimuth)];
  if (const Eigen::MatrixXf* const found = known.load(); found != nullptr) return *found;
  const auto [source, width] = key;
  const Sea& sea = *seas_[source];
  const BeamOptions beam = {
      .incidence = RadiansOfDegrees(incidence * kIncidenceStep),
      // The azimuths of beams count to the left of the axis x, those of the compass to the right of north.
      .azimuth = sea.x_azimuth - 2 * std::numbers::pi * azimuth / kAzimuths,
      .footprint = std::clamp(std::exp(width * kFootprintStep), kLeastFootprint, kMostFootprint)};
  const BeamCorrelation of_beam(sea.waves, beam, sea.water_index);
  // East lies this far to the left of the axis x.
  const double east = sea.x_azimuth - std::numbers::pi / 2;
  auto made = std::make_unique<const Eigen::MatrixXf>(pairs_.TableOf(of_beam, east));
  // Another thread may have made the same one meanwhile.
  const Eigen::MatrixXf* other = nullptr;
  return known.compare_exchange_strong(other, made.get()) ? *made.release() : *other;
}

}  // namespace albtpu::quality
