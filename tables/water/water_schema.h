// The tables of the water column: their axes and quantities, and the names by which code refers to them. FORMAT.md
// specifies the written form.
//
// Lengths are over the depth z of the bottom, so that one node is a whole family of waters, systems and depths. The
// beam is as narrow as a line; a field of view of 2.5 footprints or more takes in the footprint as well (errors of at
// most 2 mm).
#pragma once

#include <array>
#include <cstddef>

#include "tables/table_schema.h"

namespace albtpu {

// The axes, slowest first.
enum class WaterAxis {
  kBackscatterFraction,       // of the phase function of Fournier and Forand
  kScatteringOverAbsorption,  // b / a; of a single-scattering albedo w, w / (1 - w)
  kIncidence,                 // degree, in air
  kOpticalDepth,              // K z, with K = sqrt(a^2 + 6 B a b), B the backscatter fraction
  kFieldOfView,  // diameter of the disc on the surface that the receiver sees, across the beam; the last node: all
  kPulseLength   // c t / (2 n_group z), t the full width of the pulse at half its maximum
};
inline constexpr std::size_t kWaterAxisCount = 6;

// Reported minus true, by how the receiver reads a time from the echo; lengths over the depth.
enum class WaterQuantity {
  kBiasVerticalPeak,  // positive: too shallow
  kBiasVerticalHalf,
  kBiasVerticalCentroid,
  kBiasAlongPeak,  // positive: too far along the beam
  kBiasAlongHalf,
  kBiasAlongCentroid,
  kStretch,  // width of the echo at half its maximum over that of the pulse
  kSpot,     // standard deviation of where the echo comes from, along the beam: resolution
  kEnergy    // of the echo within the field of view over that of unscattered light
};
inline constexpr std::size_t kWaterQuantityCount = 9;

// An echo of less energy than this is lost in that of the water, and of too few photons to compute.
inline constexpr double kMinEchoEnergy = 0.003;

constexpr std::size_t Index(WaterAxis axis) { return static_cast<std::size_t>(axis); }
constexpr std::size_t Index(WaterQuantity quantity) { return static_cast<std::size_t>(quantity); }

// The share of light that the mean ocean particle of Petzold scatters backwards (Mobley 1994, table 3.10).
inline constexpr double kMeanBackscatterFraction = 0.0183;

// Speed of light, m/ns: exact by the definition of the metre.
inline constexpr double kLightSpeed = 0.299792458;

// The coordinate on the axis of pulses of a pulse of `nanoseconds` at half its maximum, over a bottom at `depth` [m].
constexpr double PulseLengthOverDepth(double nanoseconds, double depth, double group_index) {
  return kLightSpeed * nanoseconds / (2 * group_index * depth);
}

// K z over b z: the optical depth of a table over the mean number of scatterings on the way down. As the name of an
// axis, K is exact. Where it stands for a measured attenuation it is an approximation: Kirk (1984),
// doi:10.4319/lo.1984.29.2.0350, has K = sqrt(a^2 + G a b) with G = 0.256 of the one phase function that he traced; G
// grows with the light that turns back, and is taken as 6 B here.
double OpticalDepthPerScattering(double scattering_over_absorption, double backscatter_fraction);

extern const TableSchema kWaterColumn;

}  // namespace albtpu
