// How finely a sea is modelled under a beam: chosen from the spectrum and the footprint.
#pragma once

#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"
#include "sea/sea_state.h"

namespace albtpu {

// A footprint that averages the waves down to less than this part of their mean square slope sees still water:
// nothing is refined for the sake of what it does see, and nobody needs to know it.
inline constexpr double kLeastSeenFraction = 3e-5;

// The outermost of so many rays of a gaussian beam are still as far apart as half of the patch.
inline constexpr int kMostRays = 64000;

// The discretization with which doubling the patch, halving the spacing and doubling the rays moves
// refraction, THU and TVU by less than 1 %. It starts coarse and refines
//   * the grid, until its facets cost the footprint less than 0.4 % of the slope variance that it sees (a
//     footprint much wider than the waves averages them down to what happens at its edge);
//   * the patch, until modes and plane waves together show the footprint the closed form's variance
//     within 0.5 %;
//   * the rays, until waves too short for their spacing to sample add less than some 1.5 % to it.
// `beams` share footprint, profile and source; not empty.
Discretization ChooseDiscretization(const SeaState& sea, const std::vector<BeamOptions>& beams);

// The beam of the greatest incidence, whose footprint on the water is the widest.
const BeamOptions& WidestBeam(const std::vector<BeamOptions>& beams);

// Slope variance that the facets of a surface show the footprint, over that of the closed form; the least of
// all beams.
double FootprintSlopeFraction(const SeaState& sea, const SurfaceModel& model,
                              const std::vector<BeamOptions>& beams);

}  // namespace albtpu
