#include "generator/campaign/node_balance.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

// The nodes in the scale of their axis.
std::vector<double> Scaled(const Axis& axis) {
  std::vector<double> x = axis.nodes();
  if (axis.scale() == Scale::kLog) {
    for (double& node : x) node = std::log(node);
  }
  return x;
}

// The amount by which to lower each of the values at `x`: none at the last node and those before `first`.
std::vector<double> Lowering(const std::vector<double>& x, const std::vector<double>& values,
                             std::size_t first) {
  const std::size_t last = x.size() - 1;
  std::vector<double> lowering(x.size());
  for (std::size_t i = first; i < last; ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double curvature =
        2 * ((values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before) / (before + after);
    lowering[i] = curvature * (std::pow(before, 3) + std::pow(after, 3)) / (12 * (before + after));
  }
  return lowering;
}

}  // namespace

void BalanceNodes(const UncertaintyTable::Axes& axes, Quantity quantity, std::vector<float>& values) {
  assert(values.size() == ValueCount(axes, quantity));
  const std::vector<float> exact = values;
  std::size_t stride = values.size();  // from one node of the axis to the next
  for (const AxisId id : kAxes) {
    if (id == AxisId::kDepth) break;  // the last axis
    const Axis& axis = axes[Index(id)];
    const std::size_t nodes = axis.size();
    stride /= nodes;
    if (nodes < 3) continue;
    const std::vector<double> x = Scaled(axis);
    const std::size_t first_lowered = id == AxisId::kWindSpeed && x.front() == 0 ? 2 : 1;
    std::vector<double> line(nodes);
    for (std::size_t first = 0; first < values.size(); ++first) {
      if (first / stride % nodes != 0) continue;
      for (std::size_t i = 0; i < nodes; ++i) line[i] = values[first + i * stride];
      const std::vector<double> lowering = Lowering(x, line, first_lowered);
      for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t at = first + i * stride;
        const double lowered = line[i] - lowering[i];
        const double least = Describe(quantity).is_bias ? lowered : 0.5 * exact[at];
        values[at] = static_cast<float>(std::max(lowered, least));
      }
    }
  }
}

}  // namespace albtpu
