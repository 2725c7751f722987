// Any sea in samples of wavenumber as a spectrum from which waves can be drawn, with a spreading that is nowhere
// negative.
#pragma once

#include <string>
#include <vector>

#include "sea/spectra/harmonic_spectrum.h"
#include "sea/spectra/wave_spectrum.h"

namespace albtpu {

// A spreading of waves with given even harmonics that is nowhere negative.

// D(psi) [1/rad], equal for psi and psi + pi; its integral over a full turn is 1. Immutable.
//
// The means of cos(2 n psi) and sin(2 n psi), n from 1, are `a[n - 1]` and `b[n - 1]`. Their Fourier series
//     (1 + 2 sum of (a_n cos(2 n psi) + b_n sin(2 n psi))) / (2 pi)
// is taken if it is nowhere negative. Instruments and truncated series may give harmonics of which it is: then it is
// the density of maximum entropy with these harmonics, the exponential of a series of as many terms (Lygre and Krogstad
// (1986), doi:10.1175/1520-0485(1986)016<2052:MEEOTD>2.0.CO;2), and harmonics at the end that are 0 count as not known.
// Harmonics that only a beam of waves narrower than some 4 degrees or no density has are met in part.
class PositiveSpreading {
 public:
  PositiveSpreading(const std::vector<double>& a, const std::vector<double>& b);  // as many, at least one

  double operator()(double psi) const;

 private:
  bool exponential_ = false;
  double constant_ = 1;
  std::vector<double> cosine_, sine_;  // of the series, or of that in the exponent
};

// The description of the sea that a table records.
struct SpectrumText {
  std::string name, reference, departures;
};

// Between the samples, k^3 S(k) and k^3 S(k) D(k, psi) are interpolated linearly in ln k, so that the even harmonics up
// to the last one are those of the samples. (Between samples 5 % apart, S that is linear in k would add 0.25 % to the
// slope variance of waves that fall as k^-3.) The spreading is that of a frozen surface, the same for waves that travel
// opposite ways, and nowhere negative (PositiveSpreading). Immutable.
class SampledSpectrum final : public WaveSpectrum {
 public:
  SampledSpectrum(const HarmonicSpectrum& spectrum, SpectrumText text);

  double operator()(double k) const override;
  double Spreading(double k, double psi) const override;
  bool spreading_varies_with_wavenumber() const override { return true; }
  double peak_wavenumber() const override;  // where k S(k) has its maximum
  WavenumberRange energetic_range() const override { return range_; }
  std::string name() const override { return text_.name; }
  std::string reference() const override { return text_.reference; }
  std::string departures() const override { return text_.departures; }

 private:
  // The parts of the samples `at` and `at` + 1 in k^3 S(k); zeros outside the samples.
  struct Between {
    std::size_t at;
    double first, second;
  };
  Between Find(double k) const;

  std::vector<double> log_k_;
  std::vector<double> saturation_;  // k^3 S(k)
  std::vector<PositiveSpreading> spreading_;
  WavenumberRange range_;
  SpectrumText text_;
};

}  // namespace albtpu
