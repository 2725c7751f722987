// The numbers of generator/kernels/normal_lanes-inl.h as a function.
#pragma once

#include <span>

#include "generator/math/random_stream.h"

namespace albtpu {

// Fills `normals` with the first numbers of the stream's part, whatever was drawn from it before. They differ from
// those of NormalStream::Fill by rounding, and therefore also between instruction sets.
void FillInSinglePrecision(const NormalStream& stream, std::span<float> normals);

}  // namespace albtpu
