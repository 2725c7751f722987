// Reads a finished grid (netcdf_grid.h) by windows, to write it in other formats.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace albtpu {

// Rows from the north, columns from the west.
struct GridWindow {
  std::size_t row = 0, column = 0, rows = 0, columns = 0;
};

class NetcdfReader {
 public:
  static absl::StatusOr<NetcdfReader> Open(const std::filesystem::path& path);
  NetcdfReader(NetcdfReader&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}
  NetcdfReader& operator=(NetcdfReader&&) = delete;
  ~NetcdfReader();

  // Values of a variable, whatever its type is, row by row. What stands for no value, in counts and codes 0, becomes
  // NaN.
  absl::Status Read(const std::string& variable, const GridWindow& window, std::vector<float>& values) const;

 private:
  NetcdfReader(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  absl::Status CannotRead(int result) const;

  std::filesystem::path path_;
  int file_;
};

}  // namespace albtpu
