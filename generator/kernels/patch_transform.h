// What there is to know before the window of a patch is drawn: scales of its modes, transforms, and where
// things lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "generator/kernels/lane_fft.h"
#include "generator/surface/wave_patch.h"

namespace albtpu {

// Columns of modes go in groups of sixteen: an element (see LaneFft) of the even ones, then one of the odd
// ones. That is how normal numbers come, four to two modes.
struct PatchTransform {
  // `points` is odd and less than the size of the patch, which is at least 4 and has no prime factor above 5.
  PatchTransform(const WavePatchModel& patch, int points);

  static constexpr int kGroup = 2 * LaneFft::kSeries;

  int size, half, points;  // of the patch, half of it, of the window
  int first;               // row and column where the window begins; its middle is at `half`
  int groups;              // of columns; what the last one has too many is zero
  LaneFft columns;         // of `size`
  LaneFft rows;            // of `half`: even points are the real parts, odd ones the imaginary
  // Rows of modes lie in the order of `columns`. The part of the stream for each of them.
  std::vector<std::uint32_t> parts;
  // Of the normals, for each group, row and column (eight even ones first): the root of half the power, with
  // the sign (-1)^(i + j) that takes the patch's point (0, 0) to the middle.
  std::vector<float> scale;
  std::vector<float> half_turn;  // exp(2 pi i k / size), k to half / 2

  // In floats: of a block that holds half a group of columns, or eight rows; from row to row of the window's
  // modes; and of the whole workspace, two blocks and these rows, rounded up to eight.
  std::size_t block, row_stride, workspace;
};

}  // namespace albtpu
