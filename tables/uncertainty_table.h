// A table of the sea surface in memory.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "tables/axis.h"
#include "tables/provenance.h"
#include "tables/schema.h"
#include "tables/table.h"

namespace albtpu {

// A `Table` of kind kSeaSurface or kOneSea, whose axes and quantities have names. Immutable; a valid table by
// construction.
class UncertaintyTable {
 public:
  using Axes = std::array<Axis, kAxisCount>;
  using Variables = std::array<std::optional<Variable>, kQuantityCount>;
  static constexpr std::array<const TableSchema*, 2> kKinds = {&kSeaSurface, &kOneSea};

  // Fails with InvalidArgument if an axis is in the wrong place, a required variable is missing, a shape does not
  // fit the axes, or a value breaks the rules of `Variable`. The message names the axis or the variable and the
  // index. The kind is kSeaSurface, or `kind`, one of kKinds.
  static absl::StatusOr<UncertaintyTable> Create(Axes axes, Variables variables, Provenance provenance);
  static absl::StatusOr<UncertaintyTable> Create(const TableSchema& kind, Axes axes, Variables variables,
                                                 Provenance provenance);
  // Requires a table of one of kKinds.
  explicit UncertaintyTable(Table table);

  const TableSchema& schema() const { return table_.schema(); }
  bool is_of_one_sea() const { return &schema() == &kOneSea; }

  const Axis& axis(AxisId id) const { return axes_[Index(id)]; }
  const Axes& axes() const { return axes_; }
  // Null if the table does not hold the quantity: tables of published numbers have no biases.
  const Variable* variable(Quantity quantity) const { return table_.variable(Index(quantity)); }
  // Moves the variables out of a table that is not needed any more.
  Variables ReleaseVariables() &&;
  const Provenance& provenance() const { return table_.provenance(); }
  // Whether the numbers were published by others: no campaign made the table.
  bool is_published() const { return provenance().campaign.empty(); }

  // SHA-256, 64 hexadecimal digits, over id, axes, values, standard errors, units, scales and campaign; not over
  // other attributes. Two tables with the same digest, `refractive_index` and `x_azimuth` give the same answers.
  const std::string& digest() const { return table_.digest(); }

  const Table& table() const { return table_; }

 private:
  Table table_;
  Axes axes_;
};

// The number of values of a quantity on these axes.
std::size_t ValueCount(const UncertaintyTable::Axes& axes, Quantity quantity);

}  // namespace albtpu
