#include "tests/tables/rough_table.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "tests/tables/synthetic_table.h"

namespace albtpu::testing {
namespace {

constexpr std::size_t kMostNodes = 6;

std::vector<double> Nodes(AxisId axis, std::mt19937& random) {
  const std::size_t size = 1 + random() % kMostNodes;
  const bool from_zero = axis == AxisId::kIncidence || axis == AxisId::kDepth;
  std::uniform_real_distribution<double> step(0.1, 3);
  std::vector<double> nodes = {from_zero ? 0.0 : step(random)};
  if (axis == AxisId::kAzimuth) nodes = {0.0};
  while (nodes.size() < size) nodes.push_back(nodes.back() + step(random));
  if (axis == AxisId::kAzimuth && size > 1) {
    for (double& node : nodes) node *= 90 / nodes.back();
    nodes.back() = 90;
  }
  return nodes;
}

}  // namespace

UncertaintyTable RoughTable(std::uint32_t seed, Scale scale) {
  std::mt19937 random(seed);
  std::vector<Axis> axes;
  for (const AxisId axis : kAxes) axes.push_back(MakeAxis(axis, Nodes(axis, random)));
  const UncertaintyTable::Axes all = {axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]};
  std::uniform_real_distribution<float> logarithm(std::log(0.001f), 0.0f), bias(-1, 1);
  UncertaintyTable::Variables variables;
  for (const Quantity quantity : kQuantities) {
    const bool is_bias = Describe(quantity).is_bias;
    Variable variable{.values = std::vector<float>(ValueCount(all, quantity)),
                      .standard_errors = std::vector<float>(ValueCount(all, quantity)),
                      .scale = is_bias ? Scale::kLinear : scale};
    for (float& value : variable.values) value = is_bias ? bias(random) : std::exp(logarithm(random));
    for (float& error : variable.standard_errors) error = std::exp(logarithm(random));
    variables[Index(quantity)] = std::move(variable);
  }
  return UncertaintyTable::Create(all, std::move(variables), TinyTable().provenance()).value();
}

Corners CornersAround(const UncertaintyTable& table, Quantity quantity, const std::array<float, kAxisCount>& at) {
  const Variable& variable = *table.variable(quantity);
  std::vector<std::size_t> rows = {0};
  const std::size_t dimensions = Describe(quantity).over_last_axis ? kAxisCount : kAxisCount - 1;
  for (std::size_t i = 0; i < dimensions; ++i) {
    const Axis& axis = table.axes()[i];
    const std::size_t lower = axis.Locate(at[i]).value().lower;
    std::vector<std::size_t> finer;
    for (const std::size_t row : rows) {
      finer.push_back(row * axis.size() + lower);
      finer.push_back(row * axis.size() + std::min(lower + 1, axis.size() - 1));
    }
    rows = std::move(finer);
  }
  Corners corners;
  for (const std::size_t row : rows) {
    corners.values.push_back(variable.values[row]);
    if (!variable.standard_errors.empty()) corners.standard_errors.push_back(variable.standard_errors[row]);
  }
  return corners;
}

}  // namespace albtpu::testing
