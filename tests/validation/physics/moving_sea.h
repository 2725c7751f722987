// A square piece of a sea that moves, and pulses that are traced through it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "generator/math/random_stream.h"
#include "generator/surface/beam.h"
#include "generator/surface/ray_tracer.h"
#include "generator/surface/sea_surface.h"
#include "sea/correlation/moving_waves.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu {

// Short waves are those of EvolvingPatch; waves longer than a few metres are plane waves, each with its own frequency.
// Immutable.
class MovingSea {
 public:
  static constexpr double kLength = 24;    // m, of a side
  static constexpr double kShortest = 16;  // rad/m: shorter waves are to be cut from the spectrum
  static constexpr int kPoints = 768;      // along a side, 3 cm apart

  MovingSea(const HarmonicSpectrum& spectrum, const WaveMotion& motion);
  ~MovingSea();

  // One realization at each of `times` [s]. The origin is in the middle.
  std::vector<HeightField> Draw(const NormalStream& stream, const std::vector<double>& times) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

// The spectrum with all waves shorter than MovingSea::kShortest taken away, smoothly.
HarmonicSpectrum WithoutShortWaves(HarmonicSpectrum spectrum);

// What the waves do to one pulse: the error (x, y, z) of its reported point over a level bottom per metre of depth, and
// the mean height of the water where its rays meet it, m.
using TracedPulse = Eigen::Vector4d;

// Traces pulses of one beam. Immutable.
class PulseTracer {
 public:
  PulseTracer(const BeamOptions& beam, double refractive_index, int rays);

  // The pulse whose axis meets the mean surface at `at`.
  TracedPulse operator()(const HeightField& surface, const Eigen::Vector2d& at) const;

 private:
  std::vector<Ray> rays_;
  double refractive_index_;
  Eigen::Vector2d along_;
  double refracted_;
};

}  // namespace albtpu
