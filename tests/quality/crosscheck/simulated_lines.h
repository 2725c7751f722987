// Points of overlapping lines with errors that are drawn from the exact model of the air side and of refraction at a
// tilted surface, and with the uncertainty that the budget predicts for what is declared.
#pragma once

#include <cstdint>
#include <vector>

#include "budget/air/air_errors.h"
#include "quality/annotated/annotated_points.h"

namespace albtpu::testing {

struct SimulatedLines {
  std::uint64_t seed = 1;
  int lines = 12, cross_lines = 3;
  bool to_and_fro = true;                  // Otherwise all lines are flown in one direction.
  double length = 3000;                    // m
  double line_spacing = 240, swath = 140;  // m; the swath on each side, at most 146.
  double spacing = 2;                      // m between points, of each line.
  // Lines differ by errors that last for hundreds of metres. A ninth of the bottom shows them as the whole of it does:
  // squares of 10 m, which are four patches each, 30 m apart.
  double square = 10, period = 30;  // m
  double wave_slope = 0.05;         // One sigma of each component of the slope of the surface, where there is no wind:
  double wind_speed = 0;            // m/s. Then waves travel (TravellingSea), and pulses share them.
  bool unseen_heights =
      false;                   // Each pulse takes the surface where it is on average; otherwise its own return is seen.
  double declared_wind = 0;    // m/s, where it is another one.
  double bottom_slope = 0;     // Root mean square in the direction of x, of ridges, beside gentle slopes.
  double bottom_waves = 0;     // m, one sigma of a rough bottom whose waves are some metres long.
  double roll_of_scanner = 0;  // degree: a boresight that nobody knows of.
  double declared = 1;         // What is declared of the air side, by what it is.
  double scan = 1, trajectory = 1;  // What the errors of the scanner and of the trajectory are, by what is declared.
  bool lasting = false;             // The errors of the trajectory last for whole lines, otherwise for tens of seconds.
};

// The errors of the air side that are drawn; what is declared is `declared` times as large.
AirErrors TrueErrors();

// At 1 sigma, in m, z up. Lines lie side by side along x, cross lines along y.
std::vector<quality::AnnotatedPoint> Simulate(const SimulatedLines& options);

}  // namespace albtpu::testing
