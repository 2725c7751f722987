#include "tables/query/block_values.h"

#include <cmath>

#include "tables/coverage.h"

namespace albtpu {
namespace {

// From records to columns.
void Split(const float* __restrict records, std::size_t count, BlockOf<float>* columns) {
  static_assert(kRecordSize == 4);
  float* __restrict a = columns[0].begin();
  float* __restrict b = columns[1].begin();
  float* __restrict c = columns[2].begin();
  float* __restrict d = columns[3].begin();
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = records[i * kRecordSize];
    b[i] = records[i * kRecordSize + 1];
    c[i] = records[i * kRecordSize + 2];
    d[i] = records[i * kRecordSize + 3];
  }
}

// The record of the node that a pulse is on; negative if it is on none.
std::ptrdiff_t NodeOf(const BlendedPulses& pulses, std::size_t i) {
  std::ptrdiff_t node = pulses.first + pulses.rows[i];
  const auto step = [&](const float* fractions, std::ptrdiff_t step_of_axis) {
    if (fractions == nullptr || fractions[i] == 0) return true;
    node += step_of_axis;
    return fractions[i] == 1;
  };
  for (std::size_t outer = 0; outer < BlendedPulses::kOuterCount; ++outer) {
    if (!step(pulses.fractions[outer], pulses.steps[outer])) return -1;
  }
  return step(pulses.last, 1) ? node : -1;
}

}  // namespace

const BlockOf<float>& BlockValues::AtOneAzimuth::value(Quantity quantity) const {
  const RecordPlace place = PlaceOf(quantity);
  return (place.is_refraction ? refraction : displacement)[place.value];
}

const BlockOf<float>& BlockValues::AtOneAzimuth::standard_error(Quantity quantity) const {
  const RecordPlace place = PlaceOf(quantity);
  return (place.is_refraction ? refraction : displacement_errors)[place.standard_error];
}

void BlockValues::Find(const PulseBlock& block) {
  Find(block, Side::kDownwind, downwind_);
  if (!block.azimuth_absent()) return;
  Find(block, Side::kCrosswind, crosswind_);
  TakeLarger(block.count());
}

void BlockValues::Find(const PulseBlock& block, Side side, AtOneAzimuth& numbers) {
  const auto blend = [&](const Records& records, const BlendedPulses& pulses, BlockOf<float>* columns) {
    Blend(records.data(), pulses, blended_->begin());
    Split(blended_->begin(), pulses.count, columns);
  };
  if (needs_.refraction) {
    const BlendedPulses pulses = block.WithoutDepth(side);
    blend(records_.refraction, pulses, numbers.refraction);
    TakeExponentials(pulses, true, numbers);
  }
  const BlendedPulses pulses = block.WithDepth(side);
  if (needs_.displacement) {
    blend(records_.displacement, pulses, numbers.displacement);
    TakeExponentials(pulses, false, numbers);
  }
  if (needs_.displacement_errors) blend(records_.displacement_errors, pulses, numbers.displacement_errors);
  if (!needs_.radius) return;
  for (std::size_t i = 0; i < pulses.count; ++i) {
    numbers.radius_over_thu[i] = RadiusOverThu({numbers.refraction[0][i], numbers.refraction[1][i]});
  }
}

// On a node the number is what the table holds, which no exponential gives back.
void BlockValues::TakeExponentials(const BlendedPulses& pulses, bool refraction,
                                   AtOneAzimuth& numbers) const {
  const Records& plain = refraction ? records_.plain_refraction : records_.plain_displacement;
  for (Quantity quantity : kQuantities) {
    const RecordPlace place = PlaceOf(quantity);
    if (!records_.is_log[Index(quantity)] || place.is_refraction != refraction) continue;
    BlockOf<float>& column = (refraction ? numbers.refraction : numbers.displacement)[place.value];
    for (std::size_t i = 0; i < pulses.count; ++i) {
      const std::ptrdiff_t node = NodeOf(pulses, i);
      column[i] = node < 0 ? std::exp(column[i]) : plain[node * kRecordSize + place.value];
    }
  }
}

// As LargerOf (interpolation.h).
void BlockValues::TakeLarger(std::size_t count) {
  if (needs_.radius) {
    const BlockOf<float>&thu = downwind_.value(Quantity::kThu), &other = crosswind_.value(Quantity::kThu);
    BlockOf<double>& radius = downwind_.radius_over_thu;
    for (std::size_t i = 0; i < count; ++i) {
      radius[i] = LargerRadiusOverThu(thu[i], radius[i], other[i], crosswind_.radius_over_thu[i]);
    }
  }
  // Values and, if there are any, their standard errors.
  const auto take_larger = [count](BlockOf<float>* values, const BlockOf<float>* others,
                                   std::size_t quantities, BlockOf<float>* errors,
                                   const BlockOf<float>* other_errors) {
    for (std::size_t q = 0; q < quantities; ++q) {
      for (std::size_t i = 0; i < count; ++i) {
        const bool larger = std::abs(others[q][i]) > std::abs(values[q][i]);
        if (errors != nullptr) errors[q][i] = larger ? other_errors[q][i] : errors[q][i];
        values[q][i] = larger ? others[q][i] : values[q][i];
      }
    }
  };
  AtOneAzimuth &a = downwind_, &b = crosswind_;
  constexpr std::size_t kRefractions = 2;
  if (needs_.refraction) {
    take_larger(a.refraction, b.refraction, kRefractions, a.refraction + kRefractions,
                b.refraction + kRefractions);
  }
  if (needs_.displacement) {
    const bool errors = needs_.displacement_errors;
    take_larger(a.displacement, b.displacement, kRecordSize, errors ? a.displacement_errors : nullptr,
                b.displacement_errors);
  }
}

}  // namespace albtpu
