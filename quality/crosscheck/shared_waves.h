// What two pulses of one line share of the waves: the correlations of the sea's shares in their heights.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "quality/seas/sea_of_pulses.h"
#include "quality/seas/sea_sharing.h"
#include "quality/seas/seas_of_files.h"
#include "sea/correlation/moving_waves.h"

namespace albtpu::quality {

// A point of the bottom and its beam. Angles in degree, as annotated files have them.
struct PointOfBeam {
  double x = 0, y = 0, depth = 0;     // m; east and north.
  double incidence = 0, azimuth = 0;  // In air; the direction of travel, clockwise from north.
  double footprint = 0;               // m
};

// Where and when a pulse met the water.
struct PulseOnWater {
  static constexpr std::uint16_t kNoSea = std::numeric_limits<std::uint16_t>::max();

  // `time` in s, 0 where it is not known; `sea` of SharedWaves::Add(), or kNoSea.
  static PulseOnWater Of(const PointOfBeam& point, double time, std::uint16_t sea);

  double x = 0, y = 0, time = 0;
  float along_x = 0, along_y = 0;  // The unit vector of the beam's horizontal direction.
  float tangent = 0;               // Of the angle of the refracted beam from the vertical.
  float footprint = 0;
  std::uint16_t sea = kNoSea;
};

// Pulses of different lines are minutes apart and share nothing; nor do those of different seas.
//
// The height of a point errs in proportion to the slope of the water along its beam, of which u C(dx, dt) u' is the
// covariance (sea/correlation), u and u' the directions of the two beams. At nadir, where the height errs by squares of
// slopes alone, their correlation is the square of this one; in between, by the tangent of the incidence, it is that of
// the sum of both. A pulse whose waves nobody saw also errs by their height.
// Distances are rounded to 5 cm, from 1 m on to 0.25 m, from 4 m on to 1 m, from 16 m on to 4 m and from 64 m on to
// 8 m, directions to 5 degrees, times to 0.1 s, footprints to 10 %. Not for several threads at a time.
class SharedWaves {
 public:
  // Beyond these they are taken to share nothing. Slopes have forgotten each other long before. The heights of a swell
  // of 12 s, 225 m long (JONSWAP, spread by the squared cosine), correlate by at most 0.06 from 400 m on, those of one
  // of 7 s by 0.02 from 200 m on. Nobody asks for longer pauses (kLook).
  static constexpr double kReach = 400, kPause = 2;  // m, s

  std::uint16_t Add(const SeaOfSource& sea);
  std::size_t seas() const { return seas_.size(); }

  // The correlations of what slopes do to the heights of two points, and of what heights of unseen waves do.
  SeaParts operator()(const PulseOnWater& a, const PulseOnWater& b) const;

  // What `sea` does to the pulse of `point`: nothing without a sea, or where the beam is not known.
  SeaOfPulses At(const PointOfBeam& point, std::uint16_t sea) const;

 private:
  static constexpr std::size_t kDirections = 72;  // in a turn
  // By direction: the covariance of slopes on the map and that of heights, of two pulses at one distance and time.
  struct Ring {
    std::array<Eigen::Matrix2f, kDirections> slopes;
    std::array<float, kDirections> heights;
  };
  // Of one footprint, the same of one pulse and, by steps of time and distance, of two.
  struct Footprint {
    FootprintWaves waves;
    Eigen::Matrix2d whole;
    double height;
    std::vector<std::unique_ptr<const Ring>> known;  // Null: not yet.
  };
  struct Sea {
    std::unique_ptr<const MovingWaves> waves;
    Eigen::Matrix2d to_map;
    double slope_variance;                           // Of one component, the mean of both.
    mutable std::map<int, Footprint> of_footprints;  // By steps of the logarithm.

    Footprint& FootprintOf(double width) const;
    const Ring& RingOf(Footprint& footprint, int distance, int time) const;
  };

  std::vector<Sea> seas_;
  std::unique_ptr<SeaSharing> pulses_ = std::make_unique<SeaSharing>(0);  // Of single pulses, which need no cell.
};

}  // namespace albtpu::quality
