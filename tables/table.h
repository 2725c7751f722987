// A table of any kind in memory: axes, quantities with their standard errors, and provenance.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/axis.h"
#include "tables/provenance.h"
#include "tables/table_schema.h"

namespace albtpu {

// A quantity at every node, row-major in the order of the axes, the last axis fastest. The last axis is missing if
// the quantity does not depend on it.
struct Variable {
  std::vector<float> values;           // Finite, at most 1e6 in magnitude; not negative unless a bias.
  std::vector<float> standard_errors;  // Of the same shape and limits, not negative. Empty: not known.
  // kLog only where all values are positive. Standard errors are always linear.
  Scale scale = Scale::kLinear;
};

// Immutable; a valid table by construction.
class Table {
 public:
  // In the order of the schema. A variable may be absent where the schema allows it.
  using Axes = std::vector<Axis>;
  using Variables = std::vector<std::optional<Variable>>;

  // Fails with InvalidArgument if the axes are not those of the schema, there are not as many variables as the
  // schema has quantities, a required variable is missing, a shape does not fit the axes, a value breaks the rules
  // of `Variable`, or the provenance its own. The message names the axis or the variable and the index. `schema`
  // must be well-formed and outlive the table.
  static absl::StatusOr<Table> Create(const TableSchema& schema, Axes axes, Variables variables, Provenance provenance);

  const TableSchema& schema() const { return *schema_; }
  const Axes& axes() const { return axes_; }
  // Null if the table does not hold the quantity at this index of the schema.
  const Variable* variable(std::size_t quantity) const;
  // Moves the variables out of a table that is not needed any more.
  Variables ReleaseVariables() && { return std::move(variables_); }
  const Provenance& provenance() const { return provenance_; }

  // SHA-256, 64 hexadecimal digits, over kind, id, axes, values, standard errors, units, scales and campaign; not
  // over other attributes. Two tables with the same digest, `refractive_index` and `x_azimuth` give the same answers.
  // Computed when it is asked for, once for all copies of a table.
  const std::string& digest() const;

 private:
  Table(const TableSchema& schema, Axes axes, Variables variables, Provenance provenance);

  const TableSchema* schema_;
  Axes axes_;
  Variables variables_;
  Provenance provenance_;
  struct LazyDigest {
    std::once_flag once;
    std::string text;
  };
  std::shared_ptr<LazyDigest> digest_ = std::make_shared<LazyDigest>();
};

// The number of values of a quantity on all axes of a table.
std::size_t ValueCount(std::span<const Axis> axes, const QuantitySchema& quantity);

}  // namespace albtpu
