// Files with an intact seal and an edited HDF5 part, and the messages of the decoder about them.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tables/file/hdf5.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::testing {

// A valid table, sealed again after `change` has edited its HDF5 part.
inline std::string Forge(const std::function<void(hid_t file)>& change) {
  const TemporaryFolder folder;
  const std::string path = folder.Write("t.h5", *EncodeTable(TinyTable())).string();
  {
    const hdf5::Session session;
    const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
    EXPECT_TRUE(file);
    change(file);
  }
  std::string bytes = ReadFile(path);
  seal::Apply(bytes);
  return bytes;
}

inline std::string Problem(const std::string& file) {
  const absl::Status status = DecodeTable(file).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  return std::string(status.message());
}

inline std::string ProblemAfter(const std::function<void(hid_t file)>& change) { return Problem(Forge(change)); }

}  // namespace albtpu::testing
