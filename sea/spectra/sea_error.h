// The uncertainty of a described sea: the sampling error of its measurement, and the uncertainty of its tail.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sea/spectra/described_sea.h"

namespace albtpu {

// Relative standard errors of V, the integral of weight(k) k^2 S(k) dk. Those of slopes, and of what is in proportion
// to them, are half.
struct SeaError {
  double sampling = 0;  // sqrt(sum over bins of (2 / nu) v^2) / V; 0 for waves that were not measured
  double tail = 0;      // half the difference between the tail rules `wind` and `level`; 0 without tail
  double total = 0;     // the root of the sum of squares
};

// A bin of width B, measured over `record_length` [s], has nu = 2 B record_length degrees of freedom. Infinity means a
// model, whose spectra are expectations. Waves that are not a BinnedSpectrum have no sampling error.
SeaError ErrorOfSea(const SeaDescription& description, double record_length,
                    const std::function<double(double k)>& weight);

// The errors of one sea for many weights. Immutable.
class SeaErrors {
 public:
  SeaErrors(const SeaDescription& description, double record_length);

  SeaError operator()(const std::function<double(double k)>& weight) const;

 private:
  // What a bin adds to V without weight, and 2 / nu.
  struct Bin {
    double k, slope_variance, relative_variance;
  };

  HarmonicSpectrum spectrum_;
  std::vector<Bin> bins_;
  std::optional<HarmonicSpectrum> with_wind_tail_, with_level_tail_;
};

}  // namespace albtpu
