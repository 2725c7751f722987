#include "tables/query/answer_writer.h"

#include <algorithm>
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

void WriteOutcomes(const PulseBlock& block, std::uint8_t* outcomes, std::uint8_t* outcome_axes) {
  const auto write = [&](std::uint8_t* column, auto number_of) {
    if (column == nullptr) return;
    column += block.first();
    if (block.all_inside()) {
      std::fill_n(column, block.count(), number_of(outcome_code::kInside));
    } else {
      for (std::size_t i = 0; i < block.count(); ++i) column[i] = number_of(block.codes()[i]);
    }
  };
  write(outcomes, [](std::int32_t code) { return OneBased(OutcomeOf(code)); });
  write(outcome_axes, [](std::int32_t code) {
    return code == outcome_code::kInside ? std::uint8_t{0} : OneBased(code % outcome_code::kOutside);
  });
}

void ClearOutside(const PulseBlock& block, float* column) {
  if (block.all_inside()) return;
  for (std::size_t i = 0; i < block.count(); ++i) {
    if (block.codes()[i] != outcome_code::kInside) column[i] = kNoNumber;
  }
}

AnswerWriter::AnswerWriter(const Query& query, const NodeRecords& records, const AnswerColumns& answers)
    : query_(query),
      records_(records),
      answers_(answers),
      s44_(answers.best_s44_orders != nullptr || answers.remaining_thu != nullptr ||
           answers.remaining_tvu != nullptr) {
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    const bool error = answers.standard_errors[q] != nullptr && records.has_standard_errors[q];
    if (answers.values[q] != nullptr) needs_.AddValue(records, q);
    if (error) needs_.AddStandardError(records, q);
    if (quantity == Quantity::kThu && (answers.values[q] != nullptr || error)) {
      needs_radius_ = query.coverage == Coverage::kP95;
    }
  }
  if (s44_) needs_radius_ = true;
  if (!needs_radius_) return;
  for (const Quantity quantity :
       {Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind, Quantity::kThu, Quantity::kTvu}) {
    needs_.AddValue(records, Index(quantity));
  }
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
  if (query_.coverage == Coverage::kTwoSigma || Describe(quantity).is_bias) {
    std::copy_n(numbers->begin(), count, column);
  } else if (query_.coverage == Coverage::kOneSigma) {
    for (std::size_t i = 0; i < count; ++i) column[i] = (*numbers)[i] / 2;
  } else if (quantity == Quantity::kThu) {
    for (std::size_t i = 0; i < count; ++i)
      column[i] = static_cast<float>((*numbers)[i] * radius_over_thu_[i]);
  } else {
    for (std::size_t i = 0; i < count; ++i) column[i] = static_cast<float>((*numbers)[i] * kFactor95);
  }
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
    if (answers_.remaining_thu != nullptr) {
      answers_.remaining_thu[at] = remains ? Remaining(ThuLimit(*query_.s44_order, depth), thu) : kNoNumber;
    }
    if (answers_.remaining_tvu != nullptr) {
      answers_.remaining_tvu[at] = remains ? Remaining(TvuLimit(*query_.s44_order, depth), tvu) : kNoNumber;
    }
  }
}

}  // namespace albtpu
