// The part of a patch of short waves under a beam, drawn in single precision. Its slow twin is WavePatchModel::Draw.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "generator/kernels/lane_fft.h"
#include "generator/math/random_stream.h"
#include "generator/surface/wave_patch.h"

namespace albtpu {

// The constants of all draws: the scales of the modes, the transforms, and the layout in memory.
//
// Columns of modes are processed in groups of sixteen: an element (see LaneFft) of the eight even columns, then one of
// the eight odd columns. This is the order of the normal numbers, four of which make two neighbouring modes.
struct PatchTransform {
  PatchTransform(const WavePatchModel& patch, int drawn_points);

  static constexpr int kGroup = 2 * LaneFft::kSeries;

  int size, half,
      points;       // points along a side of the patch, half of them, and those of the part that is drawn
  int first;        // row and column where the drawn part begins; its centre is at `half`
  int groups;       // of columns; surplus columns of the last one are zero
  LaneFft columns;  // of `size`
  LaneFft rows;     // of `half`: even points are the real parts, odd points the imaginary parts
  // Rows of modes are stored in the input order of `columns`. The part of the random stream for each of them.
  std::vector<std::uint32_t> parts;
  // The factors of the normal numbers, for each group, row and column (eight even columns first): the square root of
  // half the power, with the sign (-1)^(i + j) that moves the patch's point (0, 0) to the centre.
  std::vector<float> scale;
  std::vector<float> half_turn;  // exp(2 pi i k / size) for k from 0 to half / 2

  // Lengths in floats: of a block, which holds half a group of columns or eight rows; from one row of modes to the
  // next; of the whole workspace, which is two blocks and the rows, their number rounded up to a multiple of eight.
  std::size_t block, row_stride, workspace;
};

// The square of `points` x `points` grid points about the point (0, 0) of a patch, which repeats periodically.
// Immutable; may draw on many threads at once, each with its own workspace.
class FastPatch {
 public:
  // `points` is odd and less than the size of the patch, which is at least 4 and has no prime factor above 5.
  FastPatch(const WavePatchModel& patch, int points);

  int points() const { return transform_.points; }
  float spacing() const { return spacing_; }  // m

  // Reusable memory for drawing. It grows to what the largest patch needs.
  class Workspace {
   public:
    float* Floats(std::size_t count);  // aligned for vectors, uninitialized

   private:
    hwy::AlignedFreeUniquePtr<float[]> floats_;
    std::size_t count_ = 0;
  };

  // Elevations [m] of the points, ix slow: the surface that WavePatchModel::Draw gives for `stream`, up to rounding.
  void Draw(const NormalStream& stream, std::span<float> heights, Workspace& workspace) const;

 private:
  PatchTransform transform_;
  float spacing_;
};

}  // namespace albtpu
