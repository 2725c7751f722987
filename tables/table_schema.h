// A kind of table as data: its axes, its quantities and the rules of both. The code that checks, writes, reads and
// interpolates tables knows a kind by its schema alone. The schema of the sea surface is in schema.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>

namespace albtpu {

// How values vary between two nodes: linearly in the coordinate, or linearly in its logarithm.
enum class Scale { kLinear, kLog };

std::string_view Name(Scale scale);  // "linear", "log": the value of the attribute `interpolation`.

// The symmetry by which an angle in degrees is folded into the range of its axis: FoldAzimuth in axis.h.
enum class Fold {
  kNone,      // It is not.
  kQuadrant,  // Into 0 to 90: nothing changes by half a turn, or when mirrored at 0 degrees.
  kHalfTurn   // Into 0 to 180: nothing changes by half a turn.
};

// The meaning of a query without a coordinate on an axis.
enum class IfAbsent {
  kRefuse,         // Invalid: the axis needs a coordinate.
  kLastNode,       // The last node.
  kLargerOfEnds,   // The worse of 0 and 90 degrees: of the two answers, each value is the larger in magnitude.
  kLargestOfNodes  // The worst node: of the answers at all nodes, each value is the largest in magnitude.
};

// Whether a query without coordinate has several answers, of which each value is the largest in magnitude.
constexpr bool TakesLargest(IfAbsent rule) {
  return rule == IfAbsent::kLargerOfEnds || rule == IfAbsent::kLargestOfNodes;
}

struct AxisSchema {
  std::string_view name;       // "wind_speed": the dataset, the CSV column, the field of a message.
  std::string_view units;      // CF units: "m s-1".
  std::string_view long_name;  // One line for people.
  Scale scale;                 // The scale of the tables that we make; a file may state another.
  Fold fold = Fold::kNone;
  // True if any coordinate above the last node, +infinity included, counts as the last node. If there is one node
  // only, any coordinate does that a node may have: one above zero on a log scale, else zero, too.
  bool is_endless = false;
  IfAbsent if_absent = IfAbsent::kRefuse;

  bool operator==(const AxisSchema&) const = default;
};

// Uncertainties are 2 sigma.
struct QuantitySchema {
  std::string_view name;   // "thu"; its standard error is `name + kStandardErrorSuffix`.
  std::string_view units;  // "degree" or "m".
  std::string_view long_name;
  // False: the quantity does not depend on the last axis, and its variable has one axis less.
  bool over_last_axis;
  bool is_bias;  // Biases may be negative, and may be absent; the other quantities may not.

  constexpr bool operator==(const QuantitySchema&) const = default;
};

inline constexpr std::string_view kStandardErrorSuffix = "_standard_error";

// The maximum numbers of axes and quantities of a table: the interpolator keeps arrays of these sizes.
inline constexpr std::size_t kMaxAxes = 6;
inline constexpr std::size_t kMaxQuantities = 9;

// A constant of the program: tables of the kind refer to it.
struct TableSchema {
  std::string_view name;  // "sea_surface": the attribute `table_kind` (FORMAT.md).
  // Slowest first: the order of the dimensions of every variable.
  std::span<const AxisSchema> axes;
  std::span<const QuantitySchema> quantities;
  // Every axis once, as an index into `axes`, from the one that changes least along a flight line; the last axis of
  // the table comes last. The interpolator blends the axes in this order and keeps the result of the first ones from
  // pulse to pulse. The order decides the rounding of an answer, too.
  std::span<const std::size_t> blend_order;
};

// Whether the datasets of axes, quantities and standard errors, which are all in one group, have different names.
constexpr bool HasDistinctNames(const TableSchema& schema) {
  const std::size_t axis_count = schema.axes.size(), count = axis_count + schema.quantities.size();
  const auto name = [&](std::size_t i) {
    return i < axis_count ? schema.axes[i].name : schema.quantities[i - axis_count].name;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (name(i).empty()) return false;
    for (std::size_t j = 0; j < count; ++j) {
      if (i == j || !name(i).starts_with(name(j))) continue;
      const std::string_view rest = name(i).substr(name(j).size());
      if (rest.empty() || (rest == kStandardErrorSuffix && j >= axis_count)) return false;
    }
  }
  return true;
}

// Whether a schema keeps the rules that the code relies on. To be asserted beside the constant.
constexpr bool IsWellFormed(const TableSchema& schema) {
  const std::size_t axis_count = schema.axes.size(), quantity_count = schema.quantities.size();
  if (schema.name.empty() || axis_count == 0 || axis_count > kMaxAxes) return false;
  if (quantity_count == 0 || quantity_count > kMaxQuantities) return false;

  const auto& order = schema.blend_order;
  if (order.size() != axis_count || order.back() != axis_count - 1) return false;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (std::find(order.begin(), order.end(), axis) == order.end()) return false;
  std::size_t largest = 0;
  for (const AxisSchema& axis : schema.axes) {
    if (axis.fold != Fold::kNone && (axis.units != "degree" || axis.is_endless)) return false;
    if (axis.if_absent == IfAbsent::kLargerOfEnds && axis.fold != Fold::kQuadrant) return false;
    if (TakesLargest(axis.if_absent) && ++largest > 1) return false;
  }
  if (TakesLargest(schema.axes.back().if_absent)) return false;
  for (const QuantitySchema& quantity : schema.quantities)
    if (!quantity.over_last_axis && axis_count == 1) return false;
  return HasDistinctNames(schema);
}

}  // namespace albtpu
