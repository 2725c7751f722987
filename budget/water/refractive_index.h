// The refractive index of sea water, by its temperature and salinity.
#pragma once

namespace albtpu {

// Of green lasers: a doubled Nd:YAG.
inline constexpr double kGreenWavelength = 532;  // nm

struct WaterIndex {
  double phase =
      0;  // Refracts, and is the ratio of the lengths of a path in air and in water of equal phase.
  double group = 0;  // Delays a pulse: the speed of light in air over that of the pulse.
};

// Quan and Fry (1995), doi:10.1364/AO.34.003477, Eq. 3: relative to air, for 400 to 700 nm, 0 to 30 degrees C and
// salinities of 0 to 35. Smooth, and taken as good, up to 40 degrees and a salinity of 45. The group index is
// n - wavelength dn/dwavelength of the same equation.
//
//     SeaWaterIndex(15, 35).phase  // 1.34199
WaterIndex SeaWaterIndex(double temperature, double salinity, double wavelength = kGreenWavelength);

}  // namespace albtpu
