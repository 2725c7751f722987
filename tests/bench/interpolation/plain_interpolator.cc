#include "tests/bench/interpolation/plain_interpolator.h"

#include <algorithm>
#include <cmath>

namespace albtpu::bench {

template <Quantities kLayout>
PlainInterpolator<kLayout>::PlainInterpolator(const UncertaintyTable& table) {
  std::size_t step = 1;
  for (std::size_t axis = kAxisCount; axis-- > 0;) {
    PlainAxis& plain = axes_[axis];
    plain.nodes = table.axes()[axis].nodes();
    plain.log = table.axes()[axis].scale() == Scale::kLog;
    plain.step = step;
    step *= plain.nodes.size();
    if (!plain.log) continue;
    for (double& node : plain.nodes) node = std::log(node);
  }
  if (kLayout == Quantities::kSideBySide) side_by_side_.resize(step * kQuantities);
  for (std::size_t q = 0; q < kQuantities; ++q) {
    const std::vector<float>& values = table.variable(albtpu::kQuantities[2 + q])->values;
    if (kLayout == Quantities::kApart) apart_[q] = values;
    for (std::size_t i = 0; i < side_by_side_.size() / kQuantities; ++i) side_by_side_[i * kQuantities + q] = values[i];
  }
}

template <Quantities kLayout>
void PlainInterpolator<kLayout>::Answer(const PulseColumns& pulses, std::size_t begin, std::size_t end,
                                        const std::array<float*, kQuantities>& answers) const {
  constexpr std::size_t kCorners = std::size_t{1} << kAxisCount;
  for (std::size_t i = begin; i < end; ++i) {
    std::array<std::size_t, kCorners> index{};
    std::array<double, kCorners> weight;
    weight[0] = 1;
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
      const PlainAxis& plain = axes_[axis];
      const std::span<const float> column = pulses.axis[axis];
      double x = column[column.size() == 1 ? 0 : i];
      if (plain.log) x = std::log(x);
      const auto above = std::upper_bound(plain.nodes.begin() + 1, plain.nodes.end() - 1, x);
      const auto lower = static_cast<std::size_t>(above - plain.nodes.begin()) - 1;
      const double fraction = (x - plain.nodes[lower]) / (plain.nodes[lower + 1] - plain.nodes[lower]);
      for (std::size_t corner = 0; corner < count; ++corner) {
        index[corner] += lower * plain.step;
        index[count + corner] = index[corner] + plain.step;
        weight[count + corner] = weight[corner] * fraction;
        weight[corner] *= 1 - fraction;
      }
      count *= 2;
    }
    std::array<double, kQuantities> sum{};
    for (std::size_t corner = 0; corner < kCorners; ++corner) {
      for (std::size_t q = 0; q < kQuantities; ++q)
        if constexpr (kLayout == Quantities::kApart)
          sum[q] += weight[corner] * apart_[q][index[corner]];
        else
          sum[q] += weight[corner] * side_by_side_[index[corner] * kQuantities + q];
    }
    for (std::size_t q = 0; q < kQuantities; ++q) answers[q][i] = static_cast<float>(sum[q]);
  }
}

template class PlainInterpolator<Quantities::kApart>;
template class PlainInterpolator<Quantities::kSideBySide>;

}  // namespace albtpu::bench
