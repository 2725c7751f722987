#include "quality/surface/sea_sharing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sea/angle.h"

namespace albtpu::quality {
namespace {

constexpr double kFootprintStep = 0.04;                        // Of its logarithm.
constexpr double kLeastFootprint = 0.01, kMostFootprint = 10;  // m, of BeamCorrelation.

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
  const int width =
      static_cast<int>(std::lround(std::log(std::clamp(footprint, kLeastFootprint, kMostFootprint)) / kFootprintStep));
  const int i = std::min(static_cast<int>(steep), kIncidences - 2);
  const int j = static_cast<int>(std::floor(turned));
  const Key key = {source, width};
  Beams& beams = BeamsOf(key);
  SeaInCell sum;
  for (const int di : {0, 1})
    for (const int dj : {0, 1}) {
      const double weight = std::abs(1 - di - (steep - i)) * std::abs(1 - dj - (turned - j));
      if (weight == 0) continue;
      const int around = ((j + dj) % kAzimuths + kAzimuths) % kAzimuths;
      const SeaInCell& each = At(beams, key, i + di, i + di == 0 ? 0 : around);
      sum.pulse += weight * each.pulse;
      sum.cell += weight * each.cell;
      sum.height_pulse += weight * each.height_pulse;
      sum.height_cell += weight * each.height_cell;
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
  // East, a side of the cell, lies this far to the left of the axis x.
  const SharedWaves pulse = of_beam.pulse();
  const SharedWaves cell = of_beam.InCell({.side = cell_, .orientation = sea.x_azimuth - std::numbers::pi / 2});
  const Eigen::Matrix3d turn = ToMap(sea.x_azimuth);
  auto made = std::make_unique<const SeaInCell>(SeaInCell{.pulse = turn * pulse.errors() * turn.transpose(),
                                                          .cell = turn * cell.errors() * turn.transpose(),
                                                          .height_pulse = pulse.footprint.heights,
                                                          .height_cell = cell.footprint.heights});
  // Another thread may have made the same one meanwhile.
  const SeaInCell* other = nullptr;
  return known.compare_exchange_strong(other, made.get()) ? *made.release() : *other;
}

}  // namespace albtpu::quality
