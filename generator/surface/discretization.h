// The choice of the resolution with which a sea is modelled under a beam, from the spectrum and the footprint.
#pragma once

#include <vector>

#include "generator/surface/beam.h"
#include "generator/surface/sea_surface.h"
#include "sea/sea_state.h"

namespace albtpu {

// A footprint that averages the waves down to less than this fraction of their mean square slope sees practically still
// water. The discretization is not refined to resolve the remainder, which is negligible in the results.
inline constexpr double kMinSeenFraction = 3e-5;

// The maximum number of rays of a beam. With so many rays of a gaussian beam, the outermost on opposite sides are about
// half of the narrowest patch apart, beyond which lags on the periodic patch are not unique.
inline constexpr int kMaxRays = 64000;

// The discretization with which doubling the patch, halving the spacing or doubling the rays changes refraction, THU
// and TVU by less than 1 %. It starts coarse and refines
//   * the grid, until the waves too short for it have less than 0.05 % of the slope variance over the footprint (a
//     footprint much wider than the waves averages them out except near its edge);
//   * the patch, until the slope variances of modes and plane waves over the footprint, along and across the wind,
//     agree with the closed form within 0.15 % of their mean, for the outermost beams;
//   * the rays, until waves too short for their spacing add less than some 1.5 % to that variance.
// `beams` share footprint, profile and source; not empty.
Discretization ChooseDiscretization(const SeaState& sea, const std::vector<BeamOptions>& beams);

// The beam of the largest incidence, whose footprint on the water is the widest.
const BeamOptions& WidestBeam(const std::vector<BeamOptions>& beams);

// A beam of the smallest incidence, and those of the largest incidence with the smallest and the largest azimuth. The
// waves in the footprints of the beams in between lie between theirs.
std::vector<BeamOptions> OutermostBeams(const std::vector<BeamOptions>& beams);

// The slope variance of a surface's facets over the footprint, divided by that of the closed form; the minimum of all
// beams.
double FootprintSlopeFraction(const SeaState& sea, const SurfaceModel& model, const std::vector<BeamOptions>& beams);

}  // namespace albtpu
