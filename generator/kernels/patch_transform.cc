#include "generator/kernels/patch_transform.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace albtpu {

PatchTransform::PatchTransform(const WavePatchModel& patch, int points_of_window)
    : size(patch.size()),
      half(size / 2),
      points(points_of_window),
      first(half - points / 2),
      groups((half + kGroup - 1) / kGroup),
      columns(size),
      rows(half),
      block(LaneFft::kElement * static_cast<std::size_t>(std::max(size, groups * kGroup + 1))),
      row_stride(2 * LaneFft::kElement *
                 static_cast<std::size_t>(groups + 1)),  // no power of 2, for the cache
      workspace(2 * block + (points + LaneFft::kSeries - 1) * row_stride) {
  assert(points > 0 && points % 2 == 1 && points < size);
  std::vector<int> row_at(size);
  for (int row = 0; row < size; ++row) row_at[columns.Place(row)] = row;
  for (const int row : row_at) parts.push_back(WavePatchModel::PartOfRow(SignedIndex(row, size)));
  scale.reserve(static_cast<std::size_t>(groups) * size * kGroup);
  for (int group = 0; group < groups; ++group) {
    for (const int row : row_at) {
      for (int c = 0; c < kGroup; ++c) {
        const int series = static_cast<int>(LaneFft::kSeries);
        const int column = group * kGroup + 2 * (c % series) + c / series;
        const double power = column < half ? patch.power(row, column) : 0;
        scale.push_back(static_cast<float>(((row + column) % 2 == 0 ? 1 : -1) * std::sqrt(power / 2)));
      }
    }
  }
  for (int k = 0; 2 * k <= half; ++k) {
    half_turn.push_back(static_cast<float>(std::cos(2 * std::numbers::pi * k / size)));
    half_turn.push_back(static_cast<float>(std::sin(2 * std::numbers::pi * k / size)));
  }
}

}  // namespace albtpu
