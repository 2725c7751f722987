#include "grids/netcdf_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "tables/file/hdf5_exit.h"
#include "tables/version.h"

namespace albtpu {
namespace {

constexpr char kFillValue[] = "_FillValue";
constexpr int kCompression = 1;  // Of deflate: higher levels take longer and save little.

// Centres of cells from the first index on, or backwards from the last.
std::vector<double> Centres(std::int64_t first, std::size_t count, double cell, bool backwards) {
  std::vector<double> centres(count);
  for (std::size_t i = 0; i < count; ++i)
    centres[i] = (static_cast<double>(first + static_cast<std::int64_t>(i)) + 0.5) * cell;
  if (backwards) std::ranges::reverse(centres);
  return centres;
}

// The number of PARAMETER["name",number] in well-known text; nullopt if there is none.
std::optional<double> ParameterOf(const std::string& wkt, const std::string& name) {
  const std::string begin = absl::StrCat("PARAMETER[\"", name, "\",");
  const std::size_t at = wkt.find(begin);
  double number = 0;
  if (at == std::string::npos) return std::nullopt;
  const std::size_t from = at + begin.size(), end = wkt.find(']', from);
  if (end == std::string::npos || !absl::SimpleAtod(wkt.substr(from, end - from), &number)) return std::nullopt;
  return number;
}

// Names of UDUNITS. The US survey foot is longer than the foot by 6e-7 m.
std::string UnitName(double metres) {
  const auto is = [metres](double of_unit) { return std::abs(metres / of_unit - 1) < 1e-8; };
  return is(1) ? "m" : is(0.3048) ? "foot" : is(1200.0 / 3937) ? "US_survey_foot" : absl::StrFormat("%.15g m", metres);
}

}  // namespace

NetcdfGrid::NetcdfGrid(const std::filesystem::path& path, GridFrame frame, std::size_t tile, std::string_view title)
    : path_(path), frame_(std::move(frame)), tile_(tile) {
  hdf5::CloseNothingAtExit();
  open_ = Check(nc_create(path.c_str(), NC_NETCDF4 | NC_NOCLOBBER, &file_));
  Text(NC_GLOBAL, "Conventions", "CF-1.8");
  Text(NC_GLOBAL, "title", title);
  Text(NC_GLOBAL, "source", absl::StrCat("albtpu-query ", std::string(Version())));
  if (ok()) Check(nc_def_dim(file_, "y", frame_.rows, &y_));
  if (ok()) Check(nc_def_dim(file_, "x", frame_.columns, &x_));
  ys_ = Axis("y", y_);
  xs_ = Axis("x", x_);
  DescribeCrs(Variable("crs", NC_INT, {}));
}

NetcdfGrid::~NetcdfGrid() {
  if (open_ && ok()) nc_abort(file_);  // It crashes after a failure.
}

int NetcdfGrid::Variable(const char* name, nc_type type, const std::vector<int>& dimensions) {
  int id = -1;
  if (ok()) Check(nc_def_var(file_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
  return id;
}

int NetcdfGrid::Axis(const char* name, int dimension) {
  const int variable = Variable(name, NC_DOUBLE, {dimension});
  Text(variable, "standard_name", absl::StrCat("projection_", name, "_coordinate"));
  Text(variable, "units", UnitName(frame_.metres_per_unit));
  return variable;
}

// Compressed, in chunks of whole tiles.
int NetcdfGrid::OfCells(const char* name, const char* long_name, nc_type type) {
  const int variable = Variable(name, type, {y_, x_});
  const std::array<std::size_t, 2> chunk = {std::min(frame_.rows, tile_), std::min(frame_.columns, 4 * tile_)};
  if (ok()) Check(nc_def_var_chunking(file_, variable, NC_CHUNKED, chunk.data()));
  if (ok()) Check(nc_def_var_deflate(file_, variable, 1, 1, kCompression));
  // Chunks are written whole, so that the library, which keeps 16 MB of each variable, need keep none.
  if (ok()) Check(nc_set_var_chunk_cache(file_, variable, chunk[0] * chunk[1] * sizeof(float), 1, 1));
  Text(variable, "long_name", long_name);
  Text(variable, "grid_mapping", "crs");
  return variable;
}

int NetcdfGrid::Floats(const char* name, const char* long_name, const char* unit) {
  const int variable = OfCells(name, long_name, NC_FLOAT);
  Text(variable, "units", unit);
  if (ok()) Check(nc_put_att_float(file_, variable, kFillValue, NC_FLOAT, 1, &kNoValue));
  return variable;
}

int NetcdfGrid::Counts(const char* name, const char* long_name) {
  const int variable = OfCells(name, long_name, NC_INT);
  Text(variable, "units", "1");
  return variable;
}

int NetcdfGrid::Codes(const char* name, const char* long_name, std::uint8_t count, const char* meanings) {
  const int variable = OfCells(name, long_name, NC_UBYTE);
  std::vector<std::uint8_t> values(count);
  for (std::uint8_t i = 0; i < count; ++i) values[i] = static_cast<std::uint8_t>(i + 1);
  if (ok()) Check(nc_put_att_ubyte(file_, variable, kFillValue, NC_UBYTE, 1, &kNoCode));
  if (ok()) Check(nc_put_att_ubyte(file_, variable, "flag_values", NC_UBYTE, values.size(), values.data()));
  Text(variable, "flag_meanings", meanings);
  return variable;
}

void NetcdfGrid::Text(int variable, const char* name, std::string_view text) {
  if (ok()) Check(nc_put_att_text(file_, variable, name, text.size(), text.data()));
}

void NetcdfGrid::Number(int variable, const char* name, double value) {
  if (ok()) Check(nc_put_att_double(file_, variable, name, NC_DOUBLE, 1, &value));
}

// CF names the parameters of projections, too, for readers without well-known text; here those of the common one.
void NetcdfGrid::DescribeTransverseMercator(int crs) {
  if (frame_.crs_wkt.find("PROJECTION[\"Transverse_Mercator\"]") == std::string::npos) return;
  Text(crs, "grid_mapping_name", "transverse_mercator");
  for (const auto& [of_cf, of_wkt] : {std::pair{"latitude_of_projection_origin", "latitude_of_origin"},
                                      {"longitude_of_central_meridian", "central_meridian"},
                                      {"scale_factor_at_central_meridian", "scale_factor"},
                                      {"false_easting", "false_easting"},
                                      {"false_northing", "false_northing"}})
    if (const std::optional<double> number = ParameterOf(frame_.crs_wkt, of_wkt)) Number(crs, of_cf, *number);
}

void NetcdfGrid::DescribeCrs(int crs) {
  Text(crs, "long_name", frame_.crs_name);
  if (!frame_.crs_wkt.empty()) {
    Text(crs, "crs_wkt", frame_.crs_wkt);
    Text(crs, "spatial_ref", frame_.crs_wkt);
  }
  if (!frame_.vertical_wkt.empty()) {
    Text(crs, "vertical_crs", frame_.vertical_name);
    Text(crs, "vertical_crs_wkt", frame_.vertical_wkt);
  }
  DescribeTransverseMercator(crs);
  const double west = static_cast<double>(frame_.first_column) * frame_.cell;
  const double north = static_cast<double>(frame_.first_row + static_cast<std::int64_t>(frame_.rows)) * frame_.cell;
  Text(crs, "GeoTransform", absl::StrFormat("%.10g %.10g 0 %.10g 0 %.10g", west, frame_.cell, north, -frame_.cell));
}

void NetcdfGrid::EndDefinitions() {
  if (ok()) Check(nc_enddef(file_));
  const std::vector<double> y = Centres(frame_.first_row, frame_.rows, frame_.cell, true);
  const std::vector<double> x = Centres(frame_.first_column, frame_.columns, frame_.cell, false);
  if (ok()) Check(nc_put_var_double(file_, ys_, y.data()));
  if (ok()) Check(nc_put_var_double(file_, xs_, x.data()));
}

absl::Status NetcdfGrid::Close() {
  if (ok()) {
    open_ = false;
    Check(nc_close(file_));
  }
  return status_;
}

bool NetcdfGrid::Check(int result) {
  if (result != NC_NOERR)
    status_ = absl::DataLossError(absl::StrCat(path_.string(), ": cannot be written: ", nc_strerror(result)));
  return result == NC_NOERR;
}

}  // namespace albtpu
