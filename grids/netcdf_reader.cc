#include "grids/netcdf_reader.h"

#include <netcdf.h>

#include <array>
#include <limits>

#include "absl/strings/str_cat.h"
#include "grids/netcdf_grid.h"

namespace albtpu {

absl::StatusOr<NetcdfReader> NetcdfReader::Open(const std::filesystem::path& path) {
  NetcdfReader reader(path, -1);
  if (const int result = nc_open(path.c_str(), NC_NOWRITE, &reader.file_); result != NC_NOERR) {
    reader.file_ = -1;
    return reader.CannotRead(result);
  }
  return reader;
}

NetcdfReader::~NetcdfReader() {
  if (file_ != -1) nc_close(file_);
}

absl::Status NetcdfReader::CannotRead(int result) const {
  return absl::DataLossError(absl::StrCat(path_.string(), ": cannot be read: ", nc_strerror(result)));
}

absl::Status NetcdfReader::Read(const std::string& variable, const GridWindow& window,
                                std::vector<float>& values) const {
  int id = -1;
  nc_type type = NC_NAT;
  const std::array<std::size_t, 2> start = {window.row, window.column}, count = {window.rows, window.columns};
  values.resize(window.rows * window.columns);
  for (const int result : {nc_inq_varid(file_, variable.c_str(), &id), nc_inq_vartype(file_, id, &type),
                           nc_get_vara_float(file_, id, start.data(), count.data(), values.data())})
    if (result != NC_NOERR) return CannotRead(result);
  const float none = type == NC_FLOAT ? NetcdfGrid::kNoValue : 0;
  for (float& value : values)
    if (value == none) value = std::numeric_limits<float>::quiet_NaN();
  return absl::OkStatus();
}

}  // namespace albtpu
