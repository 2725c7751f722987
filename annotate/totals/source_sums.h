// What each source of error contributes to the variance of many pulses, and how much of it rests on assumed numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "budget/air/air_errors.h"

namespace albtpu {
struct AircraftColumns;
}  // namespace albtpu

namespace albtpu::annotate {

// Of the two horizontal axes together, and of the vertical one, m^2 at 1 sigma.
struct AxisVariances {
  double horizontal = 0, vertical = 0;

  void Add(const AxisVariances& other, double weight = 1) {
    horizontal += weight * other.horizontal;
    vertical += weight * other.vertical;
  }
};

// Sources beside those of the air side.
enum class OtherSource : std::uint8_t { kSea, kWater, kDatum, kExtra };
inline constexpr std::array<const char*, 4> kOtherSourceNames = {"sea", "water", "datum", "extra"};

// Sums over pulses, of which samples stand for their neighbours.
struct SourceSums {
  std::uint64_t samples = 0;
  std::array<AxisVariances, kErrorSourceCount + kOtherSourceNames.size()> sources = {};  // kErrorSources, OtherSource.
  // `assumed`: of sources whose standard deviations were assumed. Of the water column all, where one of the numbers of
  // its uncertainty was: an upper limit.
  AxisVariances assumed, total;

  const AxisVariances& operator[](OtherSource source) const {
    return sources[kErrorSourceCount + static_cast<std::size_t>(source)];
  }
  AxisVariances& operator[](OtherSource source) {
    return sources[kErrorSourceCount + static_cast<std::size_t>(source)];
  }
  void Merge(const SourceSums& other);

  // samples, variance_horizontal, variance_vertical (sums over pulses, m^2), assumed (fractions of both), and of each
  // source that contributes its fractions of both.
  nlohmann::ordered_json Json() const;
};

struct PulseBatch;
struct TotalBatch;
struct TotalPlan;

inline constexpr std::size_t kSourceSamples = 32;  // Of a batch.

// The contributions to pulses of a batch after ComputeTotals, which changed `aircraft`: each of `samples` equal parts
// is represented by its first pulse with a total, and the sources of the air side are those of
// budget/air/air_sources.h for it. Where the trajectory states its errors pulse by pulse, the fraction of the batch
// without them counts as assumed.
SourceSums SampleSources(const TotalPlan& plan, const PulseBatch& pulses, const AircraftColumns& aircraft,
                         const TotalBatch& totals, std::size_t samples = kSourceSamples);

}  // namespace albtpu::annotate
