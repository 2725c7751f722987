// The numbers of a NormalStream in single precision, some ten times as fast.
#pragma once

#include <span>

#include "generator/math/random_stream.h"

namespace albtpu {

// The first numbers of the stream's part, whatever was taken from it before. They differ from those of Fill
// by rounding, and so from one instruction set to another.
void FillInSinglePrecision(const NormalStream& stream, std::span<float> normals);

}  // namespace albtpu
