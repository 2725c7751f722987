// Small square patches of the bottom that several lines saw, found in one reading of the points and filled in a second
// one, and the pairs of neighbouring points in them, of two lines and of one.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "quality/annotated/annotated_points.h"
#include "quality/crosscheck/flight_lines.h"
#include "quality/crosscheck/shared_waves.h"
#include "tables/coverage.h"

namespace albtpu::quality {

// A point of a line in a patch. Lengths in m, variances in m^2 at 1 sigma. Its predicted bias is taken away: beams of
// other incidences have other ones.
struct PatchPoint {
  float x = 0, y = 0, z = 0;  // From the centre of the patch; z from the datum.
  // Of the height: what is drawn anew for each pulse (air side and sea), and what its line shares.
  float variance_air = 0, variance_sea = 0, variance_line = 0;
  // The horizontal entries of the same covariance, m^2, and the sea's part of them (0 to 1).
  float xx = 0, yy = 0, xy = 0, xz = 0, yz = 0, sea_in_horizontal = 0;
  float depth = 0, incidence = 0, azimuth = 0, footprint = 0;
  double time = 0;                           // s, as AnnotatedPoint::time.
  std::uint16_t line = 0;                    // Its number (FlightLines).
  std::uint16_t sea = PulseOnWater::kNoSea;  // Of SharedWaves; kNoSea: not known.
};

struct Patch {
  double x = 0, y = 0;  // Of its centre, m.
  std::vector<PatchPoint> points;
};

class OverlapPatches {
 public:
  static constexpr std::size_t kMaxKnown = 1'000'000;    // Patches.
  static constexpr std::size_t kMostPoints = 1'000'000;  // In patches that are filled.

  // `side` of a patch in m, above 0. Where memory would not suffice, a part of the patches is taken, chosen by their
  // place and not by what is in them.
  OverlapPatches(double side, double metres_per_unit, Coverage coverage)
      : side_(side), metres_per_unit_(metres_per_unit), coverage_(coverage) {}

  // The first reading. Points without a number do not count.
  void Find(std::span<const AnnotatedPoint> points);
  // Between the readings: drops the patches of one line, and samples the others if they are too many.
  void Choose();
  // The second reading, of the same points, all over one sea.
  void Fill(std::span<const AnnotatedPoint> points, std::uint16_t sea);

  std::vector<Patch> Take() { return std::move(patches_); }  // In the order of their first points.

  // Of all points. Known after Choose().
  const FlightLines& lines() const { return lines_; }

  double side() const { return side_; }

  double sampled() const { return 1.0 / static_cast<double>(mask_ + 1); }  // Of the patches of several lines.

 private:
  struct Known {
    std::uint32_t points = 0;
    std::uint16_t first_id = 0;
    bool overlap = false;                                                                  // Points of several IDs.
    double first_time = std::numeric_limits<double>::infinity(), last_time = -first_time;  // s, of the first ID.
  };
  // Of the patch of a point; 0 if it is not taken.
  std::uint64_t KeyOf(const AnnotatedPoint& point) const;
  void Thin();

  double side_, metres_per_unit_;
  LineTimes times_;
  FlightLines lines_;
  Coverage coverage_;
  std::uint64_t mask_ = 0;  // Patches whose hash has none of these bits are taken.
  std::unordered_map<std::uint64_t, Known> known_;
  std::unordered_map<std::uint64_t, std::uint32_t> chosen_;  // To patches_.
  std::vector<Patch> patches_;
};

// Two neighbouring points, and how much their heights differ beyond the slope of the bottom.

// What a pair is made of. Variances in m^2, of the height above the slope.
struct PairedPoint {
  PulseOnWater pulse;
  float variance_air = 0, variance_sea = 0, variance_line = 0;
  float variance_heights = 0;  // Of the sea's: that of the heights of unseen waves.
};

// Of two lines, whose numbers are a < b, or both of one line.
struct CrossPair {
  std::uint16_t line_a = 0, line_b = 0;
  double x = 0, y = 0;             // m, of the patch.
  float difference = 0;            // m, height of a less that of b, without the slope.
  float distance = 0;              // m, horizontal.
  float variance_slope = 0;        // m^2, of the error of the slope over the distance.
  float depth = 0, incidence = 0;  // Means of both; m, degree.
  PairedPoint a, b;

  float variance_air() const { return a.variance_air + b.variance_air; }
  float variance_sea() const { return a.variance_sea + b.variance_sea; }
  float variance_line() const { return a.variance_line + b.variance_line; }
  // Of the difference of points of different lines.
  float variance() const { return variance_air() + variance_sea() + variance_line() + variance_slope; }
};

struct PatchPairs {
  std::vector<CrossPair> across;  // Of two lines.
  std::vector<CrossPair> within;  // Of one line, which share its trajectory and most waves.
};

// Of each two lines that have at least `kMinPoints` points each in `patch`, the two nearest points; and of each of
// these lines its own two nearest points that are not farther apart in time than SharedWaves::kPause. The slope is that
// of planes fitted to all points of the patch, one for each line, which are parallel: a constant height error of a line
// does not tilt it. None where the points do not define a slope.
inline constexpr std::size_t kMinPoints = 3;
void AppendPairs(Patch& patch, const SharedWaves& waves, PatchPairs& pairs);

}  // namespace albtpu::quality
