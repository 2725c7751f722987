#include "tables/query/answer_writer.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace albtpu {
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

AnswerWriter::AnswerWriter(const Query& query, const NodeRecords& records, const AnswerColumns& answers)
    : query_(query),
      records_(records),
      answers_(answers),
      s44_(answers.best_s44_orders != nullptr || answers.remaining_thu != nullptr ||
           answers.remaining_tvu != nullptr) {
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    const bool errors = answers.standard_errors[q] != nullptr && records.has_standard_errors[q];
    if (answers.values[q] == nullptr && !errors) continue;
    const bool is_refraction = PlaceOf(quantity).is_refraction;
    (is_refraction ? needs_.refraction : needs_.displacement) = true;
    if (errors && !is_refraction) needs_.displacement_errors = true;
    if (quantity == Quantity::kThu && query.coverage == Coverage::kP95) needs_.radius = true;
  }
  if (s44_) needs_.radius = true;
  if (needs_.radius) needs_.refraction = needs_.displacement = true;
}

void AnswerWriter::Write(const PulseBlock& block, const BlockValues& numbers) const {
  WriteOutcomes(block);
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    WriteNumbers(block, quantity, records_.has_values[q] ? &numbers.value(quantity) : nullptr,
                 numbers.radius_over_thu(), answers_.values[q]);
    WriteNumbers(block, quantity,
                 records_.has_standard_errors[q] ? &numbers.standard_error(quantity) : nullptr,
                 numbers.radius_over_thu(), answers_.standard_errors[q]);
  }
  if (s44_) WriteS44(block, numbers);
}

void AnswerWriter::WriteOutcomes(const PulseBlock& block) const {
  const auto write = [&](std::uint8_t* column, auto number_of) {
    if (column == nullptr) return;
    column += block.first();
    if (block.all_inside()) {
      std::fill_n(column, block.count(), number_of(outcome_code::kInside));
    } else {
      for (std::size_t i = 0; i < block.count(); ++i) column[i] = number_of(block.codes()[i]);
    }
  };
  write(answers_.outcomes, [](std::int32_t code) { return OneBased(OutcomeOf(code)); });
  write(answers_.outcome_axes, [](std::int32_t code) {
    return code == outcome_code::kInside ? std::uint8_t{0} : OneBased(code % outcome_code::kOutside);
  });
}

void AnswerWriter::WriteNumbers(const PulseBlock& block, Quantity quantity, const BlockOf<float>* numbers,
                                const BlockOf<double>& radius_over_thu, float* column) const {
  if (column == nullptr) return;
  column += block.first();
  const std::size_t count = block.count();
  if (numbers == nullptr) {
    std::fill_n(column, count, kNoNumber);
    return;
  }
  if (query_.coverage == Coverage::kTwoSigma || Describe(quantity).is_bias) {
    std::copy_n(numbers->begin(), count, column);
  } else if (quantity == Quantity::kThu) {
    for (std::size_t i = 0; i < count; ++i)
      column[i] = static_cast<float>((*numbers)[i] * radius_over_thu[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<float>((*numbers)[i] * kFactor95);
  }
  if (block.all_inside()) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (block.codes()[i] != outcome_code::kInside) column[i] = kNoNumber;
  }
}

void AnswerWriter::WriteS44(const PulseBlock& block, const BlockValues& numbers) const {
  for (std::size_t i = 0; i < block.count(); ++i) {
    const std::size_t at = block.first() + i;
    const bool inside = block.codes()[i] == outcome_code::kInside;
    const double depth = block.depth(i);
    const auto thu = static_cast<float>(numbers.value(Quantity::kThu)[i] * numbers.radius_over_thu()[i]);
    const auto tvu = static_cast<float>(numbers.value(Quantity::kTvu)[i] * kFactor95);
    if (answers_.best_s44_orders != nullptr) {
      const std::optional<S44Order> best = inside ? BestOrder(thu, tvu, depth) : std::nullopt;
      answers_.best_s44_orders[at] = best.has_value() ? OneBased(*best) : std::uint8_t{0};
    }
    const bool remains = inside && query_.s44_order.has_value();
    if (answers_.remaining_thu != nullptr) {
      answers_.remaining_thu[at] = remains ? Remaining(ThuLimit(*query_.s44_order, depth), thu) : kNoNumber;
    }
    if (answers_.remaining_tvu != nullptr) {
      answers_.remaining_tvu[at] = remains ? Remaining(TvuLimit(*query_.s44_order, depth), tvu) : kNoNumber;
    }
  }
}

}  // namespace albtpu
