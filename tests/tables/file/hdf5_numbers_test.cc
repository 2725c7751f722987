// Numbers of datasets, against what HDF5 itself reads of them.
#include "tables/file/hdf5_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <cstdint>
#include <random>
#include <vector>

#include "tables/file/hdf5.h"

namespace albtpu::hdf5 {
namespace {

using ::testing::HasSubstr;

Handle FileInMemory() {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 16, false);
  return Handle(H5Fcreate(NameInMemory().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
}

struct Storage {
  std::vector<hsize_t> shape = {}, chunk = {};
  bool shuffle = true, checksum = false;
  hid_t type = H5T_IEEE_F32LE;
};

Handle Stored(hid_t file, const Storage& as, const std::vector<float>& numbers) {
  const int rank = static_cast<int>(as.shape.size());
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_chunk(creation, rank, as.chunk.data());
  if (as.shuffle) H5Pset_shuffle(creation);
  H5Pset_deflate(creation, 4);
  if (as.checksum) H5Pset_fletcher32(creation);
  const std::vector<hsize_t> most(as.shape.size(), H5S_UNLIMITED);  // Chunks may be longer than the dataset.
  const Handle space(H5Screate_simple(rank, as.shape.data(), most.data()), H5Sclose);
  Handle dataset(H5Dcreate2(file, "numbers", as.type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), 0);
  return dataset;
}

TEST(ReadFloats, ReadsWhatHdf5Does) {
  const Session session;
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Storage as{.shuffle = random() % 2 == 0,
               .checksum = random() % 2 == 0,
               .type = random() % 4 == 0 ? H5T_IEEE_F32BE : H5T_IEEE_F32LE};
    std::size_t count = 1;
    for (unsigned rank = 1 + random() % 4; rank-- > 0;) {
      as.shape.push_back(1 + random() % 9);
      as.chunk.push_back(1 + random() % (as.shape.back() + 2));
      count *= as.shape.back();
    }
    std::vector<float> numbers(count);
    for (float& number : numbers) number = std::normal_distribution<float>()(random);

    const Handle file = FileInMemory();
    const Handle dataset = Stored(file, as, numbers);
    std::vector<float> by_hdf5(count);
    ASSERT_GE(H5Dread(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, by_hdf5.data()), 0);
    const auto read = ReadFloats(dataset, as.shape);
    ASSERT_TRUE(read.ok()) << read.status();
    EXPECT_EQ(*read, by_hdf5);
    EXPECT_EQ(*read, numbers);
  }
}

TEST(ReadFloats, RefusesAWrongChecksum) {
  const Session session;
  const Handle file = FileInMemory();
  const Storage as{.shape = {4}, .chunk = {4}, .checksum = true};
  const Handle dataset = Stored(file, as, {1, 2, 3, 4});
  const hsize_t first = 0;
  hsize_t size = 0;
  ASSERT_GE(H5Dflush(dataset), 0);
  ASSERT_GE(H5Dget_chunk_storage_size(dataset, &first, &size), 0);
  std::vector<char> stored(size);
  std::uint32_t skipped_filters = 0;
  ASSERT_GE(H5Dread_chunk(dataset, H5P_DEFAULT, &first, &skipped_filters, stored.data()), 0);
  stored.back() ^= 1;
  ASSERT_GE(H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, &first, size, stored.data()), 0);
  EXPECT_THAT(ReadFloats(dataset, as.shape).status().ToString(), HasSubstr("has a chunk that is missing or damaged"));
}

}  // namespace
}  // namespace albtpu::hdf5
