// The tables of the sea surface, over winds and of one sea: their six axes and six quantities, and the names by which
// code refers to them. FORMAT.md specifies the written form.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "tables/table_schema.h"

namespace albtpu {

// The axes, slowest first. This is the order of the dimensions of every dataset and of every message.
enum class AxisId { kWindSpeed, kFetch, kIncidence, kAzimuth, kFootprint, kDepth };
inline constexpr std::size_t kAxisCount = 6;
inline constexpr std::array<AxisId, kAxisCount> kAxes = {AxisId::kWindSpeed, AxisId::kFetch,     AxisId::kIncidence,
                                                         AxisId::kAzimuth,   AxisId::kFootprint, AxisId::kDepth};

// The uncertainty of a pulse by the sea surface. All but the biases are 2 sigma.
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

constexpr std::size_t Index(AxisId axis) { return static_cast<std::size_t>(axis); }
constexpr std::size_t Index(Quantity quantity) { return static_cast<std::size_t>(quantity); }

// The two kinds of tables that AxisId and Quantity are indices of. Their quantities are the same, and their axes have
// the same names and units.

// Wind seas: x is downwind.
extern const TableSchema kSeaSurface;

// One sea of any waves, which has no mirror: azimuths are from the x axis of its frame, which FORMAT.md defines,
// towards its y axis, 0 to 180 degrees. Wind speed and fetch have one node and no effect: they answer at any coordinate
// that is not negative and may be absent. In the names of quantities, "along wind" is along x and "cross wind" along y.
extern const TableSchema kOneSea;

// Of kSeaSurface.
const AxisSchema& Describe(AxisId axis);
const QuantitySchema& Describe(Quantity quantity);

// Whether the axis may be absent in queries to any table: true for fetch and azimuth. Of kSeaSurface, their absence
// means a fully developed sea, and the larger of the values along and across the wind.
inline bool MayBeAbsent(AxisId axis) { return Describe(axis).if_absent != IfAbsent::kRefuse; }

// The inverse of `Describe(...).name`; nullopt if there is no such name.
std::optional<AxisId> FindAxis(std::string_view name);
std::optional<Quantity> FindQuantity(std::string_view name);

}  // namespace albtpu
