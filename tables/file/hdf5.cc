#include "tables/file/hdf5.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <string_view>

#include "absl/strings/str_format.h"
#include "status/status_macros.h"
#include "tables/file/hdf5_exit.h"
#include "tables/format.h"

namespace albtpu::hdf5 {
namespace {

// HDF5 may be built without thread safety; this lock makes up for it.
std::mutex& ProcessLock() {
  static std::mutex mutex;
  return mutex;
}

// ---- writing

bool Write(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type, hid_t space, const void* data) {
  const Handle attribute(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && (data == nullptr || H5Awrite(attribute, memory_type, data) >= 0);
}

struct AttributeWriter {
  hid_t object;
  const std::string& name;

  bool operator()(const std::string& text) const {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_size(type, text.empty() ? 1 : text.size());
    const Handle space(H5Screate(text.empty() ? H5S_NULL : H5S_SCALAR), H5Sclose);
    return Write(object, name, type, type, space, text.empty() ? nullptr : text.data());
  }
  bool operator()(std::int64_t number) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    return Write(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, &number);
  }
  bool operator()(double number) const {
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    return Write(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &number);
  }
  bool operator()(const std::vector<double>& numbers) const {
    const hsize_t size = numbers.size();
    const Handle space(numbers.empty() ? H5Screate(H5S_NULL) : H5Screate_simple(1, &size, nullptr), H5Sclose);
    return Write(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, numbers.empty() ? nullptr : numbers.data());
  }
};

// ---- reading

absl::Status Unreadable(const std::string& name) {
  return absl::InvalidArgumentError(absl::StrFormat("attribute '%s' cannot be read", name));
}

// Called before memory of the size that an attribute claims is allocated.
absl::Status CheckSize(std::size_t count, std::size_t size, const std::string& name) {
  if (count <= format::kMaxAttributeBytes / size) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrFormat(
      "attribute '%s' is longer than %d bytes, the most that an attribute may have", name, format::kMaxAttributeBytes));
}

absl::StatusOr<AttributeValue> ReadFixedText(hid_t attribute, hid_t type, const std::string& name) {
  const std::size_t size = H5Tget_size(type);
  RETURN_IF_ERROR(CheckSize(size, 1, name));
  std::string text(size, '\0');
  const Handle memory_type(H5Tcopy(type), H5Tclose);
  if (H5Aread(attribute, memory_type, text.data()) < 0) return Unreadable(name);
  return text.substr(0, text.find('\0'));
}

absl::StatusOr<AttributeValue> ReadVariableText(hid_t attribute, hid_t type, const std::string& name) {
  const Handle memory_type(H5Tcopy(type), H5Tclose);
  char* text = nullptr;
  if (H5Aread(attribute, memory_type, &text) < 0) return Unreadable(name);
  std::string copy(text == nullptr ? "" : text);
  H5free_memory(text);
  RETURN_IF_ERROR(CheckSize(copy.size(), 1, name));
  return copy;
}

template <typename Number>
absl::StatusOr<AttributeValue> ReadNumber(hid_t attribute, hid_t memory_type, const std::string& name) {
  Number number = 0;
  if (H5Aread(attribute, memory_type, &number) < 0) return Unreadable(name);
  return number;
}

absl::StatusOr<AttributeValue> ReadNumbers(hid_t attribute, hsize_t count, const std::string& name) {
  RETURN_IF_ERROR(CheckSize(count, sizeof(double), name));
  std::vector<double> numbers(count);
  if (H5Aread(attribute, H5T_NATIVE_DOUBLE, numbers.data()) < 0) return Unreadable(name);
  return numbers;
}

}  // namespace

// HDF5's exit handler is turned off. We close everything that we open, so that it would find only what HDF5 1.10
// lost track of in damaged files: parts of object headers that it never frees, for which it prints "infinite loop
// closing library", and files whose closing failed, which it has freed but would close again by their identifiers.
void CloseNothingAtExit() { [[maybe_unused]] static const herr_t without_exit_handler = H5dont_atexit(); }

Session::Session() : lock_(ProcessLock()) {
  CloseNothingAtExit();
  H5Eget_auto2(H5E_DEFAULT, &printer_, &printer_data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session() { H5Eset_auto2(H5E_DEFAULT, printer_, printer_data_); }

std::string NameInMemory() {
  static std::atomic<std::uint64_t> count = 0;
  return absl::StrFormat("/dev/null/table-%d", ++count);
}

// The in-memory driver expects to own its image. These callbacks lend it ours: whatever it allocates, copies or
// frees is the one buffer, which is their user data.
Handle OpenImage(absl::string_view bytes) {
  const auto lend = [](size_t, H5FD_file_image_op_t, void* buffer) -> void* { return buffer; };
  const auto copy = [](void* to, const void*, size_t, H5FD_file_image_op_t, void*) -> void* { return to; };
  const auto grow = [](void*, size_t, H5FD_file_image_op_t, void*) -> void* { return nullptr; };
  const auto take_back = [](void*, H5FD_file_image_op_t, void*) -> herr_t { return 0; };
  const auto same = [](void* buffer) -> void* { return buffer; };
  const auto keep = [](void*) -> herr_t { return 0; };
  void* const buffer = const_cast<char*>(bytes.data());  // Nothing writes through a file opened for reading.
  H5FD_file_image_callbacks_t callbacks = {lend, copy, grow, take_back, same, keep, buffer};

  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t kIncrement = std::size_t{1} << 20;
  constexpr hbool_t kOnDisk = false;
  H5Pset_fapl_core(access, kIncrement, kOnDisk);
  H5Pset_file_image_callbacks(access, &callbacks);
  H5Pset_file_image(access, buffer, bytes.size());
  // Closing the file also closes objects that HDF5 lost track of.
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  return Handle(H5Fopen(NameInMemory().c_str(), H5F_ACC_RDONLY, access), H5Fclose);
}

bool WriteAttribute(hid_t object, const std::string& name, const AttributeValue& value) {
  return std::visit(AttributeWriter{object, name}, value);
}

absl::StatusOr<AttributeValue> ReadAttribute(hid_t object, const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0)
    return absl::NotFoundError(absl::StrFormat("attribute '%s' is missing", name));
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  const Handle space(H5Aget_space(attribute), H5Sclose);
  const H5S_class_t extent = H5Sget_simple_extent_type(space);
  const H5T_class_t kind = H5Tget_class(type);
  const bool is_null = extent == H5S_NULL;
  // netCDF-4 writes integers and some texts as lists of one. A list of real numbers stays a list.
  const bool is_scalar =
      extent == H5S_SCALAR || (kind != H5T_FLOAT && extent == H5S_SIMPLE && H5Sget_simple_extent_npoints(space) == 1);

  if (kind == H5T_STRING && is_null) return std::string();
  if (kind == H5T_STRING && is_scalar) {
    return H5Tis_variable_str(type) > 0 ? ReadVariableText(attribute, type, name)
                                        : ReadFixedText(attribute, type, name);
  }
  if (kind == H5T_INTEGER && is_scalar && H5Tget_sign(type) == H5T_SGN_NONE) {
    std::uint64_t number = 0;
    if (H5Aread(attribute, H5T_NATIVE_UINT64, &number) >= 0 && number > std::numeric_limits<std::int64_t>::max())
      return absl::InvalidArgumentError(absl::StrFormat("attribute '%s' is %d: it should be below 2^63", name, number));
  }
  if (kind == H5T_INTEGER && is_scalar) return ReadNumber<std::int64_t>(attribute, H5T_NATIVE_INT64, name);
  if (kind == H5T_FLOAT && is_scalar) return ReadNumber<double>(attribute, H5T_NATIVE_DOUBLE, name);
  if (kind == H5T_FLOAT && is_null) return std::vector<double>();
  hsize_t count = 0;
  if (kind == H5T_FLOAT && H5Sget_simple_extent_ndims(space) == 1 &&
      H5Sget_simple_extent_dims(space, &count, nullptr) == 1)
    return ReadNumbers(attribute, count, name);
  return absl::InvalidArgumentError(absl::StrFormat(
      "attribute '%s' is of another kind: it may be text, an integer, a real number or a list of them", name));
}

absl::StatusOr<std::vector<std::string>> AttributeNames(hid_t object) {
  std::vector<std::string> names;
  const auto append = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &names) < 0)
    return absl::InvalidArgumentError("the attributes cannot be listed");
  return names;
}

}  // namespace albtpu::hdf5
