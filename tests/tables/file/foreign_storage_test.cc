// Sealed files that would make a reader open other files, load plug-ins, or use unlimited memory.
#include <gmock/gmock.h>
#include <zlib.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tables/format.h"
#include "tests/tables/file/forged_table.h"

namespace albtpu {
namespace {

using hdf5::Handle;
using ::testing::AnyOf;
using ::testing::EndsWith;
using testing::ExpectProblems;
using ::testing::HasSubstr;

const std::vector<hsize_t> kShape = {2, 1, 2, 2, 1, 2};  // of the tiny table

// Replaces THU by a dataset that differs from a valid one only in how it is stored.
void ReplaceThu(hid_t file, hid_t creation) { testing::Replace(file, "thu", H5T_IEEE_F32LE, kShape, creation); }

Handle Creation() { return Handle(H5Pcreate(H5P_DATASET_CREATE), H5Pclose); }

// In one chunk of all 16 values.
Handle DeflatedCreation() {
  Handle creation = Creation();
  H5Pset_chunk(creation, 6, kShape.data());
  H5Pset_deflate(creation, 1);
  return creation;
}

std::string Deflated(const std::string& bytes) {
  std::string deflated(compressBound(bytes.size()), '\0');
  uLongf size = deflated.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(deflated.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                     bytes.size()),
            Z_OK);
  return deflated.substr(0, size);
}

TEST(ForeignStorage, IsRefusedBehindLinks) {
  const std::string refusal = "variable 'thu' is a link: it should be a dataset of this file";
  ExpectProblems({{[](hid_t file) {
                     H5Ldelete(file, "thu", H5P_DEFAULT);
                     EXPECT_GE(H5Lcreate_external("/dev/zero", "/thu", file, "thu", H5P_DEFAULT, H5P_DEFAULT), 0);
                   },
                   refusal},
                  {[](hid_t file) {
                     H5Ldelete(file, "thu", H5P_DEFAULT);
                     EXPECT_GE(H5Lcreate_soft("/tvu", file, "thu", H5P_DEFAULT, H5P_DEFAULT), 0);
                   },
                   refusal}});
}

// How THU is stored.
TEST(ForeignStorage, IsRefusedInOtherFilesAndThroughOtherFilters) {
  struct Case {
    std::function<void(hid_t creation)> storage;
    ::testing::Matcher<std::string> problem;
  };
  const std::string elsewhere = "variable 'thu' has its values in other files: expected them in this file";
  const Case cases[] = {{[](hid_t creation) { H5Pset_external(creation, "/dev/zero", 0, H5F_UNLIMITED); }, elsewhere},
                        {[](hid_t creation) {
                           const Handle space(H5Screate_simple(6, kShape.data(), nullptr), H5Sclose);
                           H5Pset_virtual(creation, space, "/dev/zero", "/thu", space);
                         },
                         elsewhere},
                        {[](hid_t creation) {
                           H5Pset_chunk(creation, 6, kShape.data());
                           H5Pset_scaleoffset(creation, H5Z_SO_FLOAT_DSCALE, 2);
                         },
                         EndsWith("of HDF5: expected shuffle and deflate")},
                        {[](hid_t creation) { H5Pset_chunk(creation, 6, kShape.data()); },
                         "variable 'thu' is in chunks without deflate: expected shuffle and deflate"},
                        {[](hid_t creation) {
                           H5Pset_chunk(creation, 6, kShape.data());
                           H5Pset_deflate(creation, 1);
                           H5Pset_shuffle(creation);
                         },
                         "variable 'thu' uses filter 2 of HDF5: expected shuffle and deflate"}};
  for (const Case& c : cases) {
    const auto replace = [&](hid_t file) {
      const Handle creation = Creation();
      c.storage(creation);
      ReplaceThu(file, creation);
    };
    ExpectProblems({{replace, c.problem}});
  }
}

// HDF5 1.10 takes these for whole chunks and reads beyond them.
TEST(ForeignStorage, IsRefusedIfChunksAreTooShort) {
  const auto with_chunk = [](std::string stored, std::uint32_t skipped_filters = 0) {
    return [=](hid_t file) {
      ReplaceThu(file, DeflatedCreation());
      const Handle dataset(H5Dopen2(file, "thu", H5P_DEFAULT), H5Dclose);
      const std::vector<hsize_t> first(6, 0);
      EXPECT_GE(H5Dwrite_chunk(dataset, H5P_DEFAULT, skipped_filters, first.data(), stored.size(), stored.data()), 0);
    };
  };
  constexpr std::size_t kChunkBytes = 16 * sizeof(float);
  const std::string refusal = "variable 'thu' has a chunk that is missing or damaged";
  ExpectProblems({{[](hid_t file) { ReplaceThu(file, DeflatedCreation()); }, refusal},
                  {with_chunk(Deflated(std::string(kChunkBytes - 1, '\0'))), refusal},
                  {with_chunk(Deflated(std::string(kChunkBytes + 1, '\0'))), refusal},
                  {with_chunk(Deflated(std::string(kChunkBytes, '\0')).substr(0, 5)), refusal},
                  {with_chunk(std::string(kChunkBytes, '\0'), 1), refusal},
                  {with_chunk(std::string(4096, '\0')), refusal},
                  {with_chunk(Deflated(std::string(kChunkBytes, '\0'))), HasSubstr("'content_digest'")}});
}

TEST(ForeignStorage, IsRefusedIfItIsSharedTooLargeOrAbsent) {
  ExpectProblems({{[](hid_t file) {
                     ReplaceThu(file, DeflatedCreation());
                     const Handle thu(H5Dopen2(file, "thu", H5P_DEFAULT), H5Dclose);
                     const std::vector<hsize_t> first(6, 0);
                     const std::string stored(60000, '\0');
                     EXPECT_GE(H5Dwrite_chunk(thu, H5P_DEFAULT, 0, first.data(), stored.size(), stored.data()), 0);
                     for (const char* name : {"tvu", "bias_vertical"}) {
                       H5Ldelete(file, name, H5P_DEFAULT);
                       EXPECT_GE(H5Lcreate_hard(file, "thu", file, name, H5P_DEFAULT, H5P_DEFAULT), 0);
                     }
                   },
                   EndsWith("each should have bytes of its own")},
                  {[](hid_t file) {
                     const Handle creation = Creation();
                     const std::vector<hsize_t> chunk = {2, 1, 2, 2, 1, 1 << 16}, most(6, H5S_UNLIMITED);
                     H5Pset_chunk(creation, 6, chunk.data());
                     testing::Replace(file, "thu", H5T_IEEE_F32LE, kShape, creation, most.data());
                   },
                   HasSubstr("has chunks of more than 65536 values")},
                  {[](hid_t file) { testing::Replace(file, "depth", H5T_IEEE_F32LE, {60000}); },
                   "axis 'depth' has 60000 values in 0 bytes: expected 240000 bytes"},
                  {[](hid_t file) {
                     const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
                     H5Tset_size(type, format::kMaxAttributeBytes + 1);
                     const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
                     H5Adelete(file, "title");
                     EXPECT_TRUE(Handle(H5Acreate2(file, "title", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose));
                   },
                   HasSubstr("attribute 'title' is longer than 16777216 bytes")}});
}

// Writers shuffle values by their size.
TEST(ForeignStorage, IsRefusedIfItIsShuffledOtherwise) {
  std::string file = testing::Forge([&](hid_t root) {
    const Handle creation = Creation();
    H5Pset_chunk(creation, 6, kShape.data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 1);
    ReplaceThu(root, creation);
  });
  // The level of deflate tells it from the other datasets. The parameter of shuffle is 16 bytes before.
  const std::size_t at = file.find(std::string("deflate\0\1\0\0\0", 12));
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(file[at - 16], 4);
  file[at - 16] = 2;
  seal::Apply(file);
  EXPECT_EQ(testing::Problem(file), "variable 'thu' is shuffled by 2 bytes: expected the 4 of a value");
}

// HDF5 1.10 would read beyond the data, in memory that it does not own; 1.14 does not open such a dataset.
TEST(ForeignStorage, IsRefusedIfDataInTheObjectHeaderIsTooShort) {
  const std::vector<float> values(16, 42.5f);
  std::string file = testing::Forge([&](hid_t root) {
    const Handle creation = Creation();
    H5Pset_layout(creation, H5D_COMPACT);
    ReplaceThu(root, creation);
    const Handle thu(H5Dopen2(root, "thu", H5P_DEFAULT), H5Dclose);
    H5Dwrite(thu, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  });
  std::string piece = {64, 0};  // Its length, two bytes, comes first.
  piece.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  const std::size_t at = file.find(piece);
  ASSERT_NE(at, std::string::npos);
  file[at] = 21;
  seal::Apply(file);
  EXPECT_THAT(testing::Problem(file),
              AnyOf("variable 'thu' has 16 values in 21 bytes: expected 64 bytes", "variable 'thu' is not a dataset"));
}

}  // namespace
}  // namespace albtpu
