// The sea surface's tables: their six axes and six quantities, and the names by which code refers to them. FORMAT.md
// specifies the written form.
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
inline constexpr std::array<AxisId, kAxisCount> kAxes = {AxisId::kWindSpeed, AxisId::kFetch,
                                                         AxisId::kIncidence, AxisId::kAzimuth,
                                                         AxisId::kFootprint, AxisId::kDepth};

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

constexpr std::size_t Index(AxisId axis) { return static_cast<std::size_t>(axis); }
constexpr std::size_t Index(Quantity quantity) { return static_cast<std::size_t>(quantity); }

// The schema that AxisId and Quantity are indices of.
extern const TableSchema kSeaSurface;

const AxisSchema& Describe(AxisId axis);
const QuantitySchema& Describe(Quantity quantity);

// True for fetch and azimuth, whose absence has a meaning: a fully developed sea, and the larger of the values along
// and across the wind.
inline bool MayBeAbsent(AxisId axis) { return Describe(axis).if_absent != IfAbsent::kRefuse; }

// The inverse of `Describe(...).name`; nothing if there is no such name.
std::optional<AxisId> FindAxis(std::string_view name);
std::optional<Quantity> FindQuantity(std::string_view name);

}  // namespace albtpu
