#include "generator/patch_window.h"

#include <cassert>
#include <vector>

namespace albtpu {

float* PatchWindow::Workspace::Floats(std::size_t count) {
  if (count > count_) {
    floats_ = hwy::AllocateAligned<float>(count);
    count_ = count;
  }
  return floats_.get();
}

PatchWindow::PatchWindow(const WavePatchModel& patch, int points)
    : points_(points), spacing_(static_cast<float>(patch.spacing())), patch_(&patch) {
  assert(points > 0 && points % 2 == 1 && points < patch.size());
}

void PatchWindow::Draw(const NormalStream& stream, std::span<float> heights, Workspace&) const {
  assert(heights.size() == static_cast<std::size_t>(points_) * points_);
  const std::vector<double> patch = patch_->Draw(stream);
  const int size = patch_->size(), first = size - (points_ - 1) / 2;
  for (int ix = 0; ix < points_; ++ix) {
    for (int iy = 0; iy < points_; ++iy) {
      heights[static_cast<std::size_t>(ix) * points_ + iy] = static_cast<float>(
          patch[static_cast<std::size_t>((first + ix) % size) * size + (first + iy) % size]);
    }
  }
}

}  // namespace albtpu
