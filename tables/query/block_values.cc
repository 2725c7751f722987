#include "tables/query/block_values.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace albtpu {
namespace {

// The number of records in a batch. All lanes of a batch are filled before the next one, while it is in the cache.
constexpr std::size_t kPutTogether = 1024;

void Put(const std::vector<float>& numbers, std::size_t first, std::size_t lane, bool as_logarithms, Records& records) {
  const std::size_t end = std::min(first + kPutTogether, numbers.size());
  for (std::size_t i = first; i < end; ++i) {
    const double number = numbers[i];
    records[i * kRecordSize + lane] = static_cast<float>(as_logarithms ? std::log(number) : number);
  }
}

// Chooses the places of `quantities`, which are all over the last axis or all not. Returns the number of sets in use
// afterwards.
std::size_t Place(const std::vector<std::size_t>& quantities, bool any_standard_errors, std::size_t first_set,
                  NodeRecords& records) {
  const std::size_t count = quantities.size();
  const std::size_t value_sets = (count + kRecordSize - 1) / kRecordSize;
  const bool together = count <= kRecordSize / 2;
  for (std::size_t i = 0; i < count; ++i) {
    records.values[quantities[i]] = {first_set + i / kRecordSize, i % kRecordSize};
    records.standard_errors[quantities[i]] =
        together ? RecordPlace{first_set, i + kRecordSize / 2}
                 : RecordPlace{first_set + value_sets + i / kRecordSize, i % kRecordSize};
  }
  return first_set + (together || !any_standard_errors ? value_sets : 2 * value_sets);
}

}  // namespace

NodeRecords::NodeRecords(const Table& table) : quantity_count(table.schema().quantities.size()) {
  const auto& quantities = table.schema().quantities;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const Variable* variable = table.variable(q);
    has_values[q] = variable != nullptr;
    has_standard_errors[q] = variable != nullptr && !variable->standard_errors.empty();
    is_log[q] = variable != nullptr && variable->scale == Scale::kLog;
  }
  for (const bool over_last_axis : {false, true}) {
    std::vector<std::size_t> members;
    bool any_errors = false;
    for (std::size_t q = 0; q < quantity_count; ++q) {
      if (quantities[q].over_last_axis != over_last_axis) continue;
      members.push_back(q);
      any_errors = any_errors || has_standard_errors[q];
    }
    if (members.empty()) continue;
    const std::size_t first = sets.size(), last = Place(members, any_errors, first, *this);
    const std::size_t count = ValueCount(table.axes(), quantities[members[0]]);
    const std::size_t size = (count + 1) * kRecordSize;
    for (std::size_t set = first; set < last; ++set) sets.push_back({over_last_axis, Records(size), {}});
    for (const std::size_t q : members)
      if (is_log[q]) sets[values[q].set].plain.resize(size);
    tbb::parallel_for(std::size_t{0}, count, kPutTogether, [&](std::size_t record) {
      for (const std::size_t q : members) PutAll(table, q, record);
    });
  }
  assert(sets.size() <= kMaxSets);
}

void NodeRecords::PutAll(const Table& table, std::size_t q, std::size_t first) {
  if (!has_values[q]) return;
  const Variable& variable = *table.variable(q);
  Set& set = sets[values[q].set];
  Put(variable.values, first, values[q].lane, is_log[q], set.numbers);
  if (is_log[q]) Put(variable.values, first, values[q].lane, false, set.plain);
  if (!has_standard_errors[q]) return;
  Put(variable.standard_errors, first, standard_errors[q].lane, false, sets[standard_errors[q].set].numbers);
}

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
  for (std::size_t slot = 0; slot < BlendedPulses::kSlotCount; ++slot)
    if (!step(pulses.fractions[slot], pulses.steps[slot])) return -1;
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
      for (std::size_t i = 0; i < count; ++i)
        errors[i] = std::abs(others[i]) > std::abs(values[i]) ? other_errors[i] : errors[i];
    }
    for (std::size_t i = 0; i < count; ++i)
      values[i] = std::abs(others[i]) > std::abs(values[i]) ? others[i] : values[i];
  }
}

namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

template <typename Number>
std::uint8_t OneBased(Number number) {
  return static_cast<std::uint8_t>(static_cast<int>(number) + 1);
}

Outcome OutcomeOf(std::int32_t code) {
  if (code == outcome_code::kInside) return Outcome::kInterpolated;
  return code >= outcome_code::kOutside ? Outcome::kOutOfDomain : Outcome::kInvalid;
}

float Remaining(double limit, double ours) {
  const std::optional<double> remaining = RemainingBudget(limit, ours);
  return remaining.has_value() ? static_cast<float>(*remaining) : kNoNumber;
}

}  // namespace

void WriteOutcomes(const PulseBlock& block, std::uint8_t* outcomes, std::uint8_t* outcome_axes) {
  const auto write = [&](std::uint8_t* column, auto number_of) {
    if (column == nullptr) return;
    column += block.first();
    if (block.all_inside())
      std::fill_n(column, block.count(), number_of(outcome_code::kInside));
    else
      for (std::size_t i = 0; i < block.count(); ++i) column[i] = number_of(block.codes()[i]);
  };
  write(outcomes, [](std::int32_t code) { return OneBased(OutcomeOf(code)); });
  write(outcome_axes, [](std::int32_t code) {
    return code == outcome_code::kInside ? std::uint8_t{0} : OneBased(code % outcome_code::kOutside);
  });
}

void ClearOutside(const PulseBlock& block, float* column) {
  if (block.all_inside()) return;
  for (std::size_t i = 0; i < block.count(); ++i)
    if (block.codes()[i] != outcome_code::kInside) column[i] = kNoNumber;
}

AnswerWriter::AnswerWriter(const Query& query, const NodeRecords& records, const AnswerColumns& answers)
    : query_(query),
      records_(records),
      answers_(answers),
      s44_(answers.best_s44_orders != nullptr || answers.remaining_thu != nullptr || answers.remaining_tvu != nullptr) {
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    const bool error = answers.standard_errors[q] != nullptr && records.has_standard_errors[q];
    if (answers.values[q] != nullptr) needs_.AddValue(records, q);
    if (error) needs_.AddStandardError(records, q);
    if (quantity == Quantity::kThu && (answers.values[q] != nullptr || error))
      needs_radius_ = query.coverage == Coverage::kP95;
  }
  if (s44_) needs_radius_ = true;
  if (!needs_radius_) return;
  for (const Quantity quantity :
       {Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind, Quantity::kThu, Quantity::kTvu})
    needs_.AddValue(records, Index(quantity));
}

void AnswerWriter::Take(const PulseBlock& block, BlockValues& values) {
  if (needs_radius_) TakeRadius(block, values);
  values.TakeLarger(block);
}

void AnswerWriter::TakeRadius(const PulseBlock& block, const BlockValues& values) {
  constexpr std::size_t kAlong = Index(Quantity::kRefractionAlongWind);
  constexpr std::size_t kCross = Index(Quantity::kRefractionCrossWind);
  constexpr std::size_t kThu = Index(Quantity::kThu);
  if (block.alternative() == 0) {
    const BlockOf<float>&along = values.value(kAlong), &cross = values.value(kCross);
    for (std::size_t i = 0; i < block.count(); ++i) radius_over_thu_[i] = RadiusOverThu({along[i], cross[i]});
    return;
  }
  const BlockOf<float>&along = values.later_value(kAlong), &cross = values.later_value(kCross);
  const BlockOf<float>&thu = values.value(kThu), &later_thu = values.later_value(kThu);
  for (std::size_t i = 0; i < block.count(); ++i) {  // As LargerOf (interpolation.h).
    radius_over_thu_[i] =
        LargerRadiusOverThu(thu[i], radius_over_thu_[i], later_thu[i], RadiusOverThu({along[i], cross[i]}));
  }
}

void AnswerWriter::Write(const PulseBlock& block, const BlockValues& values) const {
  WriteOutcomes(block, answers_.outcomes, answers_.outcome_axes);
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    WriteNumbers(block, quantity, records_.has_values[q] ? &values.value(q) : nullptr, answers_.values[q]);
    WriteNumbers(block, quantity, records_.has_standard_errors[q] ? &values.standard_error(q) : nullptr,
                 answers_.standard_errors[q]);
  }
  if (s44_) WriteS44(block, values);
}

void AnswerWriter::WriteNumbers(const PulseBlock& block, Quantity quantity, const BlockOf<float>* numbers,
                                float* column) const {
  if (column == nullptr) return;
  column += block.first();
  const std::size_t count = block.count();
  if (numbers == nullptr) {
    std::fill_n(column, count, kNoNumber);
    return;
  }
  if (query_.coverage == Coverage::kTwoSigma || Describe(quantity).is_bias)
    std::copy_n(numbers->begin(), count, column);
  else if (query_.coverage == Coverage::kOneSigma)
    for (std::size_t i = 0; i < count; ++i) column[i] = (*numbers)[i] / 2;
  else if (quantity == Quantity::kThu)
    for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<float>((*numbers)[i] * radius_over_thu_[i]);
  else
    for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<float>((*numbers)[i] * kFactor95);
  ClearOutside(block, column);
}

void AnswerWriter::WriteS44(const PulseBlock& block, const BlockValues& values) const {
  const BlockOf<float>& thus = values.value(Index(Quantity::kThu));
  const BlockOf<float>& tvus = values.value(Index(Quantity::kTvu));
  for (std::size_t i = 0; i < block.count(); ++i) {
    const std::size_t at = block.first() + i;
    const bool inside = block.codes()[i] == outcome_code::kInside;
    const double depth = block.coordinate(Index(AxisId::kDepth), i);
    const auto thu = static_cast<float>(thus[i] * radius_over_thu_[i]);
    const auto tvu = static_cast<float>(tvus[i] * kFactor95);
    if (answers_.best_s44_orders != nullptr) {
      const std::optional<S44Order> best = inside ? BestOrder(thu, tvu, depth) : std::nullopt;
      answers_.best_s44_orders[at] = best.has_value() ? OneBased(*best) : std::uint8_t{0};
    }
    const bool remains = inside && query_.s44_order.has_value();
    if (answers_.remaining_thu != nullptr)
      answers_.remaining_thu[at] = remains ? Remaining(ThuLimit(*query_.s44_order, depth), thu) : kNoNumber;
    if (answers_.remaining_tvu != nullptr)
      answers_.remaining_tvu[at] = remains ? Remaining(TvuLimit(*query_.s44_order, depth), tvu) : kNoNumber;
  }
}

}  // namespace albtpu
