#include "tables/query/pulse_block.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace albtpu {
namespace {

constexpr float kDownwind = 0, kCrosswind = 90;  // degree

std::size_t Padded(std::size_t count) {
  return (count + AxisLookup::kPadding - 1) / AxisLookup::kPadding * AxisLookup::kPadding;
}
static_assert(kBlock % AxisLookup::kPadding == 0);

// AxisLookup folds azimuths that are some turns away at most.
bool IsFar(float azimuth) { return std::abs(azimuth) > AxisLookup::kFarthestAzimuth; }

bool AnyIsFar(std::span<const float> azimuths) {
  bool far = false;
  for (float azimuth : azimuths) far |= IsFar(azimuth);
  return far;
}

void BringNear(float* azimuths, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (IsFar(azimuths[i])) azimuths[i] = static_cast<float>(FoldAzimuth(azimuths[i]));
  }
}

}  // namespace

Grid::Grid(const UncertaintyTable& table)
    : axes_(table.axes().begin(), table.axes().end()),
      depths_(static_cast<std::ptrdiff_t>(table.axis(AxisId::kDepth).size())) {
  steps_[Index(AxisId::kDepth)] = 1;
  std::ptrdiff_t step = 1;
  for (std::size_t axis = Index(AxisId::kDepth); axis-- > 0;) {
    const std::size_t size = table.axes()[axis].size();
    steps_[axis] = size > 1 ? step : 0;
    step *= static_cast<std::ptrdiff_t>(size);
  }
}

PulseBlock::PulseBlock(const Grid& grid, const PulseColumns& pulses, std::size_t most)
    : grid_(grid), pulses_(pulses) {
  for (AxisId axis : kAxes) {
    if (!IsConstant(axis)) continue;
    BlockOf<float>& fractions = fractions_[Index(axis)];
    if (axis == AxisId::kAzimuth && azimuth_absent()) {
      downwind_row_ = LocateConstant(axis, kDownwind, most, fractions);
      crosswind_row_ = LocateConstant(axis, kCrosswind, most, crosswind_);
      continue;
    }
    const float coordinate =
        pulses_[axis].empty() ? std::numeric_limits<float>::infinity() : pulses_[axis].front();
    std::int32_t& row = axis == AxisId::kDepth ? constant_depth_ : constant_row_;
    row += LocateConstant(axis, coordinate, most, fractions);
  }
}

std::int32_t PulseBlock::LocateConstant(AxisId axis, float coordinate, std::size_t most,
                                        BlockOf<float>& fractions) {
  constexpr std::size_t kCount = AxisLookup::kPadding;
  float coordinates[kCount], fraction[kCount];
  std::int32_t rows[kCount] = {}, codes[kCount];
  std::fill_n(coordinates, kCount, coordinate);
  std::fill_n(codes, kCount, constant_code_);
  if (axis == AxisId::kAzimuth) BringNear(coordinates, kCount);
  grid_.axis(axis).Locate(coordinates, kCount, static_cast<std::int32_t>(grid_.step(axis)), rows, fraction,
                          codes);
  constant_code_ = codes[0];
  std::fill_n(fractions.begin(), most, fraction[0]);
  return rows[0];
}

void PulseBlock::LocateColumn(AxisId axis, BlockOf<std::int32_t>& rows) {
  const std::span<const float> column = pulses_[axis].subspan(first_, count_);
  const float* coordinates = column.data();
  BlockOf<float> copy;
  const bool far = axis == AxisId::kAzimuth && AnyIsFar(column);
  if (far || Padded(count_) != count_) {
    std::copy(column.begin(), column.end(), copy.begin());
    std::fill(copy.begin() + count_, copy.begin() + Padded(count_), column.back());
    if (far) BringNear(copy.begin(), Padded(count_));
    coordinates = copy.begin();
  }
  grid_.axis(axis).Locate(coordinates, Padded(count_), static_cast<std::int32_t>(grid_.step(axis)),
                          rows.begin(), fractions_[Index(axis)].begin(), codes_.begin());
}

void PulseBlock::MoveTo(std::size_t first, std::size_t count) {
  first_ = first;
  count_ = count;
  std::fill_n(codes_.begin(), Padded(count), constant_code_);
  std::fill_n(rows_.begin(), Padded(count), constant_row_);
  for (AxisId axis : kAxes) {
    if (!IsConstant(axis) && axis != AxisId::kDepth) LocateColumn(axis, rows_);
  }
  const auto depths = static_cast<std::int32_t>(grid_.depths());
  for (std::size_t i = 0; i < Padded(count); ++i) rows_with_depth_[i] = rows_[i] * depths + constant_depth_;
  if (!IsConstant(AxisId::kDepth)) LocateColumn(AxisId::kDepth, rows_with_depth_);

  std::int32_t differences = 0;
  for (std::size_t i = 0; i < count; ++i) differences |= codes_[i] ^ outcome_code::kInside;
  all_inside_ = differences == 0;
}

bool PulseBlock::IsScattered() const {
  std::size_t moves = 0;
  for (std::size_t i = 1; i < count_; ++i) moves += rows_[i] != rows_[i - 1];
  return 2 * moves > count_;
}

BlendedPulses PulseBlock::WithoutDepth(Side side) const {
  const auto fractions = [&](AxisId axis) { return fractions_[Index(axis)].begin(); };
  const bool downwind = side == Side::kDownwind;
  return {.first = downwind ? downwind_row_ : crosswind_row_,
          .rows = rows_.begin(),
          .fractions = {fractions(AxisId::kWindSpeed), fractions(AxisId::kFetch),
                        downwind ? fractions(AxisId::kAzimuth) : crosswind_.begin(),
                        fractions(AxisId::kIncidence), nullptr},
          .steps = {grid_.step(AxisId::kWindSpeed), grid_.step(AxisId::kFetch), grid_.step(AxisId::kAzimuth),
                    grid_.step(AxisId::kIncidence), 0},
          .last = fractions(AxisId::kFootprint),
          .count = count_};
}

BlendedPulses PulseBlock::WithDepth(Side side) const {
  BlendedPulses pulses = WithoutDepth(side);
  pulses.first *= grid_.depths();
  pulses.rows = rows_with_depth_.begin();
  pulses.fractions[BlendedPulses::kFootprint] = pulses.last;
  pulses.steps[BlendedPulses::kFootprint] = grid_.step(AxisId::kFootprint);
  for (std::ptrdiff_t& step : pulses.steps) step *= grid_.depths();
  pulses.last = fractions_[Index(AxisId::kDepth)].begin();
  return pulses;
}

}  // namespace albtpu
