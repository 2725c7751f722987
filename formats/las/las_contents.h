// What a LAS or LAZ file holds, for people who have yet to say what it is: its points by class with their heights, the
// times, the returns and the scan.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/crs/map_frame.h"
#include "formats/las/las_points.h"
#include "formats/las/las_reader.h"

namespace albtpu::formats {

// The points of one class. Heights are in the unit of the file.
struct LasClassContents {
  std::uint64_t points = 0;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  double sum = 0;

  double mean_height() const { return sum / static_cast<double>(points); }
};

enum class ScanPattern { kUnknown, kPalmer, kRaster };

struct LasContents {
  std::array<LasClassContents, kClassCount> classes;
  std::uint64_t points = 0, of_several = 0;
  int most_returns = 0;  // Of a pulse.
  // Neighbouring points of one pulse that differ by 1 or more in height, the lower one of a class that the bottom
  // usually has, the other neither noise nor of a class of the water surface.
  std::uint64_t pairs = 0;
  // GPS times (LasPointFields::GpsTime), those that are times (IsNoTime); meaningless where the file has none.
  double first_time = std::numeric_limits<double>::infinity(), last_time = -first_time;
  double least_angle = 0, greatest_angle = 0;    // Scan angles, degree.
  std::array<std::uint64_t, 721> by_angle = {};  // Points by the quarters of a degree of |scan angle|.
  std::uint64_t backwards = 0;                   // Points scanned from right to left, by their flag.

  // False where the format has no times, and where no time differs from 0 or from the others.
  bool has_times() const { return first_time < last_time; }
  // The classes that have points, of `candidates` those.
  std::vector<int> ClassesWithPoints() const;
  std::vector<int> Of(const std::set<int>& candidates) const;

  // As far as scan angles and direction flags tell. A raster has flags of both directions, or angles that are as
  // frequent near the vertical as at the edges. A palmer scanner draws ellipses: its angle across the track is that of
  // a point on a circle, so that only a third of the points lies within half of the greatest angle.
  ScanPattern scan_pattern() const;
};

// Reads all points, or the first ones. Memory does not grow with their number.
absl::StatusOr<LasContents> ReadContents(const LasReader& reader,
                                         std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

// The system identifier and the generating software of the header, as "RIEGL VQ-880-G, RiPROCESS"; empty if there are
// none. Characters that cannot be printed are left to the caller.
std::string SoftwareOf(const LasReader& reader);

// The vertical coordinate system in words: its name in well-known text, or "EPSG:5703". Empty if none is stated.
std::string VerticalNameOf(const CrsDescription& description);

}  // namespace albtpu::formats
