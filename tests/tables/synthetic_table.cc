#include "tests/tables/synthetic_table.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <utility>

namespace albtpu::testing {
namespace {

using Coordinates = std::array<double, kAxisCount>;

template <typename Value>
Value OrDie(absl::StatusOr<Value> value) {
  if (!value.ok()) {
    std::cerr << value.status() << "\n";
    std::abort();
  }
  return *std::move(value);
}

// Smooth, curved along every axis, positive (except the bias along the beam), and of a realistic magnitude.
double Formula(Quantity quantity, const Coordinates& at) {
  const auto [wind_speed, fetch, incidence, azimuth, footprint, depth] = at;
  const double radians = std::numbers::pi / 180;
  const double slope = std::sqrt(wind_speed) * (1 + 0.05 * std::log10(fetch)) / std::cbrt(footprint);
  const double oblique = 1 + std::pow(incidence / 60, 2);
  const double along = slope * oblique * (1 + 0.1 * std::cos(2 * azimuth * radians));
  switch (quantity) {
    case Quantity::kRefractionAlongWind:
      return along;
    case Quantity::kRefractionCrossWind:
      return 0.85 * slope * oblique * (1 - 0.1 * std::cos(2 * azimuth * radians));
    case Quantity::kThu:
      return 0.01 * slope + 1.3 * along * radians * depth;
    case Quantity::kTvu:
      return 0.005 * slope + 0.5 * along * radians * depth * std::sin((1 + incidence) * radians);
    case Quantity::kBiasAlongBeam:
      return -0.001 * depth * slope * std::sin(incidence * radians) * std::cos(azimuth * radians);
    case Quantity::kBiasVertical:
      return 0.0002 * depth * slope * slope;
  }
  return 0;
}

// `f` at every node of the quantity, in the order of a variable.
template <typename Function>
std::vector<float> Tabulate(const UncertaintyTable::Axes& axes, Quantity quantity, Function f) {
  std::vector<float> values(ValueCount(axes, quantity));
  const std::size_t dimensions = Describe(quantity).over_last_axis ? kAxisCount : kAxisCount - 1;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Coordinates at{};
    std::size_t rest = i;
    for (std::size_t axis = dimensions; axis-- > 0;) {
      at[axis] = axes[axis].nodes()[rest % axes[axis].size()];
      rest /= axes[axis].size();
    }
    values[i] = static_cast<float>(f(at));
  }
  return values;
}

Provenance MakeProvenance(const SyntheticOptions& options) {
  return {.id = options.id,
          .version = options.version,
          .title = "Synthetic table for tests: not the sea",
          .campaign = options.published ? "" : "[campaign]\nid = \"" + options.id + "\"\n",
          .attributes = {{"source", std::string("a smooth formula")},
                         {"realizations", std::int64_t{500}},
                         {"refractive_index", 1.34},  // What answers are for where none is asked: not scaled.
                         {"interpolation_error", std::vector<double>{0.01, 0.02, 0.03}}}};
}

}  // namespace

TableParts PartsOf(const UncertaintyTable& table) {
  TableParts parts{table.axes(), {}, table.provenance()};
  for (const Quantity quantity : kQuantities)
    if (const Variable* variable = table.variable(quantity)) parts.variables[Index(quantity)] = *variable;
  return parts;
}

Axis MakeAxis(AxisId id, const std::vector<double>& nodes, const TableSchema& kind) {
  const std::vector<float> rounded(nodes.begin(), nodes.end());
  return OrDie(Axis::Create(kind.axes[Index(id)], {rounded.begin(), rounded.end()}));
}

UncertaintyTable SyntheticTable(const SyntheticOptions& options) {
  UncertaintyTable::Axes axes = {
      MakeAxis(AxisId::kWindSpeed, {3, 4, 5, 7, 10}),       MakeAxis(AxisId::kFetch, {1e3, 3e3, 1e4, 1e5}),
      MakeAxis(AxisId::kIncidence, {0, 5, 10, 15, 20, 25}), MakeAxis(AxisId::kAzimuth, {0, 30, 60, 90}),
      MakeAxis(AxisId::kFootprint, {0.25, 0.5, 1, 2}),      MakeAxis(AxisId::kDepth, {0, 0.5, 1, 2, 5, 10, 20})};
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    if (options.published && Describe(quantity).is_bias) continue;
    const auto value = [&](const Coordinates& at) { return options.factor * Formula(quantity, at); };
    Variable variable{.values = Tabulate(axes, quantity, value), .standard_errors = {}, .scale = Scale::kLinear};
    if (!options.published) {
      variable.standard_errors =
          Tabulate(axes, quantity, [&](const Coordinates& at) { return 0.03 * std::abs(value(at)); });
    }
    variables[Index(quantity)] = std::move(variable);
  }
  return OrDie(UncertaintyTable::Create(std::move(axes), std::move(variables), MakeProvenance(options)));
}

UncertaintyTable SyntheticSea() {
  UncertaintyTable::Axes axes = {MakeAxis(AxisId::kWindSpeed, {6.5}, kOneSea),
                                 MakeAxis(AxisId::kFetch, {1}, kOneSea),
                                 MakeAxis(AxisId::kIncidence, {0, 5, 10, 15, 20, 25}, kOneSea),
                                 MakeAxis(AxisId::kAzimuth, {0, 25, 60, 100, 130, 180}, kOneSea),
                                 MakeAxis(AxisId::kFootprint, {0.25, 0.5, 1, 2}, kOneSea),
                                 MakeAxis(AxisId::kDepth, {0, 0.5, 1, 2, 5, 10, 20}, kOneSea)};
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    const auto value = [&](Coordinates at) {
      double& azimuth = at[Index(AxisId::kAzimuth)];
      azimuth = azimuth < 180 ? azimuth + 20 * std::sin(azimuth * std::numbers::pi / 180) : 0;
      return Formula(quantity, at) * (1 + 0.1 * std::sin(azimuth * std::numbers::pi / 90));
    };
    variables[Index(quantity)] = Variable{
        .values = Tabulate(axes, quantity, value),
        .standard_errors = Tabulate(axes, quantity, [&](const Coordinates& at) { return 0.03 * std::abs(value(at)); }),
        .scale = Scale::kLinear};
  }
  return OrDie(UncertaintyTable::Create(kOneSea, std::move(axes), std::move(variables),
                                        MakeProvenance({.id = "synthetic-sea"})));
}

UncertaintyTable TinyTable(Scale scale, const TableSchema& kind) {
  UncertaintyTable::Axes axes = {MakeAxis(AxisId::kWindSpeed, {2, 4}, kind),  MakeAxis(AxisId::kFetch, {1000}, kind),
                                 MakeAxis(AxisId::kIncidence, {0, 20}, kind), MakeAxis(AxisId::kAzimuth, {0, 90}, kind),
                                 MakeAxis(AxisId::kFootprint, {1}, kind),     MakeAxis(AxisId::kDepth, {0, 10}, kind)};
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    variables[Index(quantity)] =
        Variable{.values = Tabulate(axes, quantity, [&](const Coordinates& at) { return 1 + at[0] + Index(quantity); }),
                 .standard_errors = Tabulate(axes, quantity, [](const Coordinates& at) { return 0.1 * (1 + at[5]); }),
                 .scale = scale};
  }
  return OrDie(UncertaintyTable::Create(kind, std::move(axes), std::move(variables), MakeProvenance({.id = "tiny"})));
}

}  // namespace albtpu::testing
