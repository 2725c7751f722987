// Frames of the virtual tank one by one: what the light under the waves looks like, and how it goes on.
#pragma once

#include <cstdint>
#include <vector>

#include "generator/validation/study.h"

namespace albtpu {

// Where the light of one frame falls at the depth of the array, 2 m/s, nadir.
DataTable LightUnderWaves(std::uint64_t seed);

// The array at nadir in `frames` frames of one evolving water, 20 a second as in the laboratory.
DataTable SuccessiveFramesByWind(const std::vector<double>& winds, int frames, std::uint64_t seed);

}  // namespace albtpu
