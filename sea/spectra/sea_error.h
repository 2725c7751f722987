// How well a described sea is known: what one measurement of a random sea leaves open, and what the tail leaves open.
#pragma once

#include <functional>

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

}  // namespace albtpu
