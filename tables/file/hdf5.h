// What we need around the C library of HDF5: one caller at a time, silence, and handles that close
// themselves.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "tables/provenance.h"

namespace albtpu::hdf5 {

// While one lives, no other thread of the process is in HDF5 through us, and HDF5 prints nothing to standard
// error. Nor does it at the end of the program, where it would go through what damaged files made it lose.
class Session {
 public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  std::lock_guard<std::mutex> lock_;
  H5E_auto2_t printer_ = nullptr;
  void* printer_data_ = nullptr;
};

// An HDF5 object with the function that closes it. What failed to open is false, and HDF5 refuses it wherever
// it is used, so that a sequence of calls may be checked at its end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it is one, to the C library.

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// What HDF5 calls a file in memory: another name each time, since of two files of one name it takes the
// second to be the first, whatever their bytes, for as long as it has that open; and damage may keep it open.
// It looks for the name on disk, too, and if there is such a file it refuses the bytes; behind a device there
// is none.
std::string NameInMemory();

// Opens the bytes of a file in memory, without a copy, to be read only. They must outlive what is returned.
Handle OpenImage(absl::string_view bytes);

// Writes an attribute: text as a fixed-length UTF-8 string, numbers as 64 bits, a vector as one dimension;
// what is empty as a null dataspace, as netCDF does. False if HDF5 refuses.
bool WriteAttribute(hid_t object, const std::string& name, const AttributeValue& value);

// An attribute by its name. Text may be of fixed or variable length,
// numbers of any size. NotFound: there is none of that name. InvalidArgument: it is of a kind that
// AttributeValue does not have.
absl::StatusOr<AttributeValue> ReadAttribute(hid_t object, const std::string& name);

// The names of all attributes of an object, sorted; fails only if HDF5 cannot read them.
absl::StatusOr<std::vector<std::string>> AttributeNames(hid_t object);

}  // namespace albtpu::hdf5
