// Files with an intact seal that are not valid tables: written by another program, or by ours with an error.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/tables/file/forged_table.h"

namespace albtpu {
namespace {

using hdf5::Handle;
using testing::Forge;
using ::testing::HasSubstr;
using testing::Problem;
using testing::ProblemAfter;

void SetNode(hid_t file, const char* axis, std::vector<float> nodes) {
  const Handle dataset(H5Dopen2(file, axis, H5P_DEFAULT), H5Dclose);
  EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes.data()), 0);
}

// Sets every value of a variable of the tiny table, which has at most 16.
void SetValues(hid_t file, const char* variable, float value) {
  SetNode(file, variable, std::vector<float>(16, value));
}

// Replaces a dataset by one of another type or shape that has the required attributes.
void Replace(hid_t file, const char* name, hid_t type, const std::vector<hsize_t>& shape, const char* units) {
  H5Ldelete(file, name, H5P_DEFAULT);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  if (!shape.empty())
    H5Pset_chunk(creation, static_cast<int>(shape.size()), std::vector<hsize_t>(shape.size(), 1).data());
  const Handle space(
      shape.empty() ? H5Screate(H5S_SCALAR) : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
      H5Sclose);
  const Handle dataset(H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  EXPECT_TRUE(dataset);
  EXPECT_TRUE(hdf5::WriteAttribute(dataset, "units", std::string(units)));
  EXPECT_TRUE(hdf5::WriteAttribute(dataset, "interpolation", std::string("linear")));
}

void SetAttribute(hid_t file, const char* object, const char* name, const AttributeValue& value) {
  const Handle at(H5Oopen(file, object, H5P_DEFAULT), H5Oclose);
  H5Adelete(at, name);
  EXPECT_TRUE(hdf5::WriteAttribute(at, name, value));
}

TEST(WrongSchema, IsNotFoundInAnUnchangedFile) {
  std::string file = Forge([](hid_t) {});
  EXPECT_TRUE(DecodeTable(file).ok()) << DecodeTable(file).status();
}

TEST(WrongSchema, IsFoundIfThereIsNoHdf5) {
  std::string file(2000, 'x');
  seal::Apply(file);
  EXPECT_THAT(Problem(file), HasSubstr("is not HDF5"));
  file.resize(seal::kSize);
  seal::Apply(file);
  EXPECT_THAT(Problem(file), HasSubstr("is not HDF5"));
}

TEST(WrongSchema, IsFoundIfADatasetIsMissing) {
  EXPECT_EQ(ProblemAfter([](hid_t file) { H5Ldelete(file, "depth", H5P_DEFAULT); }), "axis 'depth' is missing");
  EXPECT_THAT(ProblemAfter([](hid_t file) { H5Ldelete(file, "tvu", H5P_DEFAULT); }),
              HasSubstr("variable 'tvu' is missing"));
}

TEST(WrongSchema, IsFoundIfADatasetIsAGroup) {
  EXPECT_EQ(ProblemAfter([](hid_t file) {
              H5Ldelete(file, "thu", H5P_DEFAULT);
              const Handle group(H5Gcreate2(file, "thu", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
            }),
            "variable 'thu' is not a dataset");
}

TEST(WrongSchema, IsFoundInTheRank) {
  EXPECT_EQ(ProblemAfter([](hid_t file) {
              Replace(file, "depth", H5T_IEEE_F32LE, {2, 1}, "m");
            }),
            "axis 'depth' has 2 dimensions: it should have 1");
  EXPECT_EQ(ProblemAfter([](hid_t file) { Replace(file, "depth", H5T_IEEE_F32LE, {}, "m"); }),
            "axis 'depth' has 0 dimensions: it should have 1");
  EXPECT_EQ(ProblemAfter([](hid_t file) { Replace(file, "thu", H5T_IEEE_F32LE, {16}, "m"); }),
            "variable 'thu' has the shape (16): its axes have (2, 1, 2, 2, 1, 2)");
}

TEST(WrongSchema, IsFoundInTheShape) {
  EXPECT_EQ(ProblemAfter([](hid_t file) {
              Replace(file, "thu", H5T_IEEE_F32LE, {2, 1, 2, 2, 2, 1}, "m");
            }),
            "variable 'thu' has the shape (2, 1, 2, 2, 2, 1): its axes have (2, 1, 2, 2, 1, 2)");
}

TEST(WrongSchema, IsFoundInTheType) {
  EXPECT_EQ(ProblemAfter([](hid_t file) { Replace(file, "depth", H5T_IEEE_F64LE, {2}, "m"); }),
            "axis 'depth' is of another type: it should be float32");
  EXPECT_EQ(ProblemAfter([](hid_t file) {
              Replace(file, "thu", H5T_STD_I32LE, {2, 1, 2, 2, 1, 2}, "m");
            }),
            "variable 'thu' is of another type: it should be float32");
}

TEST(WrongSchema, IsFoundInHugeSizes) {
  EXPECT_EQ(ProblemAfter([](hid_t file) { Replace(file, "depth", H5T_IEEE_F32LE, {hsize_t{1} << 40}, "m"); }),
            "axis 'depth' has 1099511627776 nodes: it may have 65536 at most");
  EXPECT_THAT(ProblemAfter([](hid_t file) {
                const std::vector<hsize_t> shape = {hsize_t{1} << 20, 1, 2, 2, 1, hsize_t{1} << 30};
                Replace(file, "thu", H5T_IEEE_F32LE, shape, "m");
              }),
              HasSubstr("its axes have (2, 1, 2, 2, 1, 2)"));
}

TEST(WrongSchema, IsFoundInAnAxisWithoutNodes) {
  EXPECT_THAT(ProblemAfter([](hid_t file) {
                H5Ldelete(file, "depth", H5P_DEFAULT);
                const hsize_t none = 0;
                const Handle space(H5Screate_simple(1, &none, nullptr), H5Sclose);
                const Handle dataset(
                    H5Dcreate2(file, "depth", H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
                hdf5::WriteAttribute(dataset, "units", std::string("m"));
                hdf5::WriteAttribute(dataset, "interpolation", std::string("linear"));
              }),
              HasSubstr("axis 'depth' has no nodes"));
}

TEST(WrongSchema, IsFoundInNodesOutOfOrder) {
  EXPECT_EQ(ProblemAfter([](hid_t file) {
              SetNode(file, "depth", {10, 5});
            }),
            "axis 'depth' node 1 is 5 m, not above node 0 (10 m): nodes must increase");
  EXPECT_THAT(ProblemAfter([](hid_t file) {
                SetNode(file, "wind_speed", {std::nanf(""), 5});
              }),
              HasSubstr("nodes must be finite"));
}

TEST(WrongSchema, IsFoundInValues) {
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetValues(file, "thu", std::nanf("")); }), HasSubstr("must be finite"));
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetValues(file, "bias_vertical", -2e6f); }),
              HasSubstr("must not be above 1e6"));
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetValues(file, "tvu", -1); }), HasSubstr("must not be negative"));
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetValues(file, "thu_standard_error", -1); }),
              HasSubstr("variable 'thu_standard_error' is -1"));
}

TEST(WrongSchema, IsFoundInTheContentDigest) {
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetValues(file, "thu", 0.5f); }),
              HasSubstr("attribute 'content_digest' is '"));
}

TEST(WrongSchema, IsFoundInUnits) {
  EXPECT_EQ(ProblemAfter([](hid_t file) { SetAttribute(file, "wind_speed", "units", std::string("knot")); }),
            "axis 'wind_speed' is in 'knot': it should be in 'm s-1'");
  EXPECT_EQ(ProblemAfter([](hid_t file) { SetAttribute(file, "thu", "units", 1.0); }),
            "variable 'thu' has no units: attribute 'units' is a number: it should be text");
}

TEST(WrongSchema, IsFoundInTheInterpolation) {
  EXPECT_EQ(ProblemAfter([](hid_t file) { SetAttribute(file, "thu", "interpolation", std::string("cubic")); }),
            "variable 'thu' has interpolation 'cubic': it should be 'linear' or 'log'");
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetAttribute(file, "depth", "interpolation", std::string("log")); }),
              HasSubstr("nodes on a log scale must be positive"));
}

TEST(WrongSchema, IsFoundInGlobalAttributes) {
  for (const char* name : {"id", "version", "title", "campaign", "content_digest", "coverage"}) {
    EXPECT_EQ(ProblemAfter([&](hid_t file) { H5Adelete(file, name); }),
              "attribute '" + std::string(name) + "' is missing");
  }
  EXPECT_EQ(ProblemAfter([](hid_t file) { SetAttribute(file, "/", "coverage", std::string("95 %")); }),
            "attribute 'coverage' is '95 %': it should be '2 sigma'");
  EXPECT_THAT(ProblemAfter([](hid_t file) { SetAttribute(file, "/", "id", std::string("A Name")); }),
              HasSubstr("attribute 'id' is 'A Name'"));
}

TEST(WrongSchema, IsFoundInAnAttributeOfAnUnsupportedType) {
  EXPECT_THAT(ProblemAfter([](hid_t file) {
                const hsize_t shape[] = {2, 2};
                const Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
                const Handle attribute(H5Acreate2(file, "matrix", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                                       H5Aclose);
              }),
              HasSubstr("attribute 'matrix' is of another kind"));
}

TEST(WrongSchema, IsNotFoundInWhatReadersIgnore) {
  std::string file = Forge([](hid_t f) { Replace(f, "water_column", H5T_STD_I32LE, {3}, "m"); });
  EXPECT_TRUE(DecodeTable(file).ok()) << DecodeTable(file).status();
}

// As h5py writes attributes: text of variable length, numbers of other sizes.
TEST(WrongSchema, IsNotFoundInOtherTypesOfTextAndNumber) {
  std::string file = Forge([](hid_t f) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Adelete(f, "source");
    const Handle text(H5Acreate2(f, "source", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const char* value = "elsewhere";
    H5Awrite(text, type, &value);
    const Handle number(H5Acreate2(f, "short", H5T_STD_I16BE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const int seven = 7;
    H5Awrite(number, H5T_NATIVE_INT, &seven);
  });
  const absl::StatusOr<UncertaintyTable> table = DecodeTable(file);
  EXPECT_EQ(table->provenance().attributes.at("source"), AttributeValue(std::string("elsewhere")));
  EXPECT_EQ(table->provenance().attributes.at("short"), AttributeValue(std::int64_t{7}));
}

}  // namespace
}  // namespace albtpu
