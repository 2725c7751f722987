// The height of the water surface at each point, from the sources that the user allows.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "annotate/beams/local_frame.h"
#include "annotate/beams/survey_points.h"
#include "budget/beams/water_surface.h"
#include "formats/trajectories/water_level_file.h"

namespace albtpu::annotate {

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

  // Fills `heights` with the surface at each point, m in the vertical datum of the points; NaN where none is known.
  void At(const SurveyPoints& points, const LocalFrame& frame, std::vector<double>& heights,
          SurfaceCounts& counts) const;
};

}  // namespace albtpu::annotate
