// What a table holds: its six axes, its six quantities, their names, units and order. The written form is
// FORMAT.md.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace albtpu {

// How values lie between two nodes: linear in the coordinate, or linear in its logarithm.
enum class Scale { kLinear, kLog };

// The axes, slowest first. This is the order of the dimensions of every dataset and of every message.
enum class AxisId { kWindSpeed, kFetch, kIncidence, kAzimuth, kFootprint, kDepth };
inline constexpr std::size_t kAxisCount = 6;
inline constexpr std::array<AxisId, kAxisCount> kAxes = {AxisId::kWindSpeed, AxisId::kFetch,
                                                         AxisId::kIncidence, AxisId::kAzimuth,
                                                         AxisId::kFootprint, AxisId::kDepth};

struct AxisSchema {
  std::string_view name;       // "wind_speed": the dataset, the CSV column, the field of a message.
  std::string_view units;      // CF units: "m s-1".
  std::string_view long_name;  // One line for people.
  Scale scale;                 // The scale of tables that we make; a file may state another.
};

// What the surface of the sea does to a pulse. All but the biases are 2 sigma.
enum class Quantity {
  kRefractionAlongWind,  // degree, over all axes but depth
  kRefractionCrossWind,  // degree, over all axes but depth
  kThu,                  // m
  kTvu,                  // m
  kBiasAlongBeam,        // m, positive = reported too far along the azimuth of the beam
  kBiasVertical,         // m, positive = reported too shallow
};
inline constexpr std::size_t kQuantityCount = 6;
inline constexpr std::array<Quantity, kQuantityCount> kQuantities = {
    Quantity::kRefractionAlongWind, Quantity::kRefractionCrossWind, Quantity::kThu, Quantity::kTvu,
    Quantity::kBiasAlongBeam,       Quantity::kBiasVertical};

struct QuantitySchema {
  std::string_view name;   // "thu"; its standard error is `name + kStandardErrorSuffix`.
  std::string_view units;  // "degree" or "m".
  std::string_view long_name;
  bool over_depth;  // False: the variable has the first five axes only.
  bool is_bias;     // Biases may be negative, and may be absent; the others may not.
};

inline constexpr std::string_view kStandardErrorSuffix = "_standard_error";

const AxisSchema& Describe(AxisId axis);
const QuantitySchema& Describe(Quantity quantity);

// The inverse of `Describe(...).name`; nothing if there is no such name.
std::optional<AxisId> FindAxis(std::string_view name);
std::optional<Quantity> FindQuantity(std::string_view name);

constexpr std::size_t Index(AxisId axis) { return static_cast<std::size_t>(axis); }
constexpr std::size_t Index(Quantity quantity) { return static_cast<std::size_t>(quantity); }

std::string_view Name(Scale scale);  // "linear", "log": the value of the attribute `interpolation`.

}  // namespace albtpu
