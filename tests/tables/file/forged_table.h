// Files with an intact seal and an edited HDF5 part, and the messages of the decoder about them.
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <string>
#include <vector>

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

// A change of a valid file, and what the decoder must say of the result.
struct Forgery {
  std::function<void(hid_t file)> change;
  ::testing::Matcher<std::string> problem;
};
inline void ExpectProblems(const std::vector<Forgery>& forgeries) {
  for (std::size_t i = 0; i < forgeries.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_THAT(Problem(Forge(forgeries[i].change)), forgeries[i].problem);
  }
}

// Replaces a dataset by an empty one of another type, shape or storage that has the required attributes.
inline void Replace(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& shape,
                    hid_t creation = H5P_DEFAULT, const hsize_t* most = nullptr) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const hdf5::Handle space(
      shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), most),
      H5Sclose);
  const hdf5::Handle dataset(H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  EXPECT_TRUE(dataset);
  EXPECT_TRUE(hdf5::WriteAttribute(dataset, "units", std::string("m")));
  EXPECT_TRUE(hdf5::WriteAttribute(dataset, "interpolation", std::string("linear")));
}

}  // namespace albtpu::testing
