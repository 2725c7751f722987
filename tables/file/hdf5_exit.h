// What HDF5 does at the end of a program, for users of it and of libraries that are built on it.
#pragma once

namespace albtpu::hdf5 {

// Keeps HDF5 from closing files when the program ends, where it may crash if a write has failed. Call it before all
// other functions of HDF5.
void CloseNothingAtExit();

}  // namespace albtpu::hdf5
