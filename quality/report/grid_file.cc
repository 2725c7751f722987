#include "quality/report/grid_file.h"

#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "annotate/answers/batch.h"
#include "tables/version.h"

namespace albtpu::quality {
namespace {

constexpr char kFillValue[] = "_FillValue";
constexpr float kFill = NC_FILL_FLOAT;
constexpr std::uint8_t kNoCode = 0;  // The fill value of codes.
constexpr int kCompression = 1;      // Of deflate: higher levels take longer and save little.

// A file that is being written. After the first failure, calls do nothing.
class Writing {
 public:
  explicit Writing(const std::filesystem::path& path) : path_(path) {
    if (Check(nc_create(path.c_str(), NC_NETCDF4 | NC_NOCLOBBER, &file_))) open_ = true;
  }
  ~Writing() {
    if (open_) nc_abort(file_);
  }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;

  int Dimension(const char* name, std::size_t size) {
    int id = -1;
    if (ok()) Check(nc_def_dim(file_, name, size, &id));
    return id;
  }
  int Variable(const char* name, nc_type type, const std::vector<int>& dimensions) {
    int id = -1;
    if (ok()) Check(nc_def_var(file_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &id));
    return id;
  }
  // Compressed, in chunks of whole tiles.
  void Compress(int variable, std::size_t rows, std::size_t columns) {
    const std::array<std::size_t, 2> chunk = {std::min<std::size_t>(rows, SurveyGrid::kTile),
                                              std::min<std::size_t>(columns, std::size_t{4} * SurveyGrid::kTile)};
    if (ok()) Check(nc_def_var_chunking(file_, variable, NC_CHUNKED, chunk.data()));
    if (ok()) Check(nc_def_var_deflate(file_, variable, 1, 1, kCompression));
    // Chunks are written whole, so that the library, which keeps 16 MB of each variable, need keep none.
    if (ok()) Check(nc_set_var_chunk_cache(file_, variable, chunk[0] * chunk[1] * sizeof(float), 1, 1));
  }
  void Text(int variable, const char* name, std::string_view text) {
    if (ok()) Check(nc_put_att_text(file_, variable, name, text.size(), text.data()));
  }
  void Number(int variable, const char* name, double value) {
    if (ok()) Check(nc_put_att_double(file_, variable, name, NC_DOUBLE, 1, &value));
  }
  void Fill(int variable, float value) {
    if (ok()) Check(nc_put_att_float(file_, variable, kFillValue, NC_FLOAT, 1, &value));
  }
  void Codes(int variable, const char* name, const std::vector<std::uint8_t>& values) {
    if (ok()) Check(nc_put_att_ubyte(file_, variable, name, NC_UBYTE, values.size(), values.data()));
  }
  void EndDefinitions() {
    if (ok()) Check(nc_enddef(file_));
  }
  void Put(int variable, const std::vector<double>& values) {
    if (ok()) Check(nc_put_var_double(file_, variable, values.data()));
  }
  // Rows from `row` on. `Value` is the type of the variable.
  template <typename Value>
  void Put(int variable, std::size_t row, std::size_t columns, const std::vector<Value>& values) {
    const std::array<std::size_t, 2> start = {row, 0}, count = {values.size() / columns, columns};
    if (ok()) Check(nc_put_vara(file_, variable, start.data(), count.data(), values.data()));
  }

  bool ok() const { return status_.ok(); }
  absl::Status Close() {
    if (ok()) {
      open_ = false;
      Check(nc_close(file_));
    }
    return status_;
  }

 private:
  bool Check(int result) {
    if (result != NC_NOERR)
      status_ = absl::DataLossError(absl::StrCat(path_.string(), ": cannot be written: ", nc_strerror(result)));
    return result == NC_NOERR;
  }

  std::filesystem::path path_;
  int file_ = 0;
  bool open_ = false;
  absl::Status status_;
};

// One variable of the grid: its values of a cell.
struct Layer {
  const char *name, *long_name;
  const char* unit;
  float (*value)(const GridCell& cell);
};

template <std::size_t share>
float ShareOf(const GridCell& cell) {
  float total = 0;
  for (const float each : cell.shares) total += each;
  return total > 0 ? cell.shares[share] / total : 0;
}

constexpr std::array kLayers = {
    Layer{"depth", "mean depth of the bottom below the water surface", "m", [](const GridCell& c) { return c.depth; }},
    Layer{"thu", "mean total horizontal uncertainty", "m", [](const GridCell& c) { return c.thu; }},
    Layer{"tvu", "mean total vertical uncertainty", "m", [](const GridCell& c) { return c.tvu; }},
    Layer{"share_air", "share of the air side in the vertical variance", "1", ShareOf<0>},
    Layer{"share_sea", "share of the sea surface in the vertical variance", "1", ShareOf<1>},
    Layer{"share_water", "share of the water column in the vertical variance", "1", ShareOf<2>},
    Layer{"share_datum", "share of the vertical datum in the vertical variance", "1", ShareOf<3>},
    Layer{"share_extra", "share of what the surveyor added in the vertical variance", "1", ShareOf<4>}};

std::uint8_t DominantShare(const GridCell& cell) {
  return static_cast<std::uint8_t>(std::ranges::max_element(cell.shares) - cell.shares.begin() + 1);
}

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

// CF names the parameters of projections, too, for readers without well-known text; here those of the common one.
void DescribeTransverseMercator(const GridFileFacts& facts, int crs, Writing& file) {
  if (facts.crs_wkt.find("PROJECTION[\"Transverse_Mercator\"]") == std::string::npos) return;
  file.Text(crs, "grid_mapping_name", "transverse_mercator");
  for (const auto& [of_cf, of_wkt] : {std::pair{"latitude_of_projection_origin", "latitude_of_origin"},
                                      {"longitude_of_central_meridian", "central_meridian"},
                                      {"scale_factor_at_central_meridian", "scale_factor"},
                                      {"false_easting", "false_easting"},
                                      {"false_northing", "false_northing"}})
    if (const std::optional<double> number = ParameterOf(facts.crs_wkt, of_wkt)) file.Number(crs, of_cf, *number);
}

void DescribeCrs(const SurveyGrid& grid, const GridFileFacts& facts, int crs, Writing& file) {
  file.Text(crs, "long_name", facts.crs_name);
  if (!facts.crs_wkt.empty()) {
    file.Text(crs, "crs_wkt", facts.crs_wkt);
    file.Text(crs, "spatial_ref", facts.crs_wkt);
  }
  DescribeTransverseMercator(facts, crs, file);
  const double west = static_cast<double>(grid.first_column()) * grid.cell();
  const double north = static_cast<double>(grid.first_row() + static_cast<std::int64_t>(grid.rows())) * grid.cell();
  file.Text(crs, "GeoTransform",
            absl::StrFormat("%.10g %.10g 0 %.10g 0 %.10g", west, grid.cell(), north, -grid.cell()));
}

}  // namespace

absl::Status WriteGrid(const SurveyGrid& grid, const GridFileFacts& facts, const std::filesystem::path& path) {
  const std::size_t rows = grid.rows(), columns = grid.columns();
  Writing file(path);
  file.Text(NC_GLOBAL, "Conventions", "CF-1.8");
  file.Text(NC_GLOBAL, "title", "Depth and total propagated uncertainty of a survey by airborne lidar bathymetry");
  file.Text(NC_GLOBAL, "source", absl::StrCat("albtpu-query ", std::string(Version())));
  file.Text(NC_GLOBAL, "coverage", annotate::CoverageName(facts.coverage));
  const int y = file.Dimension("y", rows), x = file.Dimension("x", columns);
  const double metres = facts.metres_per_unit;
  // Names of UDUNITS. The US survey foot is longer than the foot by 6e-7 m.
  const auto is = [metres](double of_unit) { return std::abs(metres / of_unit - 1) < 1e-8; };
  const std::string unit = is(1)               ? "m"
                           : is(0.3048)        ? "foot"
                           : is(1200.0 / 3937) ? "US_survey_foot"
                                               : absl::StrFormat("%.15g m", metres);
  const auto axis = [&](const char* name, int dimension) {
    const int variable = file.Variable(name, NC_DOUBLE, {dimension});
    file.Text(variable, "standard_name", absl::StrCat("projection_", name, "_coordinate"));
    file.Text(variable, "units", unit);
    return variable;
  };
  const int ys = axis("y", y), xs = axis("x", x), crs = file.Variable("crs", NC_INT, {});
  DescribeCrs(grid, facts, crs, file);
  const auto of_cells = [&](const char* name, const char* long_name, nc_type type) {
    const int variable = file.Variable(name, type, {y, x});
    file.Compress(variable, rows, columns);
    file.Text(variable, "long_name", long_name);
    file.Text(variable, "grid_mapping", "crs");
    return variable;
  };
  std::array<int, kLayers.size()> layers = {};
  for (std::size_t k = 0; k < kLayers.size(); ++k) {
    layers[k] = of_cells(kLayers[k].name, kLayers[k].long_name, NC_FLOAT);
    file.Text(layers[k], "units", kLayers[k].unit);
    file.Fill(layers[k], kFill);
  }
  for (const std::size_t k : {1, 2}) file.Text(layers[k], "coverage", annotate::CoverageText(facts.coverage));
  const int points = of_cells("points", "points of the bottom", NC_INT);
  const int without = of_cells("points_without_number", "points of the bottom without an uncertainty", NC_INT);
  for (const int variable : {points, without}) file.Text(variable, "units", "1");
  const auto codes = [&](const char* name, const char* long_name, std::uint8_t count, const char* meanings) {
    const int variable = of_cells(name, long_name, NC_UBYTE);
    std::vector<std::uint8_t> values(count);
    for (std::uint8_t i = 0; i < count; ++i) values[i] = static_cast<std::uint8_t>(i + 1);
    file.Codes(variable, kFillValue, {kNoCode});
    file.Codes(variable, "flag_values", values);
    file.Text(variable, "flag_meanings", meanings);
    return variable;
  };
  const int order = codes("order_met", "order of IHO S-44 that every point with a number meets", 6,
                          "exclusive special order_1a order_1b order_2 none");
  const int dominant = codes("dominant_share", "largest share of the vertical variance",
                             static_cast<std::uint8_t>(kVerticalShareNames.size()), "air sea water datum extra");
  const int gap =
      codes("gap", "why points have no uncertainty, the most severe reason", 5,
            "above_the_water outside_the_table_or_no_sea_or_water no_water_surface no_trajectory no_channel");
  file.EndDefinitions();
  file.Put(ys, Centres(grid.first_row(), rows, grid.cell(), true));
  file.Put(xs, Centres(grid.first_column(), columns, grid.cell(), false));

  std::vector<GridCell> cells;
  const std::size_t strips = rows / SurveyGrid::kTile;
  for (std::size_t strip = strips; strip-- > 0 && file.ok();) {
    grid.Strip(strip, cells);
    for (std::size_t south = 0, north = SurveyGrid::kTile - 1; south < north; ++south, --north)
      std::swap_ranges(cells.begin() + static_cast<std::ptrdiff_t>(south * columns),
                       cells.begin() + static_cast<std::ptrdiff_t>((south + 1) * columns),
                       cells.begin() + static_cast<std::ptrdiff_t>(north * columns));
    const std::size_t row = (strips - 1 - strip) * SurveyGrid::kTile;
    const auto put = [&](int variable, auto none, auto value) {
      std::vector<decltype(none)> values(cells.size(), none);
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i].with_number > 0) values[i] = value(cells[i]);
      file.Put(variable, row, columns, values);
    };
    for (std::size_t k = 0; k < kLayers.size(); ++k) put(layers[k], kFill, kLayers[k].value);
    put(order, kNoCode, [](const GridCell& cell) { return static_cast<std::uint8_t>(cell.worst_order); });
    put(dominant, kNoCode, DominantShare);
    std::vector<std::uint8_t> gaps(cells.size());
    std::ranges::transform(cells, gaps.begin(), [](const GridCell& cell) { return cell.gap; });
    file.Put(gap, row, columns, gaps);
    std::vector<int> all(cells.size()), no_number(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      all[i] = static_cast<int>(cells[i].points);
      no_number[i] = static_cast<int>(cells[i].points - cells[i].with_number);
    }
    file.Put(points, row, columns, all);
    file.Put(without, row, columns, no_number);
  }
  return file.Close();
}

}  // namespace albtpu::quality
