// The track of a sensor through time: the interface of all tracks, and a smooth track of knots joined by cubics with
// its normal equations.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace albtpu {

// The position of the sensor at the time of each pulse, from a trajectory file or estimated from the returns.

// The position of the sensor in the coordinates of the points, and what turns differences of these coordinates into
// metres and true directions there.
struct SensorPosition {
  double x = 0, y = 0;                        // In the horizontal unit of the points: metres, feet or degrees.
  double z = 0;                               // m, in the vertical datum of the points.
  double metres_per_x = 1, metres_per_y = 1;  // True metres; the scale of a map projection is divided out.
  double north_per_x = 0;      // m to grid north in a unit of x; 0 where x and y are perpendicular on the ground.
  double convergence = 0;      // rad; the true azimuth of grid north: true azimuth = grid azimuth + convergence.
  double incidence_sigma = 0;  // rad; standard deviation of incidences that this position causes; 0: not known.
};

enum class TrackOutcome : std::uint8_t {
  kKnown,
  kOutside,    // Before the first or after the last position, or in a gap between two: nothing is extrapolated.
  kUncertain,  // Too uncertain to be used (tracks from returns).
};

class SensorTrack {
 public:
  virtual ~SensorTrack() = default;

  // The positions at `times`, GPS times as the points state them. The three spans have equal lengths. Positions are
  // valid where the outcome is kKnown. Any number of threads may call it at a time. Fast where times that follow each
  // other are close.
  virtual void PositionsAt(std::span<const double> times, std::span<SensorPosition> positions,
                           std::span<TrackOutcome> outcomes) const = 0;
};

using KnotState = Eigen::Matrix<double, 6, 1>;  // Position [m], velocity [m/s].
using KnotMatrix = Eigen::Matrix<double, 6, 6>;

// A smooth track through time: positions and velocities at knots, joined by cubics, and their normal equations.
//
// The prior of the motion is that the acceleration is white noise of the spectral density q [m^2/s^3] in each axis.
// Given the states (position, velocity) at two neighbouring knots, h apart, the mean of the motion between them is the
// cubic Hermite polynomial, its variance at the fraction s is q h^3 s^3 (1 - s)^3 / 3, and the states obey
//     d = x' - F x,  F = [1 h; 0 1],  cov d = q [h^3/3 h^2/2; h^2/2 h].
// So a cubic with velocities of its own at the knots is the exact form of the most plausible track, its normal
// equations are block tridiagonal, and between rays that are far apart the variance grows as it should: the reasons to
// prefer it to a cubic B-spline.

// The place of a time between the knots, and the weights of the position and velocity of the knots `first` and `first`
// + 1 in the position there and in its rate.
struct KnotPlace {
  std::size_t first;
  double fraction;
  std::array<double, 4> position, rate;
};

// Knots from `start`, `step` seconds apart, at least 2 of them.
struct KnotTimes {
  double start, step;
  std::size_t count;

  KnotPlace Find(double time) const;
  double TimeOf(std::size_t knot) const { return start + step * static_cast<double>(knot); }
  // Variance [m^2] of the motion between two knots around the cubic, for `density` = q.
  double BridgeVariance(double fraction, double density) const;
};

// A symmetric block tridiagonal system: information, or normal equations, of the states at knots.
struct KnotEquations {
  explicit KnotEquations(std::size_t knots);
  std::vector<KnotMatrix> diagonal;
  std::vector<KnotMatrix> upper;  // [k] belongs to the knots k and k + 1.
  std::vector<KnotState> right;

  // Adds the information `information` (3 x 3, 1/m^2) on the position at `place`.
  void AddPosition(const KnotPlace& place, const Eigen::Matrix3d& information);
  // Adds the prior of the motion; `right` becomes the negative gradient of the prior's cost at `states`.
  void AddMotion(double step, double density, const std::vector<KnotState>& states);
};

struct KnotSolution {
  std::vector<KnotState> states;
  std::vector<KnotMatrix> covariance;       // Diagonal blocks of the inverse.
  std::vector<KnotMatrix> covariance_next;  // Blocks of the knots k and k + 1.
  // Covariance of the position at `place`.
  Eigen::Matrix3d PositionCovariance(const KnotPlace& place) const;
};

// Solves the equations and inverts their matrix on its band, by block elimination; its cost is linear in the knots.
KnotSolution Solve(const KnotEquations& equations);

// The sum of d' C^-1 d over all steps with q = 1, and its expectation over `solution`'s covariance added: what
// the expectation-maximization step for q divides by 6 per step.
double MotionRoughness(double step, const std::vector<KnotState>& states, const KnotSolution& solution);

}  // namespace albtpu
