// The refractive index of water.
#pragma once

namespace albtpu {

// Sea water at 532 nm, the wavelength of laser bathymetry. Quan and Fry (1995), Eq. 3, doi:10.1364/AO.34.003477, gives
// 1.3415 at 20 degrees C and a salinity of 35, and 1.3350 without salt. The one default of everything that needs an
// index and is given none: the geometry of beams, the air side, the share of the sea and that of the water column.
inline constexpr double kSeaWaterIndex = 1.34;

// Of the group, which delays pulses: sea water at 15 degrees C and a salinity of 35, by the same equation
// (budget/water/refractive_index.h). The default of all that ranges in water.
inline constexpr double kSeaWaterGroupIndex = 1.3643;

// The index that tables of the sea surface are made at, as in Birkebak et al. (2018), Eq. 17, and that is assumed of a
// table that states none. Answers are scaled from it (sea/table/table_at_index.h).
inline constexpr double kRefractiveIndex = 1.33;

}  // namespace albtpu
