// The part of a patch of short waves that a beam sees, drawn in single precision.
#pragma once

#include <hwy/aligned_allocator.h>

#include <cstddef>
#include <span>

#include "generator/kernels/patch_transform.h"
#include "generator/math/random_stream.h"
#include "generator/surface/wave_patch.h"

namespace albtpu {

// The square of `points` x `points` grid points about the point (0, 0) of a patch, which repeats. Immutable;
// may draw on many threads, each with a workspace of its own.
class FastPatch {
 public:
  // `points` is odd and less than the size of the patch, which is at least 4 and has no prime factor above 5.
  FastPatch(const WavePatchModel& patch, int points);

  int points() const { return plan_.points; }
  float spacing() const { return spacing_; }  // m

  // Memory for drawing, which grows to what the greatest window wants and is used again.
  class Workspace {
   public:
    float* Floats(std::size_t count);  // aligned for vectors, not initialized

   private:
    hwy::AlignedFreeUniquePtr<float[]> floats_;
    std::size_t count_ = 0;
  };

  // Elevations [m] of the points, ix slow: those of the surface that WavePatchModel::Draw gives for `stream`,
  // to rounding.
  void Draw(const NormalStream& stream, std::span<float> heights, Workspace& workspace) const;

 private:
  PatchTransform plan_;
  float spacing_;
};

}  // namespace albtpu
