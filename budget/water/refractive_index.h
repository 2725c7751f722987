// The refractive index of sea water, by its temperature and salinity.
#pragma once

namespace albtpu {

// Of green lasers: a doubled Nd:YAG.
inline constexpr double kGreenWavelength = 532;  // nm

struct WaterIndex {
  double phase = 0;  // Refracts.
  double group = 0;  // Delays a pulse: the speed of light in air over that of the pulse.
};

// Quan and Fry (1995), doi:10.1364/AO.34.003477, Eq. 3: relative to air. They measured from 400 to 700 nm, 0 to 30
// degrees C and a salinity of up to 35; we use it up to 40 degrees and 45 as well, where it stays smooth. The group
// index is n - wavelength dn/dwavelength of the same equation.
//
//     SeaWaterIndex(15, 35).phase  // 1.34199
WaterIndex SeaWaterIndex(double temperature, double salinity, double wavelength = kGreenWavelength);

// The bias of a point whose processing refracted and ranged with one index `used`, for the phase and the group alike.
// Relative to the reported depth; reported minus true: positive is too shallow, and too far along the beam. `incidence`
// is in air [radian]. Exact over a level bottom.
//
//     BiasOfIndex(0, SeaWaterIndex(15, 35), 1.33).vertical  // -0.0252: 25 cm too deep at 10 m
struct IndexBias {
  double vertical = 0, along = 0;
};
IndexBias BiasOfIndex(double incidence, const WaterIndex& water, double used);

}  // namespace albtpu
