#include "tables/query/table_interpolation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "tables/query/answer_writer.h"
#include "tables/query/larger_answer.h"
#include "tables/query/table_layout.h"

namespace albtpu {
namespace {

using Brackets = std::array<Bracket, kMaxAxes>;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

TableValues WithoutNumbers(Outcome outcome, std::optional<std::size_t> axis) {
  TableValues values;
  values.outcome = outcome;
  values.axis = axis;
  values.values.fill(kNoNumber);
  values.standard_errors.fill(kNoNumber);
  return values;
}

bool IsValid(const AxisSchema& axis, double coordinate) {
  return std::isfinite(coordinate) || (axis.is_endless && coordinate > 0);
}

// The nodes around a pulse that have weight, each as an index into a variable and a weight; the weights add up to
// 1. For a pulse on a node there is that node alone, so that the answer is exactly the value in the table.
class Corners {
 public:
  // Over the first `axis_count` axes of the table.
  Corners(const Table& table, const Brackets& brackets, std::size_t axis_count) {
    corners_[0] = {0, 1.0};
    for (std::size_t axis = 0; axis < axis_count; ++axis) Split(brackets[axis], table.axes()[axis].size());
  }

  // The weighted mean of `f` over the values at the corners.
  template <typename Function>
  double Mean(const std::vector<float>& values, Function f) const {
    double mean = 0;
    for (std::size_t i = 0; i < count_; ++i) mean += corners_[i].weight * f(values[corners_[i].index]);
    return mean;
  }

  double Mean(const std::vector<float>& values) const {
    return Mean(values, [](double value) { return value; });
  }

 private:
  struct Corner {
    std::size_t index;
    double weight;
  };

  void Split(const Bracket& bracket, std::size_t node_count) {
    const std::size_t before = count_;
    for (std::size_t i = 0; i < before; ++i) {
      Corner& corner = corners_[i];
      const std::size_t lower = corner.index * node_count + bracket.lower;
      const double weight = corner.weight;
      if (bracket.fraction == 1) {
        corner = {lower + 1, weight};
        continue;
      }
      corner = {lower, weight * (1 - bracket.fraction)};
      if (bracket.fraction > 0) corners_[count_++] = {lower + 1, weight * bracket.fraction};
    }
  }

  std::array<Corner, std::size_t{1} << kMaxAxes> corners_;
  std::size_t count_ = 1;
};

double InterpolateValue(const Variable& variable, const Corners& corners) {
  if (variable.scale == Scale::kLinear) return corners.Mean(variable.values);
  return std::exp(corners.Mean(variable.values, [](double value) { return std::log(value); }));
}

// Writes the numbers of a block as they are.
class ValueWriter {
 public:
  ValueWriter(const NodeRecords& records, const ValueColumns& answers)
      : records_(records), answers_(answers) {
    for (std::size_t q = 0; q < records.quantity_count; ++q) {
      if (answers.values[q] != nullptr) needs_.AddValue(records, q);
      if (answers.standard_errors[q] != nullptr && records.has_standard_errors[q])
        needs_.AddStandardError(records, q);
    }
  }

  const Needs& needs() const { return needs_; }

  void Take(const PulseBlock& block, BlockValues& values) const { values.TakeLarger(block); }

  void Write(const PulseBlock& block, const BlockValues& values) const {
    WriteOutcomes(block, answers_.outcomes, answers_.outcome_axes);
    for (std::size_t q = 0; q < records_.quantity_count; ++q) {
      Write(block, records_.has_values[q] ? &values.value(q) : nullptr, answers_.values[q]);
      Write(block, records_.has_standard_errors[q] ? &values.standard_error(q) : nullptr,
            answers_.standard_errors[q]);
    }
  }

 private:
  // `numbers` is null if the table has none.
  static void Write(const PulseBlock& block, const BlockOf<float>* numbers, float* column) {
    if (column == nullptr) return;
    column += block.first();
    if (numbers == nullptr) {
      std::fill_n(column, block.count(), kNoNumber);
      return;
    }
    std::copy_n(numbers->begin(), block.count(), column);
    ClearOutside(block, column);
  }

  const NodeRecords& records_;
  const ValueColumns& answers_;
  Needs needs_;
};

// Whether only columns of quantities of the schema are wanted: the others would not be written.
[[maybe_unused]] bool AreOfSchema(const ValueColumns& answers, const TableSchema& schema) {
  for (std::size_t q = schema.quantities.size(); q < kMaxQuantities; ++q) {
    if (answers.values[q] != nullptr || answers.standard_errors[q] != nullptr) return false;
  }
  return true;
}

}  // namespace

TableValues InterpolateAt(const Table& table, std::span<const double> coordinates) {
  const Table::Axes& axes = table.axes();
  assert(coordinates.size() == axes.size());
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (!IsValid(axes[axis].schema(), coordinates[axis])) return WithoutNumbers(Outcome::kInvalid, axis);
  }
  Brackets brackets;
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const std::optional<Bracket> bracket = axes[axis].Locate(coordinates[axis]);
    if (!bracket.has_value()) {
      TableValues outside = WithoutNumbers(Outcome::kOutOfDomain, axis);
      outside.side = SideOf(axes[axis].schema(), axes[axis].nodes().back(), coordinates[axis]);
      return outside;
    }
    brackets[axis] = *bracket;
  }

  const Corners without_last(table, brackets, axes.size() - 1);
  const Corners with_last(table, brackets, axes.size());
  TableValues answer = WithoutNumbers(Outcome::kInterpolated, std::nullopt);
  for (std::size_t q = 0; q < table.schema().quantities.size(); ++q) {
    const Variable* variable = table.variable(q);
    if (variable == nullptr) continue;
    const Corners& corners = table.schema().quantities[q].over_last_axis ? with_last : without_last;
    answer.values[q] = static_cast<float>(InterpolateValue(*variable, corners));
    if (variable->standard_errors.empty()) continue;
    answer.standard_errors[q] = static_cast<float>(corners.Mean(variable->standard_errors));
  }
  return answer;
}

TableValues Interpolate(const Table& table, std::span<const std::optional<float>> coordinates) {
  assert(coordinates.size() == table.axes().size());
  std::array<double, kMaxAxes> at;
  std::optional<std::size_t> with_alternatives;
  for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
    at[axis] = coordinates[axis].value_or(kNoNumber);
    if (coordinates[axis].has_value()) continue;
    const IfAbsent rule = table.schema().axes[axis].if_absent;
    if (rule == IfAbsent::kLastNode) at[axis] = table.axes()[axis].nodes().back();
    if (TakesLargest(rule)) with_alternatives = axis;
  }
  const std::span<const double> all(at.data(), table.axes().size());
  if (!with_alternatives.has_value()) return InterpolateAt(table, all);
  std::optional<TableValues> largest;
  for (const double alternative : table.axes()[*with_alternatives].alternatives()) {
    at[*with_alternatives] = alternative;
    const TableValues answer = InterpolateAt(table, all);
    largest = largest.has_value() ? LargerAnswer(*largest, answer) : answer;
  }
  return *largest;
}

struct TableInterpolator::Layout : TableLayout {
  using TableLayout::TableLayout;
};

TableInterpolator::TableInterpolator(const Table& table) : layout_(std::make_unique<const Layout>(table)) {}
TableInterpolator::~TableInterpolator() = default;
TableInterpolator::TableInterpolator(TableInterpolator&&) noexcept = default;
TableInterpolator& TableInterpolator::operator=(TableInterpolator&&) noexcept = default;

template <typename Visit>
void ForEachColumn(const ValueColumns& wanted, ValueColumns& other, const Visit& visit) {
  const auto visit_if_wanted = [&](auto* column, auto*& same) {
    if (column != nullptr) visit(column, same);
  };
  for (std::size_t q = 0; q < kMaxQuantities; ++q) {
    visit_if_wanted(wanted.values[q], other.values[q]);
    visit_if_wanted(wanted.standard_errors[q], other.standard_errors[q]);
  }
  visit_if_wanted(wanted.outcomes, other.outcomes);
  visit_if_wanted(wanted.outcome_axes, other.outcome_axes);
}

void TableInterpolator::Interpolate(const PulseColumns& pulses, std::size_t begin, std::size_t end,
                                    const ValueColumns& answers) const {
  assert(CheckLengths(layout_->schema, pulses).ok() && begin <= end && end <= pulses.size);
  assert(AreOfSchema(answers, layout_->schema));
  InterpolateColumns(*layout_, pulses, begin, end, answers,
                     [&](const ValueColumns& columns) { return ValueWriter(layout_->records, columns); });
}

}  // namespace albtpu
