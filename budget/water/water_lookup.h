// Drawn waters, looked up in a table, and what a calibration says of them.
#pragma once

#include <cstddef>
#include <vector>

#include "budget/water/water_draws.h"
#include "budget/water/water_receiver.h"
#include "tables/water/water_column_table.h"

namespace albtpu {

// The vertical bias, the bias along the beam and the spot, each divided by the depth; the stretch; the energy.
struct Looked {
  double vertical = 0, along = 0, spot = 0, stretch = 0, energy = 0;
};

// One water at one depth, over the incidence [degree].
class WaterAtDepth {
 public:
  Looked At(double incidence) const;

 private:
  friend class WaterLookup;

  WaterOverIncidence water_;
  double beyond_ = 1;         // Factor of biases outside the table.
  std::size_t detector_ = 0;  // Of EchoDetector.
};

// One water as a receiver sees it.
class WaterLookup {
 public:
  WaterLookup(const WaterColumnTable& table, const WaterReceiver& receiver, const DrawnWater& draw);

  // The depth [m] is above 0. Beyond the last optical depth, biases over the optical depth stay.
  WaterAtDepth At(double depth) const;

 private:
  WaterReceiver receiver_;
  DrawnWater draw_;
  double min_view_, min_pulse_, min_ratio_, last_;
  OneWater water_;
};

// What a calibration says of each water, at each incidence.
class CalibratedWaters {
 public:
  // Nothing, unless the bias is handled as kCalibrated.
  CalibratedWaters(const std::vector<WaterLookup>& waters, const std::vector<double>& incidences,
                   const BiasTreatment& treatment);

  // Whether the waters disagree on the sign of the bias at the depth of the calibration.
  bool disagree() const { return disagree_; }
  // The factor by which the bias of a water must be multiplied to equal the measured one. 1 without a calibration.
  double scale(std::size_t incidence, std::size_t water) const {
    return scales_.empty() ? 1 : scales_[incidence * waters_ + water];
  }
  // The relative error of the measurement. 0 without a calibration.
  double noise(std::size_t incidence) const { return noises_.empty() ? 0 : noises_[incidence]; }

 private:
  std::size_t waters_;
  std::vector<double> scales_, noises_;
  bool disagree_ = false;
};

}  // namespace albtpu
