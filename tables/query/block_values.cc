#include "tables/query/block_values.h"

#include <cmath>

namespace albtpu {
namespace {

// Copies the numbers of consecutive records into columns.
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

// The record of the node that a pulse is on; negative if it is not on a node.
std::ptrdiff_t NodeOf(const BlendedPulses& pulses, std::size_t i) {
  std::ptrdiff_t node = pulses.first + pulses.rows[i];
  const auto step = [&](const float* fractions, std::ptrdiff_t step_of_axis) {
    if (fractions == nullptr || fractions[i] == 0) return true;
    node += step_of_axis;
    return fractions[i] == 1;
  };
  for (std::size_t slot = 0; slot < BlendedPulses::kSlotCount; ++slot) {
    if (!step(pulses.fractions[slot], pulses.steps[slot])) return -1;
  }
  return step(pulses.innermost, 1) ? node : -1;
}

}  // namespace

void BlockValues::Find(const PulseBlock& block) {
  Columns& columns = block.alternative() == 0 ? largest_ : later_;
  for (std::size_t set = 0; set < records_.sets.size(); ++set) {
    if (!needs_.sets[set]) continue;
    const BlendedPulses& pulses = block.blended(records_.sets[set].over_last_axis);
    Blend(records_.sets[set].numbers.data(), pulses, blended_->begin());
    Split(blended_->begin(), pulses.count, columns[set].data());
    if (!records_.sets[set].plain.empty()) TakeExponentials(pulses, set, columns);
  }
}

// On a node, the value is the one in the table: the exponential of its rounded logarithm would differ.
void BlockValues::TakeExponentials(const BlendedPulses& pulses, std::size_t set, Columns& columns) const {
  const Records& plain = records_.sets[set].plain;
  for (std::size_t q = 0; q < records_.quantity_count; ++q) {
    const RecordPlace& place = records_.values[q];
    if (!records_.is_log[q] || place.set != set) continue;
    BlockOf<float>& column = columns[set][place.lane];
    for (std::size_t i = 0; i < pulses.count; ++i) {
      const std::ptrdiff_t node = NodeOf(pulses, i);
      column[i] = node < 0 ? std::exp(column[i]) : plain[node * kRecordSize + place.lane];
    }
  }
}

void BlockValues::TakeLarger(const PulseBlock& block) {
  if (block.alternative() == 0) return;
  const std::size_t count = block.count();
  for (std::size_t q = 0; q < records_.quantity_count; ++q) {
    const RecordPlace &value = records_.values[q], &error = records_.standard_errors[q];
    if (!records_.has_values[q] || !needs_.sets[value.set]) continue;
    BlockOf<float>& values = largest_[value.set][value.lane];
    const BlockOf<float>& others = later_[value.set][value.lane];
    if (records_.has_standard_errors[q] && needs_.sets[error.set]) {
      BlockOf<float>& errors = largest_[error.set][error.lane];
      const BlockOf<float>& other_errors = later_[error.set][error.lane];
      for (std::size_t i = 0; i < count; ++i) {
        errors[i] = std::abs(others[i]) > std::abs(values[i]) ? other_errors[i] : errors[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      values[i] = std::abs(others[i]) > std::abs(values[i]) ? others[i] : values[i];
    }
  }
}

}  // namespace albtpu
