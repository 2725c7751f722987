// What neighbouring pulses share of a sea: the correlation of the sea's share in their errors, from the spectrum alone.
//
// Waves longer than the distance of two pulses tilt the water under both. The share of the sea in the mean of n pulses
// of a cell therefore does not fall to 1 / n of that of one pulse. With R the mean of the correlation over all pairs of
// points of the cell,
//     var(mean) = var (R + (1 - R) / n).
// docs/surface.md derives it. For example, the depth of a node of 1 m with ten pulses, over a sea of 6 m/s:
//     const DescribedSea sea = Describe({.wind_speed_10m = 6, .wind_from = 0});
//     const CorrelatedPulses pulses(sea.spectrum, {.incidence = 0.35, .footprint = 0.6});
//     const double r = pulses.InCell({.side = 1}).vertical;
//     const double sigma_of_node = sigma_of_pulse * std::sqrt(MeanOfPulses(r, 10));
#pragma once

#include <memory>

#include "sea/correlation/correlation.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "sea/water_index.h"

namespace albtpu {

// A collimated beam, the same for all pulses.
struct CorrelatedBeam {
  double incidence = 0;   // rad from the vertical, in air, 0 to 30 degrees
  double azimuth = 0;     // rad from x, of the horizontal direction of travel
  double footprint = 0;   // m, diameter at the mean surface, across the axis, 0.01 to 10
  bool gaussian = false;  // `footprint` is then the diameter at 1/e^2 of the irradiance
  double refractive_index = kSeaWaterIndex;
};

// The pulses of one beam over one sea. Immutable.
class CorrelatedPulses {
 public:
  CorrelatedPulses(const HarmonicSpectrum& sea, const CorrelatedBeam& beam, const WaveMotion& motion = {});
  ~CorrelatedPulses();
  CorrelatedPulses(CorrelatedPulses&&) noexcept;

  // Of two pulses whose footprints lie (x, y) [m, at most 60] apart on the water, the second one `later` [s].
  PulseCorrelation Between(double x, double y, double later) const;

  // R of the mean over a cell.
  PulseCorrelation InCell(const SurfaceCell& cell) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace albtpu
