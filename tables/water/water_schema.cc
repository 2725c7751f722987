#include "tables/water/water_schema.h"

#include <cmath>

namespace albtpu {
namespace {

constexpr std::array<AxisSchema, kWaterAxisCount> kAxisSchemas = {{
    {.name = "backscatter_fraction",
     .units = "1",
     .long_name = "share of scattered light that turns back",
     .scale = Scale::kLog},
    {.name = "scattering_over_absorption",
     .units = "1",
     .long_name = "scattering over absorption of the water",
     .scale = Scale::kLog},
    {.name = "incidence",
     .units = "degree",
     .long_name = "incidence of the beam in air, from the vertical",
     .scale = Scale::kLinear},
    {.name = "optical_depth",
     .units = "1",
     .long_name = "sqrt(a^2 + 6 B a b) times the depth, of absorption a, scattering b, backscatter fraction B",
     .scale = Scale::kLog},
    {.name = "field_of_view",
     .units = "1",
     .long_name = "diameter of the field of view on the surface over the depth; the last node: all",
     .scale = Scale::kLog,
     .is_endless = true},
    {.name = "pulse_length",
     .units = "1",
     .long_name = "length of the pulse at half its maximum, in water, over twice the depth",
     .scale = Scale::kLog},
}};

constexpr std::array<QuantitySchema, kWaterQuantityCount> kQuantitySchemas = {{
    {"bias_vertical_peak", "1", "vertical bias over the depth, of the peak, positive if too shallow", true, true},
    {"bias_vertical_half", "1", "the same of the leading edge at half the peak", true, true},
    {"bias_vertical_centroid", "1", "the same of the centroid above a tenth of the peak", true, true},
    {"bias_along_beam_peak", "1", "bias along the beam over the depth, of the peak, positive if too far", true, true},
    {"bias_along_beam_half", "1", "the same of the leading edge at half the peak", true, true},
    {"bias_along_beam_centroid", "1", "the same of the centroid above a tenth of the peak", true, true},
    {"stretch", "1", "width of the echo at half its peak over that of the pulse", true, false},
    {"spot", "1", "standard deviation over the depth of where the echo comes from, along the beam", false, false},
    {"energy", "1", "energy of the echo in the field of view over that of unscattered light", false, false},
}};

constexpr std::array<std::size_t, kWaterAxisCount> kBlendOrder = {0, 1, 2, 3, 4, 5};

constexpr TableSchema kSchema = {
    .name = "water_column", .axes = kAxisSchemas, .quantities = kQuantitySchemas, .blend_order = kBlendOrder};
static_assert(IsWellFormed(kSchema));

}  // namespace

constinit const TableSchema kWaterColumn = kSchema;

double OpticalDepthPerScattering(double scattering_over_absorption, double backscatter_fraction) {
  return std::sqrt(1 + 6 * backscatter_fraction * scattering_over_absorption) / scattering_over_absorption;
}

}  // namespace albtpu
