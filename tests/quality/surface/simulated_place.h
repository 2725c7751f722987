// A place of a simulated survey, with truth: a sloping bottom under waves that travel, which two lines see.
//
// Waves are drawn anew for every survey, and every pulse meets them at its own place and time. A pulse is refracted by
// the law of Snell at the slope that its footprint averages, and reported as processing would, with errors of its own.
// Those of its line and of the survey may be drawn many times over the same waves. No covariance of two pulses is used.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "quality/seas/sea_sharing.h"
#include "quality/surface/node.h"
#include "sea/spectra/harmonic_spectrum.h"
#include "tests/quality/surface/waves_of_two_passes.h"

namespace albtpu::quality {

enum class ScanPattern {
  kPalmer,  // an ellipse of 14 degrees ahead and 20 degrees aside: each line sees a place fore and aft
  kRaster,  // a triangular wave across the line, 20 degrees to both sides
  kRandom   // one beam of 20 degrees, at places that are drawn: what R (1 - R) / n is exact for
};

// One line over the place; the aircraft flies straight.
struct SimulatedLine {
  ScanPattern pattern;
  int number;
  double heading;  // degree clockwise from north
  double aside;    // m: of the middle of the place, to the right of the line
  double start;    // s: when it passes the place
};

// Of a line by its number, m.
struct SharedErrors {
  Eigen::Vector3d survey;
  std::map<int, Eigen::Vector3d> lines;

  void AddTo(std::vector<SurfacePoint>& points) const;
};

struct DrawnSurvey {
  // In the order of SurfacePoint::Order, without SharedErrors. Their bias is that of slopes that are drawn singly.
  std::vector<SurfacePoint> points;
  // Of the sea's share of the heights of single pulses, over their depths: sums of the drawn and of the stated ones.
  double sum = 0, squares = 0, stated = 0, n = 0;
};

// Any number of threads may use it at a time.
class SimulatedPlace {
 public:
  static constexpr double kWest = 2.5, kWidth = 25;  // m: where pulses meet the water, on both axes.
  // The bottom has all its points this far from the edge, m.
  static constexpr double kMargin = 2.5;
  static constexpr double kReach = 3.2;  // m: waves move points by 0.2 m, one standard deviation.

  // `spacing` between pulses, m. `cells` are those that nodes will be asked for. `shared` scales the errors of lines
  // and of the survey.
  SimulatedPlace(std::vector<SimulatedLine> lines, double spacing, const std::vector<double>& cells, double shared);

  // All pulses, or, where `around` has some, those that calm water sends to within kReach of one of these.
  DrawnSurvey Survey(std::uint64_t seed, std::span<const Eigen::Vector2d> around = {}) const;
  SharedErrors DrawShared(std::uint64_t seed) const;
  // What passes of a line share of the waves, x of whose sea is east.
  WavesOfTwoPasses OfTwoPasses() const;
  // Nodes of cells of a side that was named.
  NodeSources SourcesFor(double cell) const;

  static double HeightAt(const Eigen::Vector2d& at);
  // By it, an error of a point is one of the height at a fixed place.
  static Eigen::Vector3d Upward();

 private:
  const SeaSharing& SharingAt(double cell) const;

  std::vector<SimulatedLine> lines_;
  double spacing_, shared_;
  HarmonicSpectrum sea_;
  Eigen::Matrix2d slopes_;  // Covariance of those that a footprint averages.
  std::vector<std::pair<double, std::unique_ptr<SeaSharing>>> sharing_;
};

}  // namespace albtpu::quality
