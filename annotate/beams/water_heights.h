// The points of a part of a file, and the height of the water surface at each of them, from the sources that the user
// allows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "annotate/beams/file_track.h"
#include "budget/beams/return_pair.h"
#include "budget/beams/water_surface.h"
#include "formats/trajectories/water_levels.h"

namespace albtpu::annotate {

// The chosen points of a part of a file as columns, in the coordinates of the file.

// Element i of each column belongs to point i. Columns that the source of the incidence does not need may be empty.
struct SurveyPoints {
  std::vector<double> x, y;           // In the horizontal unit of the file: metres, feet or degrees.
  std::vector<double> z;              // In the vertical unit.
  std::vector<double> times;          // GPS time as the file states it.
  std::vector<double> scan_angles;    // degree, positive to the right of the flight direction.
  std::vector<double> pulse_surface;  // z of the return from the water surface of the same pulse; NaN if there is none.
  std::vector<std::uint8_t> dry = {};  // 1: on land, or of the water surface itself: the beam met no water before it.

  bool is_dry(std::size_t i) const { return !dry.empty() && dry[i] != 0; }

  std::size_t size() const { return z.size(); }
};

// In order of trust.
enum class SurfaceFrom : std::uint8_t {
  kPulse,  // A return from the surface, of the same pulse.
  kLocal,  // Returns from the surface nearby.
  kLevel,  // The level that the user gives.
};
inline constexpr std::size_t kSurfaceFromCount = 3;

// The number of points by the source of their surface.
class SurfaceCounts {
 public:
  void Add(SurfaceFrom from) { ++counts_[static_cast<std::size_t>(from)]; }
  void Merge(const SurfaceCounts& other);

  std::uint64_t operator[](SurfaceFrom from) const { return counts_[static_cast<std::size_t>(from)]; }
  nlohmann::ordered_json Json() const;  // {"pulse": 0, "local": 12, "level": 3}
  std::string Text() const;             // "of the same pulse at 0 points, ..."

 private:
  std::array<std::uint64_t, kSurfaceFromCount> counts_ = {};
};

// Each source may be absent.
struct WaterHeights {
  const LocalWaterSurface* surface = nullptr;         // m, in the local frame.
  const formats::WaterLevelSeries* levels = nullptr;  // In the vertical unit of the points.
  std::optional<double> level;                        // In the vertical unit of the points.
  double seconds = 1;                                 // Of a unit of the points' times, for `surface`.

  // Fills `heights` with the surface at each point, m in the vertical datum of the points; NaN where none is known. Dry
  // points are not counted.
  void At(const SurveyPoints& points, const formats::LocalFrame& frame, std::vector<double>& heights,
          SurfaceCounts& counts) const;
};

// The rays in air of pairs of returns, over the water surface that is known there.

// m; farther above the water surface, a return is not from its waves.
inline constexpr double kHighestCrest = 2;

// `pairs` are in order of time and in the local frame. Of the pairs of one pulse, the longest that makes a ray counts.
// `index` is that of the water.
//
// An upper return that is not of the bottom may come from a trough of the waves. It lies on the way in air, and its
// direction to the bottom is wrong by as much as refraction turns the beam. Where returns come from crests as well, at
// most kHighestCrest above the surface, only those count that lie deeper than troughs of the same waves.
std::vector<AirRay> RaysOfPairs(std::span<const ReturnPair> pairs, const WaterHeights& water,
                                const formats::LocalFrame& frame, double index);

}  // namespace albtpu::annotate
