// Files with an intact seal that are not valid tables: written by another program, or by ours with an error.
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/tables/file/forged_table.h"

namespace albtpu {
namespace {

using hdf5::Handle;
using testing::ExpectProblems;
using testing::Forge;
using ::testing::HasSubstr;
using testing::Problem;

void SetNode(hid_t file, const char* axis, std::vector<float> nodes) {
  const Handle dataset(H5Dopen2(file, axis, H5P_DEFAULT), H5Dclose);
  EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes.data()), 0);
}

// Sets every value of a variable of the tiny table, which has at most 16.
void SetValues(hid_t file, const char* variable, float value) {
  SetNode(file, variable, std::vector<float>(16, value));
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

TEST(WrongSchema, IsFoundInADatasetThatIsMissingOrNone) {
  ExpectProblems({{[](hid_t file) { H5Ldelete(file, "depth", H5P_DEFAULT); }, "axis 'depth' is missing"},
                  {[](hid_t file) { H5Ldelete(file, "tvu", H5P_DEFAULT); }, HasSubstr("variable 'tvu' is missing")},
                  {[](hid_t file) {
                     H5Ldelete(file, "thu", H5P_DEFAULT);
                     const Handle group(H5Gcreate2(file, "thu", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
                   },
                   "variable 'thu' is not a dataset"}});
}

TEST(WrongSchema, IsFoundInShapesTypesAndSizes) {
  struct Case {
    const char* name;
    hid_t type;
    std::vector<hsize_t> shape;
    const char* problem;
  };
  { const hdf5::Session session; }  // HDF5 begins in one.
  const hid_t real = H5T_IEEE_F32LE;
  const Case cases[] = {
      {"depth", real, {2, 1}, "axis 'depth' has 2 dimensions: it should have 1"},
      {"depth", real, {}, "axis 'depth' has 0 dimensions: it should have 1"},
      {"depth", real, {0}, "axis 'depth' has no nodes"},
      {"depth", real, {hsize_t{1} << 40}, "axis 'depth' has 1099511627776 nodes: it may have 65536 at most"},
      {"depth", H5T_IEEE_F64LE, {2}, "axis 'depth' is of another type: it should be float32"},
      {"thu", real, {16}, "variable 'thu' has the shape (16): its axes have (2, 1, 2, 2, 1, 2)"},
      {"thu", real, {2, 1, 2, 2, 2, 1}, "variable 'thu' has the shape (2, 1, 2, 2, 2, 1): its axes have (2, 1, 2,"},
      {"thu", real, {hsize_t{1} << 20, 1, 2, 2, 1, hsize_t{1} << 30}, "its axes have (2, 1, 2, 2, 1, 2)"},
      {"thu", H5T_STD_I32LE, {2, 1, 2, 2, 1, 2}, "variable 'thu' is of another type: it should be float32"}};
  for (const Case& c : cases) {
    const auto replace = [&](hid_t file) {
      const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);  // in chunks: the huge ones take no space
      const std::vector<hsize_t> chunk(c.shape.size(), 1);
      if (!c.shape.empty() && c.shape[0] > 0) H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
      testing::Replace(file, c.name, c.type, c.shape, creation);
    };
    ExpectProblems({{replace, HasSubstr(c.problem)}});
  }
}

TEST(WrongSchema, IsFoundInNodesAndValues) {
  ExpectProblems(
      {{[](hid_t file) {
          SetNode(file, "depth", {10, 5});
        },
        "axis 'depth' node 1 is 5 m, not above node 0 (10 m): nodes must increase"},
       {[](hid_t file) {
          SetNode(file, "wind_speed", {std::nanf(""), 5});
        },
        HasSubstr("nodes must be finite")},
       {[](hid_t file) { SetValues(file, "thu", std::nanf("")); }, HasSubstr("must be finite")},
       {[](hid_t file) { SetValues(file, "bias_vertical", -2e6f); }, HasSubstr("must not be above 1e6")},
       {[](hid_t file) { SetValues(file, "tvu", -1); }, HasSubstr("must not be negative")},
       {[](hid_t file) { SetValues(file, "thu_standard_error", -1); }, HasSubstr("'thu_standard_error' is -1")},
       {[](hid_t file) { SetValues(file, "thu", 0.5f); }, HasSubstr("attribute 'content_digest' is '")}});
}

TEST(WrongSchema, IsFoundInAttributes) {
  struct Case {
    const char *object, *name;
    AttributeValue value;
    ::testing::Matcher<std::string> problem;
  };
  const Case cases[] = {
      {"wind_speed", "units", std::string("knot"), "axis 'wind_speed' is in 'knot': it should be in 'm s-1'"},
      {"thu", "units", 1.0, "variable 'thu' has no units: attribute 'units' is a number: it should be text"},
      {"thu", "interpolation", std::string("cubic"),
       "variable 'thu' has interpolation 'cubic': it should be 'linear' or 'log'"},
      {"depth", "interpolation", std::string("log"), HasSubstr("nodes on a log scale must be positive")},
      {"thu_standard_error", "interpolation", std::string("log"),
       "variable 'thu_standard_error' should have interpolation 'linear'"},
      {"/", "refractive_index", std::string("1.34"),
       HasSubstr("'refractive_index' should be a real number from 1 to 2")},
      {"/", "refractive_index", std::int64_t{1}, HasSubstr("should be a real number from 1 to 2")},
      {"/", "refractive_index", 0.0, HasSubstr("should be a real number from 1 to 2")},
      {"/", "refractive_index", std::nan(""), HasSubstr("should be a real number from 1 to 2")},
      {"/", "refractive_index", std::vector{1.34, 1.34}, HasSubstr("should be a real number from 1 to 2")},
      {"/", "coverage", std::string("95 %"), "attribute 'coverage' is '95 %': it should be '2 sigma'"},
      {"/", "id", std::string("A Name"), HasSubstr("attribute 'id' is 'A Name'")}};
  for (const Case& c : cases)
    ExpectProblems({{[&](hid_t file) { SetAttribute(file, c.object, c.name, c.value); }, c.problem}});
  for (const char* name : {"id", "version", "title", "campaign", "content_digest", "coverage"})
    ExpectProblems({{[&](hid_t file) { H5Adelete(file, name); }, "attribute '" + std::string(name) + "' is missing"}});
  ExpectProblems(
      {{[](hid_t file) {
          const hsize_t shape[] = {2, 2};
          const Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
          const Handle attribute(H5Acreate2(file, "matrix", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        },
        HasSubstr("attribute 'matrix' is of another kind")},
       {[](hid_t file) {
          const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
          const Handle attribute(H5Acreate2(file, "big", H5T_STD_U64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
          const std::uint64_t number = std::uint64_t{1} << 63;
          H5Awrite(attribute, H5T_NATIVE_UINT64, &number);
        },
        HasSubstr("attribute 'big' is 9223372036854775808: it should be below 2^63")}});
}

TEST(WrongSchema, IsNotFoundInWhatReadersIgnore) {
  std::string file = Forge([](hid_t f) { testing::Replace(f, "water_column", H5T_STD_I32LE, {3}); });
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

// As netCDF-4 writes attributes.
TEST(WrongSchema, IsNotFoundInListsOfOne) {
  std::string file = Forge([](hid_t f) {
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
    const auto write = [&](const char* name, hid_t type, const void* value) {
      H5Adelete(f, name);
      const Handle attribute(H5Acreate2(f, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      EXPECT_GE(H5Awrite(attribute, type, value), 0);
    };
    const double index = 1.34;
    write("refractive_index", H5T_NATIVE_DOUBLE, &index);
    const std::int64_t seed = 5;
    write("seed", H5T_NATIVE_INT64, &seed);
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    const char* text = "elsewhere";
    write("source", type, &text);
  });
  const absl::StatusOr<UncertaintyTable> table = DecodeTable(file);
  EXPECT_EQ(table->provenance().attributes.at("refractive_index"), AttributeValue(1.34));
  EXPECT_EQ(table->provenance().attributes.at("seed"), AttributeValue(std::int64_t{5}));
  EXPECT_EQ(table->provenance().attributes.at("source"), AttributeValue(std::string("elsewhere")));
}

}  // namespace
}  // namespace albtpu
