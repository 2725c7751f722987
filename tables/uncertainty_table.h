// A lookup table in memory: axes, quantities with their standard errors, and where they come from.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/axis.h"
#include "tables/provenance.h"
#include "tables/schema.h"

namespace albtpu {

// A quantity at every node, row-major in the order of kAxes (depth fastest; without depth where the quantity
// has none).
struct Variable {
  std::vector<float> values;           // Finite, 1e6 at most; not negative unless a bias.
  std::vector<float> standard_errors;  // The same shape; so too, not negative. Empty: not known.
  Scale scale =
      Scale::kLinear;  // kLog only where all values are positive. Standard errors are always linear.
};

// Immutable; a valid table by construction.
class UncertaintyTable {
 public:
  using Axes = std::array<Axis, kAxisCount>;
  using Variables = std::array<std::optional<Variable>, kQuantityCount>;

  // Fails with InvalidArgument when an axis stands in the wrong place, a required variable is missing, a
  // shape does not fit the axes, or a value breaks the rules of `Variable`; the message names axis or
  // variable and the index.
  static absl::StatusOr<UncertaintyTable> Create(Axes axes, Variables variables, Provenance provenance);

  const Axis& axis(AxisId id) const { return axes_[Index(id)]; }
  const Axes& axes() const { return axes_; }
  // Null when the table does not hold the quantity (biases of published tables).
  const Variable* variable(Quantity quantity) const;
  const Provenance& provenance() const { return provenance_; }
  bool is_published() const { return provenance_.campaign.empty(); }  // numbers of others, not of a campaign

  // SHA-256, 64 hexadecimal digits, over id, axes, values, standard errors, units, scales and campaign; not
  // over date, version, commit or other attributes. Two tables with one digest answer alike.
  const std::string& digest() const { return digest_; }

 private:
  UncertaintyTable(Axes axes, Variables variables, Provenance provenance);

  Axes axes_;
  Variables variables_;
  Provenance provenance_;
  std::string digest_;
};

// The number of values of a quantity on these axes.
std::size_t ValueCount(const UncertaintyTable::Axes& axes, Quantity quantity);

}  // namespace albtpu
