// A table of the water column, and its interpolation.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "tables/table.h"
#include "tables/water/water_schema.h"

namespace albtpu {

// Of the axes that belong to the beam, in their units (water_schema.h).
struct WaterBeam {
  double incidence = 0;
  double optical_depth = 0;
  double field_of_view = 0;
  double pulse_length = 0;
};

// By WaterQuantity.
using WaterAnswer = std::array<double, kWaterQuantityCount>;

// Answers of one water over the incidence, at one place of the other axes.
class WaterOverIncidence {
 public:
  // As OneWater::At, which it equals. nullopt if the incidence is beyond the nodes.
  std::optional<WaterAnswer> At(double incidence) const;

 private:
  friend class OneWater;

  const Axis* axis_ = nullptr;   // of the incidence, in the table
  double scattering_ = 0;        // b z
  std::vector<WaterAnswer> of_;  // at each node; as OneWater keeps quantities
};

// One water: a table with its first two axes interpolated.
class OneWater {
 public:
  // Interpolates by cubic polynomials through the four nodes around each coordinate; around an incidence near 0, one of
  // them is the mirror image of another. Biases are interpolated over the number of scatterings b z. Below the first
  // optical depth they are in proportion to it, as once-scattered light has them. A field of view above
  // the last node counts as all, a pulse above the last node as that: its echo is the pulse itself. nullopt if the
  // incidence or the optical depth is above the last node, the field of view or the pulse below the first, or a
  // coordinate is negative or NaN.
  std::optional<WaterAnswer> At(const WaterBeam& beam) const;

  // The same for many incidences at little more than the cost of one. `beam.incidence` does not matter.
  std::optional<WaterOverIncidence> OverIncidence(const WaterBeam& beam) const;

 private:
  friend class WaterColumnTable;

  const std::vector<Axis>* axes_;  // of the table
  double scattering_ = 0;          // b z over the optical depth
  // Over optical depth, field of view, pulse length, incidence and, fastest, quantities; biases over b z, the energy as
  // its logarithm over it.
  std::vector<float> values_;
};

class WaterColumnTable {
 public:
  // Requires a table of kWaterColumn. InvalidArgument if it lacks a bias, an energy is not positive, the optical depth
  // begins at 0, a value over the number of scatterings b z is above 1e6 in magnitude, or the distances of four nodes
  // differ by a factor of 1000.
  static absl::StatusOr<WaterColumnTable> Create(Table table);

  const Table& table() const { return table_; }
  const Axis& axis(WaterAxis axis) const { return table_.axes()[Index(axis)]; }
  // The first and the last node.
  std::pair<double, double> Range(WaterAxis axis) const;

  // The water of these two coordinates, held within the range of the table. It refers to the table, which must outlive
  // it in its place.
  //
  //     table.Of(0.0183, 4).At({.incidence = 15, .optical_depth = 1, .field_of_view = 0.3, .pulse_length = 0.02})
  OneWater Of(double backscatter_fraction, double scattering_over_absorption) const;

 private:
  explicit WaterColumnTable(Table table);

  Table table_;
  std::vector<float> values_;  // Over the first two axes, then as in OneWater.
};

}  // namespace albtpu
