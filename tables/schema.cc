#include "tables/schema.h"

namespace albtpu {
namespace {

// The numbers of the sea do not change when the azimuth turns by 180 degrees or is mirrored at the wind axis, and
// beyond the longest fetch the sea is fully developed.
constexpr std::array<AxisSchema, kAxisCount> kAxisSchemas = {{
    {.name = "wind_speed", .units = "m s-1", .long_name = "wind speed at 10 m above the sea", .scale = Scale::kLinear},
    {.name = "fetch",
     .units = "m",
     .long_name = "fetch; at the last node and beyond, the sea is fully developed",
     .scale = Scale::kLog,
     .is_endless = true,
     .if_absent = IfAbsent::kLastNode},
    {.name = "incidence",
     .units = "degree",
     .long_name = "incidence of the beam in air, from the vertical",
     .scale = Scale::kLinear},
    {.name = "azimuth",
     .units = "degree",
     .long_name = "azimuth of the beam from downwind, folded into 0 to 90 degrees",
     .scale = Scale::kLinear,
     .fold = Fold::kQuadrant,
     .if_absent = IfAbsent::kLargerOfEnds},
    {.name = "footprint",
     .units = "m",
     .long_name = "diameter of the beam at the mean surface, across its axis",
     .scale = Scale::kLog},
    {.name = "depth", .units = "m", .long_name = "depth below the located surface", .scale = Scale::kLinear},
}};

// A sea of any waves keeps the turn, but not the mirror. Its wind and fetch are fixed.
constexpr std::array<AxisSchema, kAxisCount> kAxisSchemasOfOneSea = [] {
  std::array<AxisSchema, kAxisCount> axes = kAxisSchemas;
  AxisSchema& wind_speed = axes[Index(AxisId::kWindSpeed)];
  wind_speed.long_name = "wind speed at 10 m above the sea, of this sea: any other counts as it";
  wind_speed.is_endless = true;
  wind_speed.if_absent = IfAbsent::kLastNode;
  axes[Index(AxisId::kFetch)].long_name = "fetch, of no effect: any counts as the node";
  AxisSchema& azimuth = axes[Index(AxisId::kAzimuth)];
  azimuth.long_name = "azimuth of the beam from the x axis of the sea, folded into 0 to 180 degrees";
  azimuth.fold = Fold::kHalfTurn;
  azimuth.if_absent = IfAbsent::kLargestOfNodes;
  return axes;
}();

constexpr std::array<QuantitySchema, kQuantityCount> kQuantitySchemas = {{
    {"refraction_along_wind", "degree", "2 sigma of the direction in water, along the wind", false, false},
    {"refraction_cross_wind", "degree", "2 sigma of the direction in water, across the wind", false, false},
    {"thu", "m", "total horizontal uncertainty of the sea surface, 2 sigma", true, false},
    {"tvu", "m", "total vertical uncertainty of the sea surface, 2 sigma", true, false},
    {"bias_along_beam", "m", "horizontal bias, positive if reported too far along the azimuth of the beam", true, true},
    {"bias_vertical", "m", "vertical bias, positive if reported too shallow", true, true},
}};

constexpr std::array<std::size_t, kAxisCount> kBlendOrder = {Index(AxisId::kWindSpeed), Index(AxisId::kFetch),
                                                             Index(AxisId::kAzimuth),   Index(AxisId::kIncidence),
                                                             Index(AxisId::kFootprint), Index(AxisId::kDepth)};

constexpr TableSchema kSchema = {
    .name = "sea_surface", .axes = kAxisSchemas, .quantities = kQuantitySchemas, .blend_order = kBlendOrder};
static_assert(IsWellFormed(kSchema));

constexpr TableSchema kSchemaOfOneSea = {
    .name = "one_sea", .axes = kAxisSchemasOfOneSea, .quantities = kQuantitySchemas, .blend_order = kBlendOrder};
static_assert(IsWellFormed(kSchemaOfOneSea));

}  // namespace

constinit const TableSchema kSeaSurface = kSchema;
constinit const TableSchema kOneSea = kSchemaOfOneSea;

const AxisSchema& Describe(AxisId axis) { return kAxisSchemas[Index(axis)]; }

const QuantitySchema& Describe(Quantity quantity) { return kQuantitySchemas[Index(quantity)]; }

std::optional<AxisId> FindAxis(std::string_view name) {
  for (AxisId axis : kAxes)
    if (Describe(axis).name == name) return axis;
  return std::nullopt;
}

std::optional<Quantity> FindQuantity(std::string_view name) {
  for (Quantity quantity : kQuantities)
    if (Describe(quantity).name == name) return quantity;
  return std::nullopt;
}

}  // namespace albtpu
