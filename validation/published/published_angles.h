// Tables 3 and 4 of the paper: 2 sigma refraction angles, simulated and measured, over wind and incidence.
#pragma once

#include <filesystem>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu {

// Numbers as printed: wind in m/s, angles in degrees, for every wind at every incidence.
struct PublishedAngles {
  struct Cell {
    double along, cross;  // 2 sigma, along and across the wind
    // False where the text copy of the paper is damaged and the number is a guess.
    bool along_is_clean = true, cross_is_clean = true;
  };

  std::vector<double> wind_speeds, incidences;  // increasing
  std::vector<Cell> cells;                      // incidence varies fastest

  const Cell& At(std::size_t wind_speed, std::size_t incidence) const {
    return cells[wind_speed * incidences.size() + incidence];
  }
};

absl::StatusOr<PublishedAngles> ReadTable3(const std::filesystem::path& published);
absl::StatusOr<PublishedAngles> ReadTable4(const std::filesystem::path& published);

}  // namespace albtpu
