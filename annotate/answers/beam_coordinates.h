// Coordinates that follow from the directions of beam and wind, and from the size of the beam.
#pragma once

namespace albtpu::annotate {

// The diameter [m], across its axis, of a beam with full divergence `divergence` [mrad] where it meets the mean
// surface, `altitude` [m] below the aircraft: H / cos(incidence) * divergence. `incidence` is in degrees.
double FootprintDiameter(double altitude, double divergence, double incidence);

// The azimuth [degree], from downwind, of a beam that travels towards `beam_azimuth`, in a wind that comes from
// `wind_from`: both in degrees, true, clockwise from north. Downwind is where the wind blows to.
double AzimuthFromDownwind(double beam_azimuth, double wind_from);

}  // namespace albtpu::annotate
