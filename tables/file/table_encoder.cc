#include "tables/file/table_encoder.h"

#include <hdf5_hl.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "absl/status/status.h"
#include "tables/file/hdf5.h"
#include "tables/file/seal.h"
#include "tables/format.h"

namespace albtpu {
namespace {

using hdf5::Handle;

std::vector<hsize_t> Shape(const Table& table, const QuantitySchema& quantity) {
  std::vector<hsize_t> shape;
  for (const Axis& axis : table.axes()) shape.push_back(axis.size());
  if (!quantity.over_last_axis) shape.pop_back();
  return shape;
}

// As many of the fastest axes as fit into a chunk, then a part of the next axis, then one node of each of the others.
std::vector<hsize_t> ChunkShape(std::vector<hsize_t> shape) {
  hsize_t room = format::kMaxChunkValues;
  for (std::size_t i = shape.size(); i-- > 0;) {
    shape[i] = std::min(shape[i], room);
    room = std::max<hsize_t>(room / shape[i], 1);
  }
  return shape;
}

// Builds the HDF5 part in memory. A call that fails does not stop the others; `ok_` shows at the end whether all
// succeeded.
class Encoder {
 public:
  explicit Encoder(const Table& table) : table_(table), file_(CreateFile()) {}

  absl::StatusOr<std::string> Encode() {
    WriteGlobalAttributes();
    for (const Axis& axis : table_.axes()) WriteAxis(axis);
    for (std::size_t q = 0; q < table_.schema().quantities.size(); ++q)
      if (const Variable* variable = table_.variable(q)) WriteVariable(table_.schema().quantities[q], *variable);
    std::string image = Image();
    if (!ok_) return absl::InternalError("HDF5 cannot build the table in memory");
    seal::Apply(image);
    return image;
  }

 private:
  void Require(bool done) { ok_ = ok_ && done; }

  static Handle CreateFile() {
    // Neither times nor addresses may get into the bytes. Attributes and datasets keep the order in which they are
    // created, which netCDF shows.
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_userblock(creation, seal::kSize);
    H5Pset_obj_track_times(creation, false);
    H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    constexpr std::size_t kIncrement = std::size_t{1} << 20;
    constexpr hbool_t kOnDisk = false;
    H5Pset_fapl_core(access, kIncrement, kOnDisk);
    // The oldest superblock: with a newer one, HDF5 1.10 returns an image that fails its own checksum.
    H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
    return Handle(H5Fcreate(hdf5::NameInMemory().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  }

  static Handle DatasetCreation() {
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return creation;
  }

  void WriteText(hid_t object, std::string_view name, std::string_view text) {
    Require(hdf5::WriteAttribute(object, std::string(name), std::string(text)));
  }

  void WriteGlobalAttributes() {
    const Provenance& provenance = table_.provenance();
    WriteText(file_, format::kConventions, format::kConventionsValue);
    WriteText(file_, format::kId, provenance.id);
    WriteText(file_, format::kVersion, provenance.version);
    WriteText(file_, format::kTitle, provenance.title);
    WriteText(file_, format::kCoverage, format::kCoverageValue);
    const std::string_view kind = table_.schema().name;
    if (kind != format::kDefaultTableKind) WriteText(file_, format::kTableKind, kind);
    WriteText(file_, format::kContentDigest, table_.digest());
    for (const auto& [name, value] : provenance.attributes) Require(hdf5::WriteAttribute(file_, name, value));
    WriteText(file_, format::kCampaign, provenance.campaign);
  }

  void WriteAxis(const Axis& axis) {
    const AxisSchema& schema = axis.schema();
    const std::string name(schema.name);
    const std::vector<float> nodes(axis.nodes().begin(), axis.nodes().end());
    const hsize_t size = nodes.size();
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle dataset(
        H5Dcreate2(file_, name.c_str(), H5T_IEEE_F32LE, space, H5P_DEFAULT, DatasetCreation(), H5P_DEFAULT), H5Dclose);
    Require(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes.data()) >= 0);
    Require(H5DSset_scale(dataset, name.c_str()) >= 0);
    WriteText(dataset, format::kUnits, schema.units);
    WriteText(dataset, format::kLongName, schema.long_name);
    WriteText(dataset, format::kInterpolation, Name(axis.scale()));
  }

  void WriteVariable(const QuantitySchema& quantity, const Variable& variable) {
    const std::string name(quantity.name);
    const std::string error_name = name + std::string(kStandardErrorSuffix);
    const std::string long_name(quantity.long_name);
    const Handle dataset = WriteValues(quantity, name, long_name, variable.scale, variable.values);
    if (variable.standard_errors.empty()) return;
    WriteText(dataset, format::kAncillaryVariables, error_name);
    WriteValues(quantity, error_name, "standard error of: " + long_name, Scale::kLinear, variable.standard_errors);
  }

  Handle WriteValues(const QuantitySchema& quantity, const std::string& name, const std::string& long_name, Scale scale,
                     const std::vector<float>& values) {
    const std::vector<hsize_t> shape = Shape(table_, quantity);
    const int rank = static_cast<int>(shape.size());
    const float fill = std::numeric_limits<float>::quiet_NaN();
    const Handle creation = DatasetCreation();
    H5Pset_chunk(creation, rank, ChunkShape(shape).data());
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, format::kDeflateLevel);
    H5Pset_fill_value(creation, H5T_NATIVE_FLOAT, &fill);
    const Handle space(H5Screate_simple(rank, shape.data(), nullptr), H5Sclose);
    Handle dataset(H5Dcreate2(file_, name.c_str(), H5T_IEEE_F32LE, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                   H5Dclose);
    Require(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
    WriteText(dataset, format::kUnits, quantity.units);
    WriteText(dataset, format::kLongName, long_name);
    WriteText(dataset, format::kInterpolation, Name(scale));
    WriteFillValue(dataset, fill);
    for (std::size_t axis = 0; axis < shape.size(); ++axis) AttachAxis(dataset, axis);
    return dataset;
  }

  // One element of the type of the variable, single precision, as netCDF requires.
  void WriteFillValue(hid_t dataset, float fill) {
    const hsize_t one = 1;
    const Handle space(H5Screate_simple(1, &one, nullptr), H5Sclose);
    const Handle attribute(
        H5Acreate2(dataset, std::string(format::kFillValue).c_str(), H5T_IEEE_F32LE, space, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    Require(H5Awrite(attribute, H5T_NATIVE_FLOAT, &fill) >= 0);
  }

  void AttachAxis(hid_t dataset, std::size_t axis) {
    const std::string name(table_.schema().axes[axis].name);
    const Handle scale(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    Require(H5DSattach_scale(dataset, scale, static_cast<unsigned>(axis)) >= 0);
  }

  // The file with space for the seal: HDF5 returns its part without the user block.
  std::string Image() {
    Require(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    Require(size > 0);
    if (!ok_) return "";
    std::string image(seal::kSize + static_cast<std::size_t>(size), '\0');
    Require(H5Fget_file_image(file_, image.data() + seal::kSize, static_cast<std::size_t>(size)) == size);
    return image;
  }

  const Table& table_;
  hdf5::Session session_;
  Handle file_;
  bool ok_ = true;
};

}  // namespace

absl::StatusOr<std::string> EncodeTable(const Table& table) { return Encoder(table).Encode(); }

}  // namespace albtpu
