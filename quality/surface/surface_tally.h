// The summary of a surface: sums over its nodes.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>

#include "quality/surface/surface_tile.h"
#include "tables/s44.h"

namespace albtpu::quality {

struct SurfaceTally {
  std::uint64_t nodes = 0, points = 0, left_out = 0;
  std::uint64_t dry = 0, of_land = 0, of_both = 0;  // Dry points; nodes of such alone, and nodes of both kinds.
  std::array<std::uint64_t, kS44Orders.size() + 1> orders = {};
  double pulse = 0, sea = 0, line = 0, survey = 0;  // Variances, m^2.
  double uncertainty = 0, independent = 0;          // At 95 %, m: as it is, and if points were independent.
  double mean_of_points = 0;                        // At 95 %, m: the mean TVU of the points.
  double squares = 0, predicted = 0;                // Of deviations: sample and prediction, m^2, each times n - 1.
  double chi_square = 0, degrees = 0;

  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  // Elevations, m.

  void Add(const SurfaceNode& node);
  // The members of surface.json that are of nodes.
  nlohmann::ordered_json ToJson() const;
};

}  // namespace albtpu::quality
