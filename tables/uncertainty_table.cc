#include "tables/uncertainty_table.h"

#include <bit>
#include <cmath>
#include <string_view>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/digest.h"
#include "tables/format.h"
#include "tables/provenance.h"

namespace albtpu {
namespace {

std::size_t DimensionCount(Quantity quantity) {
  return Describe(quantity).over_depth ? kAxisCount : Index(AxisId::kDepth);
}

// "[wind_speed 0, fetch 3, ...]": where the value at `index` lies.
std::string Position(const UncertaintyTable::Axes& axes, Quantity quantity, std::size_t index) {
  std::string position;
  for (std::size_t i = DimensionCount(quantity); i-- > 0;) {
    const std::size_t size = axes[i].size();
    position = absl::StrCat(std::string(Describe(kAxes[i]).name), " ", index % size,
                            position.empty() ? "" : ", ", position);
    index /= size;
  }
  return absl::StrCat("[", position, "]");
}

struct ValueRules {
  bool may_be_negative;
  bool must_be_positive;
};

// What is wrong with a value; empty if nothing.
std::string_view Problem(float value, const ValueRules& rules) {
  if (!std::isfinite(value)) return "values must be finite";
  if (std::abs(value) > format::kGreatestValue) return "magnitudes must not be above 1e6";
  if (value < 0 && !rules.may_be_negative) return "it must not be negative";
  if (!(value > 0) && rules.must_be_positive) return "on a log scale it must be positive";
  return "";
}

absl::Status CheckValues(const UncertaintyTable::Axes& axes, Quantity quantity, const std::string& name,
                         const std::vector<float>& values, const ValueRules& rules) {
  const std::size_t expected = ValueCount(axes, quantity);
  if (values.size() != expected) {
    return absl::InvalidArgumentError(absl::StrFormat("variable '%s' has %d values: its axes have %d nodes",
                                                      name, values.size(), expected));
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string_view problem = Problem(values[i], rules);
    if (problem.empty()) continue;
    return absl::InvalidArgumentError(absl::StrFormat("variable '%s' is %g at %s: %s", name, values[i],
                                                      Position(axes, quantity, i), std::string(problem)));
  }
  return absl::OkStatus();
}

absl::Status CheckVariable(const UncertaintyTable::Axes& axes, Quantity quantity, const Variable& variable) {
  const QuantitySchema& schema = Describe(quantity);
  const std::string name(schema.name);
  absl::Status status =
      CheckValues(axes, quantity, name, variable.values,
                  {.may_be_negative = schema.is_bias, .must_be_positive = variable.scale == Scale::kLog});
  if (!status.ok() || variable.standard_errors.empty()) return status;
  return CheckValues(axes, quantity, name + std::string(kStandardErrorSuffix), variable.standard_errors,
                     {.may_be_negative = false, .must_be_positive = false});
}

absl::Status CheckAxes(const UncertaintyTable::Axes& axes) {
  std::size_t count = 1;
  for (AxisId id : kAxes) {
    const Axis& axis = axes[Index(id)];
    if (axis.id() != id) {
      return absl::InvalidArgumentError(absl::StrFormat("axis %d is '%s': '%s' stands here", Index(id),
                                                        std::string(Describe(axis.id()).name),
                                                        std::string(Describe(id).name)));
    }
    if (axis.size() > format::kMaxNodeCount) {
      return absl::InvalidArgumentError(absl::StrFormat("axis '%s' has %d nodes: it may have %d at most",
                                                        std::string(Describe(id).name), axis.size(),
                                                        format::kMaxNodeCount));
    }
    if (axis.size() > format::kMaxValueCount / count) {
      return absl::InvalidArgumentError(
          absl::StrFormat("the axes up to '%s' span more than %d nodes, the most that a table may have",
                          std::string(Describe(id).name), format::kMaxValueCount));
    }
    count *= axis.size();
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

std::string Digest(const UncertaintyTable::Axes& axes, const UncertaintyTable::Variables& variables,
                   const Provenance& provenance) {
  ContentDigest digest;
  digest.AddText(provenance.id);
  for (const Axis& axis : axes) {
    digest.AddText(Describe(axis.id()).name);
    digest.AddText(Describe(axis.id()).units);
    digest.AddText(Name(axis.scale()));
    digest.AddFloats({axis.nodes().begin(), axis.nodes().end()});
  }
  for (Quantity quantity : kQuantities) {
    const std::optional<Variable>& variable = variables[Index(quantity)];
    if (!variable.has_value()) continue;
    digest.AddText(Describe(quantity).name);
    digest.AddText(Describe(quantity).units);
    digest.AddText(Name(variable->scale));
    digest.AddFloats(variable->values);
    digest.AddFloats(variable->standard_errors);
  }
  digest.AddText(provenance.campaign);
  return digest.Finish();
}

}  // namespace

std::size_t ValueCount(const UncertaintyTable::Axes& axes, Quantity quantity) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < DimensionCount(quantity); ++i) count *= axes[i].size();
  return count;
}

absl::StatusOr<UncertaintyTable> UncertaintyTable::Create(Axes axes, Variables variables,
                                                          Provenance provenance) {
  absl::Status status = CheckAxes(axes);
  for (Quantity quantity : kQuantities) {
    if (!status.ok()) return status;
    const std::optional<Variable>& variable = variables[Index(quantity)];
    if (variable.has_value()) {
      status = CheckVariable(axes, quantity, *variable);
    } else if (!Describe(quantity).is_bias) {
      status = absl::InvalidArgumentError(absl::StrFormat(
          "variable '%s' is missing: only biases may be absent", std::string(Describe(quantity).name)));
    }
  }
  if (status.ok()) status = CheckProvenance(provenance);
  if (!status.ok()) return status;
  return UncertaintyTable(std::move(axes), std::move(variables), std::move(provenance));
}

UncertaintyTable::UncertaintyTable(Axes axes, Variables variables, Provenance provenance)
    : axes_(std::move(axes)),
      variables_(std::move(variables)),
      provenance_(std::move(provenance)),
      digest_(Digest(axes_, variables_, provenance_)) {}

const Variable* UncertaintyTable::variable(Quantity quantity) const {
  const std::optional<Variable>& variable = variables_[Index(quantity)];
  return variable.has_value() ? &*variable : nullptr;
}

}  // namespace albtpu
