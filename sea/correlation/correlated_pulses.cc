#include "sea/correlation/correlated_pulses.h"

#include "sea/correlation/pulse_correlation.h"

namespace albtpu {

struct CorrelatedPulses::Parts {
  WaveCorrelation sea;
  BeamCorrelation beam;

  Parts(const HarmonicSpectrum& spectrum, const BeamOptions& options, double refractive_index, const WaveMotion& motion)
      : sea(spectrum, motion), beam(sea, options, refractive_index) {}
};

CorrelatedPulses::CorrelatedPulses(const HarmonicSpectrum& sea, const CorrelatedBeam& beam, const WaveMotion& motion)
    : parts_(std::make_unique<const Parts>(
          sea,
          BeamOptions{.incidence = beam.incidence,
                      .azimuth = beam.azimuth,
                      .footprint = beam.footprint,
                      .profile = beam.gaussian ? BeamProfile::kGaussian : BeamProfile::kUniform},
          beam.refractive_index, motion)) {}

CorrelatedPulses::~CorrelatedPulses() = default;
CorrelatedPulses::CorrelatedPulses(CorrelatedPulses&&) noexcept = default;

PulseCorrelation CorrelatedPulses::Between(double x, double y, double later) const {
  return CorrelationOf(parts_->beam.Between({x, y}, later), parts_->beam.pulse());
}

PulseCorrelation CorrelatedPulses::InCell(const SurfaceCell& cell) const {
  return CorrelationOf(parts_->beam.InCell(cell), parts_->beam.pulse());
}

}  // namespace albtpu
