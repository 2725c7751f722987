// The vertical error of a point of sloping terrain, where its horizontal error counts, too.
//
// A point is reported at P + e, with the errors e_h horizontally and e_z up. A model of the terrain that is made of
// such points has the height P_z + e_z at the place P_h + e_h, where the terrain has P_z + g . e_h, with its gradient
// g. The error of the height at a fixed place is therefore e_z - g . e_h = N . e, N = (-g, 1), and its variance
//     N^T C N = C_zz - 2 g^T c_hz + g^T C_hh g.
// The covariance c_hz matters: an error along the beam moves a point down and outwards, which on a slope that falls
// outwards is less of an error than its vertical part alone.
//
// The footprint: an echo may come from any part of it, and is reported on the axis of the beam u. A part at the
// distance d across the beam, d . u = 0, lies on the plane N . p = 0 at the range -(N . d) / (N . u) from where the
// axis meets it. Reported on the axis at that range, its error of height is N . e = -(N . d). With the standard
// deviation s of the irradiance along any diameter its variance is s^2 (|N|^2 - (N . u)^2): s tan(slope) of a vertical
// beam, s sin(incidence) of level land. A footprint is the diameter at which the irradiance of a Gaussian beam falls
// to 1/e^2, which is 4 s; a uniform one has 4 s, too. It is the spread of echoes of few photons; a detector that finds
// the middle of a strong echo does better, so that this part is an upper bound.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace albtpu {

struct TerrainGradient {  // m of height per m
  double north = 0, east = 0;
};

// The gradient on the axes of a map grid, whose y axis has the true azimuth `convergence` [rad].
inline TerrainGradient OfGrid(double x, double y, double convergence) {
  const double c = std::cos(convergence), s = std::sin(convergence);
  return {c * y - s * x, s * y + c * x};
}

// N^T C N of a covariance NN EE DD NE ND ED, m^2; down is negative height, so that N is (g, 1) on these axes.
inline double HeightVariance(const std::array<double, 6>& c, const TerrainGradient& g) {
  const double variance = g.north * g.north * c[0] + g.east * g.east * c[1] + c[2] +
                          2 * (g.north * g.east * c[3] + g.north * c[4] + g.east * c[5]);
  return std::max(variance, 0.0);
}

// g^T C_hh g alone.
inline double SlopeVariance(const std::array<double, 6>& c, const TerrainGradient& g) {
  return std::max(g.north * g.north * c[0] + g.east * g.east * c[1] + 2 * g.north * g.east * c[3], 0.0);
}

// Of the footprint, m^2. `footprint`: diameter across the beam, m; angles of the beam in degrees, of air.
inline double FootprintVariance(double footprint, double incidence, double azimuth, const TerrainGradient& g) {
  constexpr double kPerDegree = std::numbers::pi / 180;  // rad
  const double outwards = std::sin(incidence * kPerDegree);
  const double along = outwards * (std::cos(azimuth * kPerDegree) * g.north + std::sin(azimuth * kPerDegree) * g.east) +
                       std::cos(incidence * kPerDegree);
  const double across = std::max(1 + g.north * g.north + g.east * g.east - along * along, 0.0);
  return footprint * footprint / 16 * across;
}

}  // namespace albtpu
