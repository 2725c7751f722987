#include "tables/schema.h"

namespace albtpu {
namespace {

constexpr std::array<AxisSchema, kAxisCount> kAxisSchemas = {{
    {"wind_speed", "m s-1", "wind speed at 10 m above the sea", Scale::kLinear},
    {"fetch", "m", "fetch; at the last node and beyond, the sea is fully developed", Scale::kLog},
    {"incidence", "degree", "incidence of the beam in air, from the vertical", Scale::kLinear},
    {"azimuth", "degree", "azimuth of the beam from downwind, folded into 0 to 90 degrees", Scale::kLinear},
    {"footprint", "m", "diameter of the beam at the mean surface, across its axis", Scale::kLog},
    {"depth", "m", "depth below the located surface", Scale::kLinear},
}};

constexpr std::array<QuantitySchema, kQuantityCount> kQuantitySchemas = {{
    {"refraction_along_wind", "degree", "2 sigma of the direction in water, along the wind", false, false},
    {"refraction_cross_wind", "degree", "2 sigma of the direction in water, across the wind", false, false},
    {"thu", "m", "total horizontal uncertainty of the sea surface, 2 sigma", true, false},
    {"tvu", "m", "total vertical uncertainty of the sea surface, 2 sigma", true, false},
    {"bias_along_beam", "m", "horizontal bias, positive if reported too far along the azimuth of the beam",
     true, true},
    {"bias_vertical", "m", "vertical bias, positive if reported too shallow", true, true},
}};

}  // namespace

const AxisSchema& Describe(AxisId axis) { return kAxisSchemas[Index(axis)]; }

const QuantitySchema& Describe(Quantity quantity) { return kQuantitySchemas[Index(quantity)]; }

std::optional<AxisId> FindAxis(std::string_view name) {
  for (AxisId axis : kAxes) {
    if (Describe(axis).name == name) return axis;
  }
  return std::nullopt;
}

std::optional<Quantity> FindQuantity(std::string_view name) {
  for (Quantity quantity : kQuantities) {
    if (Describe(quantity).name == name) return quantity;
  }
  return std::nullopt;
}

std::string_view Name(Scale scale) { return scale == Scale::kLog ? "log" : "linear"; }

}  // namespace albtpu
