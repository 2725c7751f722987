#include "quality/surface/sea_sharing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sea/angle.h"

namespace albtpu::quality {
namespace {

constexpr double kFootprintStep = 0.04;                        // Of its logarithm.
constexpr double kLeastFootprint = 0.01, kMostFootprint = 10;  // m, of BeamCorrelation.

// Of the values at -1, 0, 1 and 2 for the one between 0 and 1, by the cubic of Catmull and Rom: exact for a parabola.
// The vertical variance of a beam grows with the square of its incidence, and at nadir nothing but squares of slopes is
// left of it, so that a straight line between two steps would be wrong by more than all of it.
std::array<double, 4> CubicWeights(double t) {
  return {t * (t * (2 - t) - 1) / 2, (t * t * (3 * t - 5) + 2) / 2, t * (t * (4 - 3 * t) + 1) / 2, t * t * (t - 1) / 2};
}

// From the axes of a sea, x towards `x_azimuth`, to east, north, up.
Eigen::Matrix3d ToMap(double x_azimuth) {
  const double sine = std::sin(x_azimuth), cosine = std::cos(x_azimuth);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << sine, -cosine, cosine, sine;
  return turn;
}

}  // namespace

std::uint16_t SeaSharing::Add(const SeaOfSource& sea) {
  seas_.push_back(std::make_unique<const Sea>(Sea{WaveCorrelation(sea.spectrum), sea.x_azimuth, sea.water_index}));
  return static_cast<std::uint16_t>(seas_.size() - 1);
}

SeaInCell SeaSharing::operator()(std::uint16_t source, double incidence, double azimuth, double footprint) const {
  const double steep = std::clamp(incidence, 0.0, double{kMostIncidence}) / kIncidenceStep;
  const double turned = azimuth / 360 * kAzimuths;
  constexpr int kLast = kIncidences - 1;
  const int width =
      static_cast<int>(std::lround(std::log(std::clamp(footprint, kLeastFootprint, kMostFootprint)) / kFootprintStep));
  const int i = std::min(static_cast<int>(steep), kIncidences - 2);
  const int j = static_cast<int>(std::floor(turned));
  const Key key = {source, width};
  Beams& beams = BeamsOf(key);
  std::array<double, 4> of_incidence = CubicWeights(steep - i);
  if (i + 2 > kLast) {
    // Beyond the last step as the parabola through the last three.
    const double beyond = std::exchange(of_incidence[3], 0);
    of_incidence[2] += 3 * beyond, of_incidence[1] -= 3 * beyond, of_incidence[0] += beyond;
  }
  const std::array<double, 4> of_azimuth = CubicWeights(turned - j);
  SeaInCell sum;
  for (int di = -1; di <= 2; ++di)
    for (int dj = -1; dj <= 2; ++dj) {
      const double weight =
          of_incidence[static_cast<std::size_t>(di + 1)] * of_azimuth[static_cast<std::size_t>(dj + 1)];
      if (weight == 0) continue;
      // On the other side of the vertical, a beam goes the other way.
      const int steps = std::abs(i + di), half_turn = i + di < 0 ? kAzimuths / 2 : 0;
      const int around = ((j + dj + half_turn) % kAzimuths + kAzimuths) % kAzimuths;
      const SeaInCell& each = At(beams, key, steps, steps == 0 ? 0 : around);
      const auto add = [weight](const SeaInCell::Variances& of, SeaInCell::Variances& to) {
        to.errors += weight * of.errors, to.height += weight * of.height;
      };
      add(each.pulse, sum.pulse);
      for (std::size_t level = 0; level < sum.cell.size(); ++level) add(each.cell[level], sum.cell[level]);
    }
  return sum;
}

SeaSharing::Beams& SeaSharing::BeamsOf(const Key& key) const {
  const absl::MutexLock lock(&mutex_);
  std::unique_ptr<Beams>& beams = beams_[key];
  if (beams == nullptr) beams = std::make_unique<Beams>();
  return *beams;
}

const SeaInCell& SeaSharing::At(Beams& beams, const Key& key, int incidence, int azimuth) const {
  std::atomic<const SeaInCell*>& known = beams.known[static_cast<std::size_t>(incidence * kAzimuths + azimuth)];
  if (const SeaInCell* const found = known.load(); found != nullptr) return *found;
  const auto [source, width] = key;
  const Sea& sea = *seas_[source];
  const BeamOptions beam = {
      .incidence = RadiansOfDegrees(incidence * kIncidenceStep),
      // The azimuths of beams count to the left of the axis x, those of the compass to the right of north.
      .azimuth = sea.x_azimuth - 2 * std::numbers::pi * azimuth / kAzimuths,
      .footprint = std::clamp(std::exp(width * kFootprintStep), kLeastFootprint, kMostFootprint)};
  const BeamCorrelation of_beam(sea.waves, beam, sea.water_index);
  const Eigen::Matrix3d turn = ToMap(sea.x_azimuth);
  const auto on_map = [&](const SharedWaves& shared) -> SeaInCell::Variances {
    return {.errors = turn * shared.errors() * turn.transpose(), .height = shared.footprint.heights};
  };
  auto of_cell = std::make_unique<SeaInCell>(SeaInCell{.pulse = on_map(of_beam.pulse()), .cell = {}});
  // East, a side of the cell, lies this far to the left of the axis x.
  const double east = sea.x_azimuth - std::numbers::pi / 2;
  for (std::size_t level = 0; level < of_cell->cell.size(); ++level)
    of_cell->cell[level] = on_map(of_beam.InCell({.side = std::ldexp(cell_, -int(level)), .orientation = east}));
  std::unique_ptr<const SeaInCell> made = std::move(of_cell);
  // Another thread may have made the same one meanwhile.
  const SeaInCell* other = nullptr;
  return known.compare_exchange_strong(other, made.get()) ? *made.release() : *other;
}

}  // namespace albtpu::quality
