#include "tables/query/axis_lookup.h"

#include <cassert>
#include <cmath>

// The code below is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tables/query/axis_lookup.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
//
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, AxisLookup::kPadding>;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
constexpr D d;
constexpr DI di;

// FoldAzimuth, exactly: up to kFarthestAzimuth, subtracting whole half turns does not round.
HWY_INLINE V Folded(Fold fold, V azimuth) {
  const V half_turn = hn::Set(d, 180.0f);
  const V magnitude = hn::Abs(azimuth);
  const V turns = hn::Floor(hn::Mul(magnitude, hn::Set(d, 1 / 180.0f)));
  V rest = hn::NegMulAdd(turns, half_turn, magnitude);  // `turns` may be off by one
  rest = hn::IfThenElse(hn::Lt(rest, hn::Zero(d)), hn::Add(rest, half_turn), rest);
  rest = hn::IfThenElse(hn::Ge(rest, half_turn), hn::Sub(rest, half_turn), rest);
  const V mirrored = hn::Sub(half_turn, rest);
  if (fold == Fold::kQuadrant) return hn::Min(rest, mirrored);
  const auto turned = hn::And(hn::Lt(azimuth, hn::Zero(d)), hn::Gt(rest, hn::Zero(d)));
  return hn::IfThenElse(turned, mirrored, rest);
}

// The index of the node at or below `x`: the last but one for the last node and beyond, 0 below the first node and
// for NaN.
HWY_INLINE VI LowerNode(const AxisLookup::Nodes& axis, V x) {
  const std::vector<float>& nodes = axis.nodes;
  constexpr std::size_t kFewNodes = 48;  // comparing with each of them is faster than a search
  VI lower = hn::Zero(di);
  if (nodes.size() <= kFewNodes) {
    for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
      const auto at_or_above = hn::RebindMask(di, hn::Ge(x, hn::Set(d, nodes[k])));
      lower = hn::Sub(lower, hn::VecFromMask(di, at_or_above));
    }
    return lower;
  }
  const auto last = static_cast<std::int32_t>(nodes.size()) - 2;
  std::int32_t leap = 1;
  while (2 * leap <= last) leap *= 2;
  for (; leap > 0; leap /= 2) {
    const VI tried = hn::Min(hn::Add(lower, hn::Set(di, leap)), hn::Set(di, last));
    const V node = hn::GatherIndex(d, nodes.data(), tried);
    lower = hn::IfThenElse(hn::RebindMask(di, hn::Ge(x, node)), tried, lower);
  }
  return lower;
}

// The nodes around each coordinate.
struct Interval {
  V from, to;
  V inverse_width;  // in the scale of the axis
};

HWY_INLINE V Fraction(const Interval& interval, bool log, V x) {
  V way = hn::Sub(x, interval.from);
  if (log) way = hn::Log1p(d, hn::Div(way, interval.from));
  const V one = hn::Set(d, 1.0f);
  const V fraction = hn::Min(hn::Mul(way, interval.inverse_width), one);
  return hn::IfThenElse(hn::Eq(x, interval.to), one, fraction);
}

void LocateBlock(const AxisLookup::Nodes& axis, const float* coordinates, std::size_t count, std::int32_t step,
                 std::int32_t* rows, float* fractions, std::int32_t* codes) {
  const bool one_node = axis.nodes.size() == 1;
  const V first = hn::Set(d, axis.nodes.front()), last = hn::Set(d, axis.nodes.back());
  const VI invalid = hn::Set(di, axis.axis), outside = hn::Set(di, outcome_code::kOutside + axis.axis);
  // The intervals of the previous coordinates. Along a flight line the next ones often lie in the same intervals.
  VI lower = hn::Zero(di);
  Interval interval{hn::Zero(d), hn::Zero(d), hn::Zero(d)};  // empty
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const V coordinate = hn::LoadU(d, coordinates + i);
    auto valid = hn::IsFinite(coordinate);
    V x = coordinate;
    if (axis.fold != Fold::kNone) x = Folded(axis.fold, x);
    if (axis.endless) {
      const auto positive = hn::Gt(x, hn::Zero(d));
      valid = hn::Or(valid, positive);
      const auto held = axis.log ? positive : hn::Ge(x, hn::Zero(d));
      x = one_node ? hn::IfThenElse(held, last, x) : hn::Min(x, last);
    }
    const auto inside = hn::And(valid, hn::And(hn::Ge(x, first), hn::Le(x, last)));
    const VI code = hn::IfThenElse(hn::RebindMask(di, inside), hn::Set(di, outcome_code::kInside),
                                   hn::IfThenElse(hn::RebindMask(di, valid), outside, invalid));
    hn::StoreU(hn::Min(code, hn::LoadU(di, codes + i)), di, codes + i);
    if (one_node) {
      hn::StoreU(hn::Zero(d), d, fractions + i);
      continue;
    }
    x = hn::IfThenElse(inside, x, first);
    if (!hn::AllTrue(d, hn::And(hn::Ge(x, interval.from), hn::Lt(x, interval.to)))) {
      lower = LowerNode(axis, x);
      interval.from = hn::GatherIndex(d, axis.nodes.data(), lower);
      interval.to = hn::GatherIndex(d, axis.nodes.data() + 1, lower);
      interval.inverse_width = hn::GatherIndex(d, axis.inverse_widths.data(), lower);
    }
    hn::StoreU(hn::Add(hn::LoadU(di, rows + i), hn::Mul(lower, hn::Set(di, step))), di, rows + i);
    hn::StoreU(Fraction(interval, axis.log, x), d, fractions + i);
  }
}

void AddLowerNodesOfBlock(const AxisLookup::Nodes& axis, const float* coordinates, std::size_t count, std::int32_t step,
                          std::int32_t* rows) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    V x = hn::LoadU(d, coordinates + i);
    if (axis.fold != Fold::kNone) x = Folded(axis.fold, x);
    hn::StoreU(hn::Add(hn::LoadU(di, rows + i), hn::Mul(LowerNode(axis, x), hn::Set(di, step))), di, rows + i);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {

HWY_EXPORT(LocateBlock);
HWY_EXPORT(AddLowerNodesOfBlock);

AxisLookup::AxisLookup(const Axis& axis, std::size_t index)
    : nodes_{.nodes = {axis.nodes().begin(), axis.nodes().end()},
             .inverse_widths = {},
             .axis = static_cast<std::int32_t>(index),
             .log = axis.scale() == Scale::kLog,
             .fold = axis.schema().fold,
             .endless = axis.schema().is_endless} {
  for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
    const double from = axis.nodes()[i], to = axis.nodes()[i + 1];
    nodes_.inverse_widths.push_back(static_cast<float>(1 / (nodes_.log ? std::log(to / from) : to - from)));
  }
}

void AxisLookup::Locate(const float* coordinates, std::size_t count, std::int32_t step, std::int32_t* rows,
                        float* fractions, std::int32_t* codes) const {
  assert(count % kPadding == 0);
  HWY_DYNAMIC_DISPATCH(LocateBlock)(nodes_, coordinates, count, step, rows, fractions, codes);
}

void AxisLookup::AddLowerNodes(const float* coordinates, std::size_t count, std::int32_t step,
                               std::int32_t* rows) const {
  assert(count % kPadding == 0);
  HWY_DYNAMIC_DISPATCH(AddLowerNodesOfBlock)(nodes_, coordinates, count, step, rows);
}

}  // namespace albtpu
#endif
