// A collimated beam through one piece of sea surface, several rays at a time in single precision.
//
// Geometry and means are those of ray_tracer.h, its slow twin. Single precision is enough because all numbers are
// small: positions and heights are relative to the point where the axis of the beam meets the water, and the sums are
// of departures from still water, computed without cancellation.
#pragma once

#include <Eigen/Core>

#include "generator/kernels/ray_bundle.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {

// Runs on the best instruction set of this machine, on which the result depends by rounding.
TracedBundle TracePackets(const RayBundle& rays, const HeightView& surface);

// The same without the unshifted means: the single-precision twin of Trace(rays, surface, refractive_index).
TracedBeam Trace(const RayBundle& rays, const HeightView& surface);

}  // namespace albtpu
