// How the numbers of an HDF5 dataset are stored, looked at before HDF5 reads them.
#pragma once

#include <hdf5.h>

#include <vector>

#include "absl/status/status.h"

namespace albtpu::hdf5 {

// Success if all values of a dataset of float32 lie in its own file, in chunks of tables or in one piece, and
// each chunk has as many bytes as its shape says. HDF5 1.10 takes the last for granted: of a chunk that has
// fewer, as damage or malice can make it, it reads on in memory that is not the chunk's.
//
// InvalidArgument: the message goes on from the name of the dataset.
absl::Status CheckStorage(hid_t dataset, const std::vector<hsize_t>& shape);

}  // namespace albtpu::hdf5
