// A collimated beam through one piece of sea surface, several rays at a time in single precision.
//
// The same geometry as height_field.h and the same means as ray_tracer.h, which are its slow twins. Single
// precision is enough because everything is small: positions and heights count from where the axis of the
// beam meets the water, and what is summed are departures from still water, computed without cancellation.
#pragma once

#include <Eigen/Core>

#include "generator/kernels/packet_sums.h"
#include "generator/kernels/ray_bundle.h"
#include "generator/surface/height_field.h"
#include "generator/surface/ray_tracer.h"

namespace albtpu {

// On the best instruction set of this machine. A result depends on that, by rounding, and on nothing else.
TracedBundle TracePackets(const RayBundle& rays, const HeightView& surface);

// The same without what is undisturbed: the single-precision twin of Trace(rays, surface, refractive_index).
TracedBeam Trace(const RayBundle& rays, const HeightView& surface);

}  // namespace albtpu
