#include "tables/query/pulse_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace albtpu {
namespace {

std::size_t Padded(std::size_t count) {
  return (count + AxisLookup::kPadding - 1) / AxisLookup::kPadding * AxisLookup::kPadding;
}
static_assert(kBlock % AxisLookup::kPadding == 0);

bool IsFar(float azimuth) { return std::abs(azimuth) > AxisLookup::kFarthestAzimuth; }

bool AnyIsFar(std::span<const float> azimuths) {
  bool far = false;
  for (float azimuth : azimuths) far |= IsFar(azimuth);
  return far;
}

// AxisLookup folds only azimuths that are not far.
void FoldFar(Fold fold, float* azimuths, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (IsFar(azimuths[i])) azimuths[i] = static_cast<float>(FoldAzimuth(azimuths[i], fold));
}

}  // namespace

Grid::Grid(const Table& table)
    : last_(table.axes().size() - 1), last_size_(static_cast<std::ptrdiff_t>(table.axes().back().size())) {
  for (std::size_t axis = 0; axis < table.axes().size(); ++axis) {
    axes_.emplace_back(table.axes()[axis], axis);
    absent_is_last_node_[axis] = table.schema().axes[axis].if_absent == IfAbsent::kLastNode;
    const std::span<const double> alternatives = table.axes()[axis].alternatives();
    if (alternatives.empty()) continue;
    axis_of_alternatives_ = axis;
    alternatives_.assign(alternatives.begin(), alternatives.end());
  }
  steps_[last()] = 1;
  std::ptrdiff_t step = 1;
  for (std::size_t axis = last(); axis-- > 0;) {
    const std::size_t size = table.axes()[axis].size();
    steps_[axis] = size > 1 ? step : 0;
    step *= static_cast<std::ptrdiff_t>(size);
  }
  slots_ = {SlotsOf(table.schema(), false), SlotsOf(table.schema(), true)};
}

// The axes but the innermost one of the records take the slots in the blend order: all five if there are five, else
// the first four, aligned at their end, so that the axis that changes most is blended last.
Grid::Slots Grid::SlotsOf(const TableSchema& schema, bool over_last_axis) const {
  constexpr std::size_t kFew = BlendedPulses::kFastest;
  const std::size_t innermost = over_last_axis || last() == 0 ? last() : last() - 1;
  std::vector<std::size_t> outer;
  for (const std::size_t axis : schema.blend_order)
    if (axis < innermost) outer.push_back(axis);
  Slots slots{.axes = {}, .steps = {}};
  slots.axes.fill(kNoAxis);
  std::size_t slot = outer.size() < kFew ? kFew - outer.size() : 0;
  for (const std::size_t axis : outer) {
    slots.axes[slot] = axis;
    slots.steps[slot++] = step(axis) * (over_last_axis ? last_size_ : 1);
  }
  return slots;
}

float Grid::absent_coordinate(std::size_t axis) const {
  return absent_is_last_node_[axis] ? axes_[axis].last_node() : std::numeric_limits<float>::quiet_NaN();
}

PulseBlock::PulseBlock(const Grid& grid, const PulseColumns& pulses, std::size_t max_count)
    : grid_(grid), pulses_(pulses), max_count_(max_count) {
  for (std::size_t axis = 0; axis < grid_.axis_count(); ++axis) {
    if (!IsConstant(axis)) continue;
    const std::span<const float> column = pulses_.axis[axis];
    if (axis == grid_.axis_of_alternatives() && column.empty()) {
      has_alternatives_ = true;
      continue;
    }
    const float coordinate = column.empty() ? grid_.absent_coordinate(axis) : column.front();
    std::int32_t& row = axis == grid_.last() ? constant_last_ : constant_row_;
    row += LocateConstant(axis, coordinate, fractions_[axis]);
  }
  if (grid_.axis_count() < kMaxAxes) std::fill_n(zeros_.begin(), max_count, 0.0f);
  for (const bool over_last_axis : {false, true})
    for (const bool later : {false, true})
      SetBlended(over_last_axis, later, blended_[over_last_axis ? 1 : 0][later ? 1 : 0]);
  // All of them, because all of them decide the outcome.
  for (std::size_t i = 0; has_alternatives_ && i < alternatives(); ++i) LocateAlternative(i);
}

void PulseBlock::TakeAlternative(std::size_t alternative) {
  alternative_ = alternative;
  if (alternative > 0 && alternative != later_) LocateAlternative(alternative);
}

void PulseBlock::LocateAlternative(std::size_t alternative) {
  const std::size_t axis = grid_.axis_of_alternatives();
  const bool later = alternative > 0;
  const std::ptrdiff_t row =
      LocateConstant(axis, grid_.alternatives()[alternative], later ? later_fractions_ : fractions_[axis]);
  blended_[0][later ? 1 : 0].first = row;
  blended_[1][later ? 1 : 0].first = row * grid_.last_size();
  if (later) later_ = alternative;
}

std::int32_t PulseBlock::LocateConstant(std::size_t axis, float coordinate, BlockOf<float>& fractions) {
  constexpr std::size_t kCount = AxisLookup::kPadding;
  float coordinates[kCount], fraction[kCount];
  std::int32_t rows[kCount] = {}, codes[kCount];
  std::fill_n(coordinates, kCount, coordinate);
  std::fill_n(codes, kCount, constant_code_);
  const Fold fold = grid_.axis(axis).fold();
  if (fold != Fold::kNone) FoldFar(fold, coordinates, kCount);
  grid_.axis(axis).Locate(coordinates, kCount, static_cast<std::int32_t>(grid_.step(axis)), rows, fraction, codes);
  constant_code_ = codes[0];
  std::fill_n(fractions.begin(), max_count_, fraction[0]);
  return rows[0];
}

void PulseBlock::LocateColumn(std::size_t axis, BlockOf<std::int32_t>& rows) {
  const std::span<const float> column = pulses_.axis[axis].subspan(first_, count_);
  const float* coordinates = column.data();
  BlockOf<float> copy;
  const Fold fold = grid_.axis(axis).fold();
  const bool far = fold != Fold::kNone && AnyIsFar(column);
  if (far || Padded(count_) != count_) {
    std::copy(column.begin(), column.end(), copy.begin());
    std::fill(copy.begin() + count_, copy.begin() + Padded(count_), column.back());
    if (far) FoldFar(fold, copy.begin(), Padded(count_));
    coordinates = copy.begin();
  }
  grid_.axis(axis).Locate(coordinates, Padded(count_), static_cast<std::int32_t>(grid_.step(axis)), rows.begin(),
                          fractions_[axis].begin(), codes_.begin());
}

void PulseBlock::MoveTo(std::size_t first, std::size_t count) {
  first_ = first;
  count_ = count;
  for (auto& of_alternatives : blended_)
    for (BlendedPulses& pulses : of_alternatives) pulses.count = count;
  std::fill_n(codes_.begin(), Padded(count), constant_code_);
  std::fill_n(rows_.begin(), Padded(count), constant_row_);
  for (std::size_t axis = 0; axis < grid_.last(); ++axis)
    if (!IsConstant(axis)) LocateColumn(axis, rows_);
  const auto last_size = static_cast<std::int32_t>(grid_.last_size());
  for (std::size_t i = 0; i < Padded(count); ++i) rows_with_last_[i] = rows_[i] * last_size + constant_last_;
  if (!IsConstant(grid_.last())) LocateColumn(grid_.last(), rows_with_last_);

  std::int32_t differences = 0;
  for (std::size_t i = 0; i < count; ++i) differences |= codes_[i] ^ outcome_code::kInside;
  all_inside_ = differences == 0;
}

bool PulseBlock::IsScattered() const {
  std::size_t moves = 0;
  for (std::size_t i = 1; i < count_; ++i) moves += rows_[i] != rows_[i - 1];
  return 2 * moves > count_;
}

void PulseBlock::SetBlended(bool over_last_axis, bool later, BlendedPulses& pulses) const {
  const auto fractions = [&](std::size_t axis) {
    return (later && axis == grid_.axis_of_alternatives() ? later_fractions_ : fractions_[axis]).begin();
  };
  const Grid::Slots& slots = grid_.slots(over_last_axis);
  const std::size_t last = grid_.last();
  pulses.rows = (over_last_axis ? rows_with_last_ : rows_).begin();
  pulses.steps = slots.steps;
  for (std::size_t slot = 0; slot < BlendedPulses::kSlotCount; ++slot) {
    const std::size_t axis = slots.axes[slot];
    if (axis != Grid::kNoAxis) pulses.fractions[slot] = fractions(axis);
    if (axis == Grid::kNoAxis && slot != BlendedPulses::kFastest) pulses.fractions[slot] = zeros_.begin();
  }
  pulses.innermost = fractions(over_last_axis || last == 0 ? last : last - 1);
}

}  // namespace albtpu
