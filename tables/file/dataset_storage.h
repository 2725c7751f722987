// Checks how the numbers of an HDF5 dataset are stored before HDF5 reads them.
#pragma once

#include <hdf5.h>

#include <vector>

#include "absl/status/status.h"

namespace albtpu::hdf5 {

// Success if all values of a float32 dataset lie in its own file, contiguous or in chunks as FORMAT.md allows, and
// each chunk has as many bytes as its shape requires. HDF5 1.10 does not check the size: if a chunk has fewer
// bytes, by damage or malice, it reads beyond the memory of the chunk.
//
// InvalidArgument: the message continues a sentence that begins with the name of the dataset.
absl::Status CheckStorage(hid_t dataset, const std::vector<hsize_t>& shape);

}  // namespace albtpu::hdf5
