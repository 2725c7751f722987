// The numbers of a dataset of HDF5, read so that no file makes a program open other files, load plug-ins, read memory
// that is not its own, or allocate much more of it than the file is long.
#pragma once

#include <hdf5.h>

#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::hdf5 {

// All values of a float32 dataset of this shape, row-major. They must lie in its own file, contiguous or in chunks as
// FORMAT.md allows. Chunks are inflated here, each into as many bytes as its shape requires: HDF5 1.10 does not check
// the size, and if a chunk has fewer bytes, by damage or malice, reads beyond the memory of the chunk.
//
// InvalidArgument: the message continues a sentence that begins with the name of the dataset.
absl::StatusOr<std::vector<float>> ReadFloats(hid_t dataset, const std::vector<hsize_t>& shape);

}  // namespace albtpu::hdf5
