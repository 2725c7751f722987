#include "generator/kernels/fast_patch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

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

// The amplitudes of a group of columns. The random words of several rows are computed first and turned into normal
// numbers afterwards: row by row, each step would wait for the chain of operations before it.
void DrawGroup(const PatchTransform& patch, const NormalLanes& normals, int group, float* even, float* odd) {
  constexpr std::size_t kRowsAtOnce = 16;
  const Floats f;
  const Words w;
  const std::size_t rows = patch.size;
  for (std::size_t first = 0; first < rows; first += kRowsAtOnce) {
    const std::size_t last = std::min(first + kRowsAtOnce, rows);
    HWY_ALIGN std::uint32_t words[kRowsAtOnce][4 * kSeries];
    for (std::size_t row = first; row < last; ++row) {
      for (std::size_t lane = 0; lane < kSeries; lane += hn::MaxLanes(f)) {
        WordLanes word[4];
        normals.Philox(patch.parts[row], static_cast<std::uint32_t>(group * kSeries + lane), word);
        for (int i = 0; i < 4; ++i) hn::Store(word[i], w, words[row - first] + i * kSeries + lane);
      }
    }
    const float* scale = &patch.scale[(group * rows + first) * PatchTransform::kGroup];
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

// Column 0 holds both halves of its modes: those of the lower half must be the conjugates of those of the upper.
void MirrorFirstColumn(const PatchTransform& patch, float* even) {
  for (int i = 1; i < patch.half; ++i) {
    const float* upper = even + kElement * patch.columns.Place(i);
    float* lower = even + kElement * patch.columns.Place(patch.size - i);
    lower[0] = upper[0];
    lower[kSeries] = -upper[kSeries];
  }
}

// Gathers the modes of eight of the drawn rows, one element for each mode.
void GatherRows(const PatchTransform& patch, const float* row, float* modes) {
  for (int group = 0; group < patch.groups; ++group) {
    for (std::size_t c = 0; c < 2 * kElement; c += 4, row += 4) {  // even re, even im, odd re, odd im
      const std::size_t odd = c / kElement, im = c / kSeries % 2, column = c % kSeries;
      const std::size_t mode = static_cast<std::size_t>(group) * PatchTransform::kGroup + 2 * column + odd;
      FourColumnsToLanes(row, patch.row_stride, modes + kElement * mode + kSeries * im, 2 * kElement);
    }
  }
  // The mode at half the sampling wavenumber is empty.
  std::fill_n(modes + kElement * patch.half, kElement, 0.0f);
}

// The transform from modes X to `size` real numbers x becomes a complex transform of half the length. With
// w = exp(2 pi i / size), E = X[k] + conj X[half - k] and O = w^k (X[k] - conj X[half - k]) are the modes of the even
// and the odd points, so the modes of x[2 m] + i x[2 m + 1] are E + i O at k and conj E + i conj O at half - k.
void FoldModes(const PatchTransform& patch, const float* modes, float* folded) {
  for (int k = 0; 2 * k <= patch.half; ++k) {
    const ComplexLanes x = LoadElement(modes + kElement * k);
    const ComplexLanes y = LoadElement(modes + kElement * (patch.half - k));
    const ComplexLanes e = {hn::Add(x.re, y.re), hn::Sub(x.im, y.im)};
    const ComplexLanes o =
        Times(patch.half_turn[2 * k], patch.half_turn[2 * k + 1], {hn::Sub(x.re, y.re), hn::Add(x.im, y.im)});
    StoreElement(PlusI(e, o), folded + kElement * patch.rows.Place(k));
    if (k == 0) continue;
    StoreElement({hn::Add(e.re, o.im), hn::Sub(o.re, e.im)}, folded + kElement * patch.rows.Place(patch.half - k));
  }
}

void DrawPatch(const PatchTransform& patch, const NormalStream& stream, float* memory, float* heights) {
  float *even = memory, *odd = even + patch.block, *spectrum = odd + patch.block;
  const NormalLanes normals(stream);
  const int last = patch.first + patch.points;
  for (int group = 0; group < patch.groups; ++group) {
    DrawGroup(patch, normals, group, even, odd);
    if (group == 0) MirrorFirstColumn(patch, even);
    float* to = spectrum + 2 * kElement * group;
    const auto at = [&](int row) { return to + (row - patch.first) * patch.row_stride; };
    Transform(patch.columns, even, patch.first, last, at);
    Transform(patch.columns, odd, patch.first, last, [&](int row) { return at(row) + kElement; });
  }

  // Eight rows at a time; surplus rows are zero.
  std::fill_n(spectrum + patch.points * patch.row_stride, (kSeries - 1) * patch.row_stride, 0.0f);
  const int begin = patch.first / 2, end = (last + 1) / 2;                            // pairs of points
  const std::size_t line = (2 * static_cast<std::size_t>(end - begin) + 11) / 8 * 8;  // room for four more
  for (int row = 0; row < patch.points; row += kSeries) {
    float *modes = even, *folded = odd;
    GatherRows(patch, spectrum + row * patch.row_stride, modes);
    for (std::size_t lane = 0; lane < kSeries; lane += hn::MaxLanes(Series()))
      FoldModes(patch, modes + lane, folded + lane);
    Transform(patch.rows, folded, begin, end, [&](int pair) { return modes + kElement * (pair - begin); });

    float* lines = folded;
    for (int pair = 0; pair < end - begin; pair += 2)
      FourLanesToColumns(modes + kElement * pair, kSeries, lines + 2 * pair, line);
    for (int r = row; r < std::min(row + static_cast<int>(kSeries), patch.points); ++r, lines += line)
      std::copy_n(lines + patch.first % 2, patch.points, heights + static_cast<std::size_t>(r) * patch.points);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace albtpu
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace albtpu {
namespace {
HWY_EXPORT(DrawPatch);
}  // namespace

PatchTransform::PatchTransform(const WavePatchModel& patch, int drawn_points)
    : size(patch.size()),
      half(size / 2),
      points(drawn_points),
      first(half - points / 2),
      groups((half + kGroup - 1) / kGroup),
      columns(size),
      rows(half),
      block(LaneFft::kElement * static_cast<std::size_t>(std::max(size, groups * kGroup + 1))),
      // One group more than needed, so that patches of 2^n points do not have a stride of 2^n, for the cache.
      row_stride(2 * LaneFft::kElement * static_cast<std::size_t>(groups + 1)),
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

float* FastPatch::Workspace::Floats(std::size_t count) {
  if (count > count_) {
    floats_ = hwy::AllocateAligned<float>(count);
    count_ = count;
  }
  return floats_.get();
}

FastPatch::FastPatch(const WavePatchModel& patch, int points)
    : transform_(patch, points), spacing_(static_cast<float>(patch.spacing())) {}

void FastPatch::Draw(const NormalStream& stream, std::span<float> heights, Workspace& workspace) const {
  assert(heights.size() == static_cast<std::size_t>(transform_.points) * transform_.points);
  HWY_DYNAMIC_DISPATCH(DrawPatch)(transform_, stream, workspace.Floats(transform_.workspace), heights.data());
}

}  // namespace albtpu
#endif
