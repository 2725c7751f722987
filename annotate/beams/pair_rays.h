// The rays in air of pairs of returns, over the water surface that is known there.
#pragma once

#include <span>
#include <vector>

#include "annotate/beams/local_frame.h"
#include "annotate/beams/water_heights.h"
#include "budget/beams/return_pair.h"

namespace albtpu::annotate {

// `pairs` are in order of time and in the local frame. Of the pairs of one pulse, the longest that makes a ray counts.
// `index` is that of the water.
std::vector<AirRay> RaysOfPairs(std::span<const ReturnPair> pairs, const WaterHeights& water,
                                const LocalFrame& frame, double index);

}  // namespace albtpu::annotate
