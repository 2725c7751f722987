#include "generator/kernels/fast_patch.h"

#include <algorithm>
#include <cassert>

// This file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "generator/kernels/fast_patch.cc"
#include <hwy/foreach_target.h>

#include "generator/kernels/eight_rows-inl.h"
#include "generator/kernels/lane_fft-inl.h"
#include "generator/kernels/normal_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace albtpu {
namespace HWY_NAMESPACE {
namespace {

constexpr std::size_t kSeries = LaneFft::kSeries, kElement = LaneFft::kElement;

// The amplitudes of a group of columns. Random words of some rows first, then the numbers that they become:
// of one row after the other, the chain of operations would be waited for.
void DrawGroup(const PatchTransform& plan, const NormalLanes& normals, int group, float* even, float* odd) {
  constexpr std::size_t kRowsAtOnce = 16;
  const Floats f;
  const Words w;
  const std::size_t rows = plan.size;
  for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
    const std::size_t last = std::min(first + kRowsAtOnce, rows);
    HWY_ALIGN std::uint32_t words[kRowsAtOnce][4 * kSeries];
    for (std::size_t row = first; row < last; ++row) {
      for (std::size_t lane = 0; lane < kSeries; lane += hn::MaxLanes(f)) {
        WordLanes word[4];
        normals.Philox(plan.parts[row], static_cast<std::uint32_t>(group * kSeries + lane), word);
        for (int i = 0; i < 4; ++i) hn::Store(word[i], w, words[row - first] + i * kSeries + lane);
      }
    }
    const float* scale = &plan.scale[(group * rows + first) * PatchTransform::kGroup];
    for (std::size_t row = first; row < last; ++row, scale += PatchTransform::kGroup) {
      for (std::size_t lane = 0; lane < kSeries; lane += hn::MaxLanes(f)) {
        const std::uint32_t* word = words[row - first] + lane;
        for (int parity = 0; parity < 2; ++parity, word += 2 * kSeries) {
          const NormalPair pair = BoxMuller(hn::Load(w, word), hn::Load(w, word + kSeries));
          const FloatLanes root = hn::LoadU(f, scale + parity * kSeries + lane);
          float* to = (parity == 0 ? even : odd) + kElement * row + lane;
          hn::Store(hn::Mul(root, pair.cosine), f, to);
          hn::Store(hn::Mul(root, pair.sine), f, to + kSeries);
        }
      }
    }
  }
}

// Column 0 is its own mirror: the lower half of its modes must be that of the upper.
void MirrorFirstColumn(const PatchTransform& plan, float* even) {
  for (int i = 1; i < plan.half; ++i) {
    const float* upper = even + kElement * plan.columns.Place(i);
    float* lower = even + kElement * plan.columns.Place(plan.size - i);
    lower[0] = upper[0];
    lower[kSeries] = -upper[kSeries];
  }
}

// The modes of eight rows, an element each, from the rows of the window.
void GatherRows(const PatchTransform& plan, const float* row, float* modes) {
  for (int group = 0; group < plan.groups; ++group) {
    for (std::size_t c = 0; c < 2 * kElement; c += 4, row += 4) {  // even re, even im, odd re, odd im
      const std::size_t odd = c / kElement, im = c / kSeries % 2, column = c % kSeries;
      const std::size_t mode = static_cast<std::size_t>(group) * PatchTransform::kGroup + 2 * column + odd;
      FourColumnsToLanes(row, plan.row_stride, modes + kElement * mode + kSeries * im, 2 * kElement);
    }
  }
  std::fill_n(modes + kElement * plan.half, kElement,
              0.0f);  // at half the sampling wavenumber there is nothing
}

// The transform of `size` real numbers x from their modes X is a complex one of half the length: with
// w = exp(2 pi i / size), E = X[k] + conj X[half - k] and O = w^k (X[k] - conj X[half - k]), the modes of
// x[2 m] + i x[2 m + 1] are E + i O at k and conj E + i conj O at half - k.
void FoldModes(const PatchTransform& plan, const float* modes, float* folded) {
  for (int k = 0; 2 * k <= plan.half; ++k) {
    const ComplexLanes x = LoadElement(modes + kElement * k);
    const ComplexLanes y = LoadElement(modes + kElement * (plan.half - k));
    const ComplexLanes e = {hn::Add(x.re, y.re), hn::Sub(x.im, y.im)};
    const ComplexLanes o =
        Times(plan.half_turn[2 * k], plan.half_turn[2 * k + 1], {hn::Sub(x.re, y.re), hn::Add(x.im, y.im)});
    StoreElement(PlusI(e, o), folded + kElement * plan.rows.Place(k));
    if (k == 0) continue;
    StoreElement({hn::Add(e.re, o.im), hn::Sub(o.re, e.im)},
                 folded + kElement * plan.rows.Place(plan.half - k));
  }
}

void DrawWindow(const PatchTransform& plan, const NormalStream& stream, float* memory, float* heights) {
  float *even = memory, *odd = even + plan.block, *spectrum = odd + plan.block;
  const NormalLanes normals(stream);
  const int last = plan.first + plan.points;
  for (int group = 0; group < plan.groups; ++group) {
    DrawGroup(plan, normals, group, even, odd);
    if (group == 0) MirrorFirstColumn(plan, even);
    float* to = spectrum + 2 * kElement * group;
    const auto at = [&](int row) { return to + (row - plan.first) * plan.row_stride; };
    Transform(plan.columns, even, plan.first, last, at);
    Transform(plan.columns, odd, plan.first, last, [&](int row) { return at(row) + kElement; });
  }

  // Eight rows at a time; those beyond the window's are zero.
  std::fill_n(spectrum + plan.points * plan.row_stride, (kSeries - 1) * plan.row_stride, 0.0f);
  const int begin = plan.first / 2, end = (last + 1) / 2;                             // pairs of points
  const std::size_t line = (2 * static_cast<std::size_t>(end - begin) + 11) / 8 * 8;  // room for four more
  for (int row = 0; row < plan.points; row += kSeries) {
    float *modes = even, *folded = odd;
    GatherRows(plan, spectrum + row * plan.row_stride, modes);
    for (std::size_t lane = 0; lane < kSeries; lane += hn::MaxLanes(Series())) {
      FoldModes(plan, modes + lane, folded + lane);
    }
    Transform(plan.rows, folded, begin, end, [&](int pair) { return modes + kElement * (pair - begin); });

    float* lines = folded;
    for (int pair = 0; pair < end - begin; pair += 2) {
      FourLanesToColumns(modes + kElement * pair, kSeries, lines + 2 * pair, line);
    }
    for (int r = row; r < std::min(row + static_cast<int>(kSeries), plan.points); ++r, lines += line) {
      std::copy_n(lines + plan.first % 2, plan.points, heights + static_cast<std::size_t>(r) * plan.points);
    }
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {
namespace {
HWY_EXPORT(DrawWindow);
}  // namespace

float* FastPatch::Workspace::Floats(std::size_t count) {
  if (count > count_) {
    floats_ = hwy::AllocateAligned<float>(count);
    count_ = count;
  }
  return floats_.get();
}

FastPatch::FastPatch(const WavePatchModel& patch, int points)
    : plan_(patch, points), spacing_(static_cast<float>(patch.spacing())) {}

void FastPatch::Draw(const NormalStream& stream, std::span<float> heights, Workspace& workspace) const {
  assert(heights.size() == static_cast<std::size_t>(plan_.points) * plan_.points);
  HWY_DYNAMIC_DISPATCH(DrawWindow)(plan_, stream, workspace.Floats(plan_.workspace), heights.data());
}

}  // namespace albtpu
#endif
