// A thin layer over the C library of HDF5: one caller at a time, no messages on standard error, and handles that
// close themselves.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "tables/provenance.h"

namespace albtpu::hdf5 {

// While a session exists, no other thread of the process calls HDF5 through this layer, and HDF5 prints nothing to
// standard error, nor at the end of the program (hdf5_exit.h).
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

// An HDF5 object with the function that closes it. A handle that failed to open is false, and HDF5 rejects it in
// every call, so that a sequence of calls may be checked at its end.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  explicit operator bool() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): the C library expects hid_t.

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// A name for a file in memory, different each time. HDF5 takes two open files with the same name for the same file,
// whatever their bytes, and damage may keep a file open. HDF5 also looks for the name on disk and refuses the bytes
// if there is such a file; the name lies below a device, where there can be no file.
std::string NameInMemory();

// Opens the bytes of a file in memory for reading, without a copy. They must outlive the handle.
Handle OpenImage(absl::string_view bytes);

// Writes an attribute: a text as a fixed-length UTF-8 string, a number with 64 bits, a vector as one dimension, and
// an empty text or vector as a null dataspace, as netCDF does. False if HDF5 refuses.
bool WriteAttribute(hid_t object, const std::string& name, const AttributeValue& value);

// The attribute of that name. Text may be of fixed or variable length, numbers of any size. NotFound: there is no
// such attribute. InvalidArgument: it is of a type that AttributeValue does not have.
absl::StatusOr<AttributeValue> ReadAttribute(hid_t object, const std::string& name);

// The sorted names of all attributes of an object. Fails only if HDF5 cannot read them.
absl::StatusOr<std::vector<std::string>> AttributeNames(hid_t object);

}  // namespace albtpu::hdf5
