// What HDF5 does at the end of a program, for users of it and of libraries that are built on it.
#pragma once

namespace albtpu::hdf5 {

// At the end of the program HDF5 closes what is still open: after a failed write it crashes there, and it reports the
// objects that it lost track of in damaged files. After this call, before any other one of HDF5, it closes nothing.
void CloseNothingAtExit();

}  // namespace albtpu::hdf5
