#include "tables/table.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "status/status_macros.h"
#include "tables/digest.h"
#include "tables/format.h"

namespace albtpu {
namespace {

// "[wind_speed 0, fetch 3, ...]": the node of the value at `index`.
std::string Position(std::span<const Axis> axes, const QuantitySchema& quantity, std::size_t index) {
  std::string position;
  for (std::size_t i = axes.size() - (quantity.over_last_axis ? 0 : 1); i-- > 0;) {
    const std::size_t size = axes[i].size();
    position =
        absl::StrCat(std::string(axes[i].schema().name), " ", index % size, position.empty() ? "" : ", ", position);
    index /= size;
  }
  return absl::StrCat("[", position, "]");
}

struct ValueRules {
  bool may_be_negative;
  bool must_be_positive;
};

// The rule that a value breaks; empty if it breaks none.
std::string_view Problem(float value, const ValueRules& rules) {
  if (!std::isfinite(value)) return "values must be finite";
  if (std::abs(value) > format::kMaxValue) return "magnitudes must not be above 1e6";
  if (value < 0 && !rules.may_be_negative) return "it must not be negative";
  if (!(value > 0) && rules.must_be_positive) return "on a log scale it must be positive";
  return "";
}

// Whether no value has a Problem(). It is fast, because every table is checked when it is read.
bool BreakNone(const std::vector<float>& values, const ValueRules& rules) {
  float least = 0;
  if (rules.may_be_negative) least = -format::kMaxValue;
  if (rules.must_be_positive) least = std::numeric_limits<float>::denorm_min();
  unsigned outside = 0;
  for (const float value : values) outside |= static_cast<unsigned>(!(value >= least) | !(value <= format::kMaxValue));
  return outside == 0;
}

absl::Status CheckValues(std::span<const Axis> axes, const QuantitySchema& quantity, const std::string& name,
                         const std::vector<float>& values, const ValueRules& rules) {
  const std::size_t expected = ValueCount(axes, quantity);
  if (values.size() != expected) {
    return absl::InvalidArgumentError(
        absl::StrFormat("variable '%s' has %d values: its axes have %d nodes", name, values.size(), expected));
  }
  if (BreakNone(values, rules)) return absl::OkStatus();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string_view problem = Problem(values[i], rules);
    if (problem.empty()) continue;
    return absl::InvalidArgumentError(absl::StrFormat("variable '%s' is %g at %s: %s", name, values[i],
                                                      Position(axes, quantity, i), std::string(problem)));
  }
  return absl::OkStatus();
}

absl::Status CheckVariable(std::span<const Axis> axes, const QuantitySchema& quantity, const Variable& variable) {
  const std::string name(quantity.name);
  absl::Status status =
      CheckValues(axes, quantity, name, variable.values,
                  {.may_be_negative = quantity.is_bias, .must_be_positive = variable.scale == Scale::kLog});
  if (!status.ok() || variable.standard_errors.empty()) return status;
  return CheckValues(axes, quantity, name + std::string(kStandardErrorSuffix), variable.standard_errors,
                     {.may_be_negative = false, .must_be_positive = false});
}

absl::Status CheckAxes(const TableSchema& schema, std::span<const Axis> axes) {
  if (axes.size() != schema.axes.size()) {
    return absl::InvalidArgumentError(absl::StrFormat("there are %d axes: expected the %d of kind '%s'", axes.size(),
                                                      schema.axes.size(), std::string(schema.name)));
  }
  std::size_t count = 1;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string name(axes[i].schema().name), expected(schema.axes[i].name);
    if (name != expected)
      return absl::InvalidArgumentError(absl::StrFormat("axis %d is '%s': expected '%s'", i, name, expected));
    if (axes[i].schema() != schema.axes[i]) {
      return absl::InvalidArgumentError(
          absl::StrFormat("axis '%s' has other rules than that of kind '%s'", name, std::string(schema.name)));
    }
    if (axes[i].size() > format::kMaxNodeCount) {
      return absl::InvalidArgumentError(absl::StrFormat("axis '%s' has %d nodes: it may have %d at most", name,
                                                        axes[i].size(), format::kMaxNodeCount));
    }
    if (axes[i].size() > format::kMaxValueCount / count) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "the axes up to '%s' span more than %d nodes, the most that a table may have", name, format::kMaxValueCount));
    }
    count *= axes[i].size();
  }
  return absl::OkStatus();
}

absl::Status CheckVariables(const TableSchema& schema, std::span<const Axis> axes, const Table::Variables& variables) {
  if (variables.size() != schema.quantities.size()) {
    return absl::InvalidArgumentError(absl::StrFormat("there are %d variables: expected the %d of kind '%s'",
                                                      variables.size(), schema.quantities.size(),
                                                      std::string(schema.name)));
  }
  for (std::size_t q = 0; q < variables.size(); ++q) {
    const QuantitySchema& quantity = schema.quantities[q];
    if (!variables[q].has_value()) {
      if (quantity.is_bias) continue;
      return absl::InvalidArgumentError(
          absl::StrFormat("variable '%s' is missing: only biases may be absent", std::string(quantity.name)));
    }
    RETURN_IF_ERROR(CheckVariable(axes, quantity, *variables[q]));
  }
  return absl::OkStatus();
}

// The byte sequence of FORMAT.md, "Content digest".
class ContentDigest {
 public:
  ContentDigest() { sha_.Update(format::kContentDigestPrefix); }

  void AddCount(std::uint64_t count) {
    static_assert(std::endian::native == std::endian::little);
    sha_.Update(&count, sizeof count);
  }
  void AddText(std::string_view text) {
    AddCount(text.size());
    sha_.Update(text);
  }
  void AddFloats(const std::vector<float>& values) {
    AddCount(values.size());
    sha_.Update(values.data(), values.size() * sizeof(float));
  }
  std::string Finish() { return Hex(sha_.Finish()); }

 private:
  Sha256 sha_;
};

std::string Digest(const TableSchema& schema, std::span<const Axis> axes, const Table::Variables& variables,
                   const Provenance& provenance) {
  ContentDigest digest;
  digest.AddText(provenance.id);
  for (const Axis& axis : axes) {
    digest.AddText(axis.schema().name);
    digest.AddText(axis.schema().units);
    digest.AddText(Name(axis.scale()));
    digest.AddFloats({axis.nodes().begin(), axis.nodes().end()});
  }
  for (std::size_t q = 0; q < variables.size(); ++q) {
    const std::optional<Variable>& variable = variables[q];
    if (!variable.has_value()) continue;
    digest.AddText(schema.quantities[q].name);
    digest.AddText(schema.quantities[q].units);
    digest.AddText(Name(variable->scale));
    digest.AddFloats(variable->values);
    digest.AddFloats(variable->standard_errors);
  }
  digest.AddText(provenance.campaign);
  if (schema.name != format::kDefaultTableKind) digest.AddText(schema.name);
  return digest.Finish();
}

}  // namespace

std::size_t ValueCount(std::span<const Axis> axes, const QuantitySchema& quantity) {
  std::size_t count = 1;
  for (const Axis& axis : quantity.over_last_axis ? axes : axes.first(axes.size() - 1)) count *= axis.size();
  return count;
}

absl::StatusOr<Table> Table::Create(const TableSchema& schema, Axes axes, Variables variables, Provenance provenance) {
  assert(IsWellFormed(schema));
  RETURN_IF_ERROR(CheckAxes(schema, axes));
  RETURN_IF_ERROR(CheckVariables(schema, axes, variables));
  RETURN_IF_ERROR(CheckProvenance(provenance));
  return Table(schema, std::move(axes), std::move(variables), std::move(provenance));
}

Table::Table(const TableSchema& schema, Axes axes, Variables variables, Provenance provenance)
    : schema_(&schema), axes_(std::move(axes)), variables_(std::move(variables)), provenance_(std::move(provenance)) {}

const std::string& Table::digest() const {
  std::call_once(digest_->once, [&] { digest_->text = Digest(*schema_, axes_, variables_, provenance_); });
  return digest_->text;
}

const Variable* Table::variable(std::size_t quantity) const {
  const std::optional<Variable>& variable = variables_[quantity];
  return variable.has_value() ? &*variable : nullptr;
}

}  // namespace albtpu
