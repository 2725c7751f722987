// Arbitrary bytes as a table file are rejected with a reason, or are a table for which both interpolators agree. In
// either case HDF5 has no more objects open than before.
#include <hdf5.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "tables/file/hdf5.h"
#include "tables/file/hdf5_numbers.h"
#include "tables/file/seal.h"
#include "tables/file/table_encoder.h"
#include "tables/format.h"
#include "tables/schema.h"
#include "tables/water/water_schema.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/table_checks.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::fuzz {
namespace {

using hdf5::Handle;

// The second kind.
void CheckWaterFile(absl::string_view file) {
  absl::StatusOr<Table> table = DecodeTable(file, kWaterColumn);
  if (table.ok()) return CheckWater(*std::move(table));
  ALBTPU_MUST(absl::IsDataLoss(table.status()) || absl::IsInvalidArgument(table.status()));
}

// HDF5 keeps nothing of a rejected file that affects the next one: another table is read correctly.
void ReadAnother() {
  static const UncertaintyTable table = testing::TinyTable();
  static const std::string sealed = EncodeTable(table).value();
  const std::string file = sealed;  // Likely in the memory of the previous file.
  const absl::StatusOr<UncertaintyTable> another = DecodeTable(file);
  ALBTPU_MUST(another.ok() && another->digest() == table.digest());
}

ssize_t OpenInHdf5() {
  const hdf5::Session session;
  return H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL);
}

void TableTarget(std::string_view input) {
  const absl::string_view file(input.data(), input.size());
  const ssize_t open_before = OpenInHdf5();
  const absl::StatusOr<UncertaintyTable> table = DecodeTable(file);
  ALBTPU_MUST(OpenInHdf5() == open_before);
  if (table.ok()) return CheckAnswers(*table);
  ALBTPU_MUST(absl::IsDataLoss(table.status()) || absl::IsInvalidArgument(table.status()));
  ALBTPU_MUST(!table.status().message().empty());
  CheckWaterFile(file);
  ALBTPU_MUST(OpenInHdf5() == open_before);
  if (IsOneIn(16, input) && seal::Check(file).ok()) ReadAnother();
}

constexpr std::size_t kMostNumbers = 4096;  // Larger datasets are not changed.

// One that the file has, or one that it may have.
std::string AnyDataset(hid_t file, Random& random) {
  std::string name = "fetch";
  H5G_info_t group;
  if (H5Gget_info(file, &group) >= 0 && group.nlinks > 0) {
    std::array<char, 64> text{};
    H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_NATIVE, random() % group.nlinks, text.data(), text.size(),
                       H5P_DEFAULT);
    name = text.data();
  }
  return random() % 16 == 0 ? name + std::string(kStandardErrorSuffix) : name;
}

AttributeValue AnyValue(Random& random) {
  static const char* const kTexts[] = {"",    "m", "degree", "m s-1", "linear", "log",     "2 sigma",
                                       "x\n", "1", "a",      "\xff",  "95 %",   "[a]\nb=1"};
  switch (random() % 6) {
    case 0:
      return static_cast<std::int64_t>(random()) - 7;
    case 1:
      return static_cast<double>(AnyTableNumber(random));
    case 2:
      return std::vector<double>(random() % 5, AnyTableNumber(random));
    case 3:
      return std::string(random() % 3000, 'x');
    default:
      return std::string(AnyOf(kTexts, random));
  }
}

void ChangeNumbers(hid_t file, Random& random) {
  const Handle dataset(H5Dopen2(file, AnyDataset(file, random).c_str(), H5P_DEFAULT), H5Dclose);
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 1 || static_cast<std::size_t>(count) > kMostNumbers) return;
  std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  absl::StatusOr<std::vector<float>> numbers = hdf5::ReadFloats(dataset, shape);
  if (!numbers.ok()) return;
  for (std::uint32_t i = 0; i <= random() % 3; ++i) (*numbers)[random() % numbers->size()] = AnyTableNumber(random);
  H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers->data());
}

void ChangeAttribute(hid_t file, Random& random) {
  static const char* const kNames[] = {"units", "interpolation", "id",       "version", "title", "campaign",
                                       "seed",  "_FillValue",    "coverage", "of_mine", "source"};
  const std::string object = random() % 2 == 0 ? "/" : AnyDataset(file, random);
  const Handle at(H5Oopen(file, object.c_str(), H5P_DEFAULT), H5Oclose);
  const std::string name = AnyOf(kNames, random);
  H5Adelete(at, name.c_str());
  if (random() % 8 != 0) hdf5::WriteAttribute(at, name, AnyValue(random));
}

// Replaces a dataset by one of another type, shape, layout or filter, with the attributes of a dataset.
void ReplaceDataset(hid_t file, Random& random) {
  const std::string name = AnyDataset(file, random);
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  std::vector<hsize_t> shape(random() % 7, 1);
  for (hsize_t& size : shape) size = random() % 3 == 0 ? random() % 4 : 2;
  if (!shape.empty() && random() % 16 == 0) shape[0] = hsize_t{1} << (random() % 40);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const bool chunked = !shape.empty() && random() % 2 == 0;
  if (chunked) H5Pset_chunk(creation, static_cast<int>(shape.size()), std::vector<hsize_t>(shape.size(), 1).data());
  if (chunked && random() % 2 == 0) H5Pset_fletcher32(creation);
  if (!chunked && random() % 4 == 0) H5Pset_external(creation, "/dev/zero", 0, H5F_UNLIMITED);
  const hid_t types[] = {H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_IEEE_F64LE, H5T_STD_I32LE};
  const Handle space(shape.empty() ? H5Screate(random() % 2 == 0 ? H5S_SCALAR : H5S_NULL)
                                   : H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle dataset(H5Dcreate2(file, name.c_str(), AnyOf(types, random), space, H5P_DEFAULT, creation, H5P_DEFAULT),
                       H5Dclose);
  hdf5::WriteAttribute(dataset, "units", AnyValue(random));
  hdf5::WriteAttribute(dataset, "interpolation", std::string("linear"));
}

void Relink(hid_t file, Random& random) {
  const std::string name = AnyDataset(file, random), other = AnyDataset(file, random);
  if (name == other) return;
  H5Ldelete(file, name.c_str(), H5P_DEFAULT);
  switch (random() % 4) {
    case 0:
      H5Lcreate_hard(file, other.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      return;
    case 1:
      H5Lcreate_soft(other.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      return;
    case 2:
      H5Lcreate_external("/dev/null", "/thu", file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      return;
    default:
      H5Gclose(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
}

std::string Edited(const std::string& bytes, const std::function<void(hid_t)>& edit) {
  const hdf5::Session session;
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, std::size_t{1} << 16, false);
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());
  const hid_t opened = H5Fopen(hdf5::NameInMemory().c_str(), H5F_ACC_RDWR, access);
  if (opened < 0) return bytes;
  edit(opened);
  // A damaged file that cannot be flushed stays open: on closing it, HDF5 1.10 frees it, finds that it was not flushed,
  // keeps its identifier, and later crashes on that identifier.
  if (H5Fflush(opened, H5F_SCOPE_GLOBAL) < 0) return bytes;
  const Handle file(opened, H5Fclose);
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) return bytes;
  std::string edited(seal::kSize + static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, edited.data() + seal::kSize, static_cast<std::size_t>(size)) != size) return bytes;
  seal::Apply(edited);
  return edited;
}

// Changes a table file at random but keeps it a sealed HDF5 file, as another program might write it. Returns the file
// unchanged if HDF5 cannot open it.
std::string EditTable(const std::string& file, Random& random) {
  return Edited(file, [&](hid_t root) {
    switch (random() % 8) {
      case 0:
        return ReplaceDataset(root, random);
      case 1:
        return Relink(root, random);
      case 2:
      case 3:
        return ChangeAttribute(root, random);
      default:
        return ChangeNumbers(root, random);
    }
  });
}

// The file with another content digest.
std::string WithDigest(const std::string& file, const std::string& digest) {
  return Edited(file, [&](hid_t root) {
    const std::string name(format::kContentDigest);
    H5Adelete(root, name.c_str());
    hdf5::WriteAttribute(root, name, digest);
  });
}

// The digest of the content, taken from the message that rejects another digest.
std::string DigestOf(const std::string& file) {
  const std::string message(DecodeTable(file).status().message());
  const std::string words = "the content has '";
  const std::size_t at = message.find(words);
  return at == std::string::npos ? "" : message.substr(at + words.size(), 64);
}

// Changes the contents, through HDF5 or byte by byte, and seals them again, so that inputs reach the decoder behind the
// seal. If only the content digest is then wrong, it is corrected, too. Some inputs stay unsealed.
std::string MutateTable(std::string_view input, std::size_t most, Random& random) {
  if (input.size() <= seal::kSize || random() % 32 == 0) return "";
  std::string file(input);
  if (random() % 4 == 0) {
    file = file.substr(0, seal::kSize) + MutateBytes(file.substr(seal::kSize), most - seal::kSize);
    seal::Apply(file);
    return file;
  }
  file = EditTable(file, random);
  const std::string digest = DigestOf(file);
  return digest.empty() ? file : WithDigest(file, digest);
}

}  // namespace

const std::vector<Target> kTargets = {{"table", TableTarget, MutateTable}};

}  // namespace albtpu::fuzz
