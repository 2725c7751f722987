#include "validation/published/published_table.h"

#include <cassert>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "generator/math/statistics.h"
#include "status/status_macros.h"

namespace albtpu {
absl::StatusOr<PublishedTable> PublishedTable::Read(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return absl::NotFoundError(absl::StrCat(file.string(), ": cannot be read"));
  PublishedTable table;
  table.file_ = file;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    const absl::string_view content = absl::StripAsciiWhitespace(text);
    if (content.empty() || content.front() == '#') continue;
    std::vector<std::string> cells = absl::StrSplit(content, ',');
    if (table.columns_.empty()) {
      table.columns_ = std::move(cells);
    } else if (cells.size() == table.columns_.size()) {
      table.rows_.push_back({line, std::move(cells)});
    } else {
      return absl::InvalidArgumentError(absl::StrCat(file.string(), ": line ", line, " has ", cells.size(),
                                                     " cells: there are ", table.columns_.size(), " columns"));
    }
  }
  if (table.rows_.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(file.string(), ": has no rows: expected a line of column names and at least one row"));
  }
  return table;
}

absl::StatusOr<std::size_t> PublishedTable::Find(std::string_view column) const {
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i] == column) return i;
  return absl::InvalidArgumentError(absl::StrCat(file_.string(), ": no column '", std::string(column), "': there are ",
                                                 absl::StrJoin(columns_, ", ")));
}

absl::StatusOr<std::vector<std::string>> PublishedTable::Words(std::string_view column) const {
  ASSIGN_OR_RETURN(const std::size_t index, Find(column));
  std::vector<std::string> words;
  for (const Row& row : rows_) words.push_back(row.cells[index]);
  return words;
}

absl::StatusOr<std::vector<double>> PublishedTable::Numbers(std::string_view column) const {
  ASSIGN_OR_RETURN(const std::size_t index, Find(column));
  std::vector<double> numbers;
  for (const Row& row : rows_) {
    const std::string& cell = row.cells[index];
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc() || end != cell.data() + cell.size()) {
      return absl::InvalidArgumentError(absl::StrCat(file_.string(), ": line ", row.line, ", column '",
                                                     std::string(column), "': '", cell, "' is not a number"));
    }
    numbers.push_back(number);
  }
  return numbers;
}

absl::StatusOr<std::vector<std::vector<double>>> PublishedTable::Numbers(
    std::initializer_list<std::string_view> columns) const {
  std::vector<std::vector<double>> all;
  for (const std::string_view column : columns) {
    ASSIGN_OR_RETURN(std::vector<double> numbers, Numbers(column));
    all.push_back(std::move(numbers));
  }
  return all;
}

absl::StatusOr<Table2> ReadTable2(const std::filesystem::path& published) {
  ASSIGN_OR_RETURN(const PublishedTable table, PublishedTable::Read(published / "table2_wave_staff.csv"));
  ASSIGN_OR_RETURN(const auto columns, table.Numbers({"distance_downwind_m", "peak_frequency_hz", "peak_wavelength_m",
                                                      "significant_wave_height_m"}));
  return Table2{columns[0], columns[1], columns[2], columns[3]};
}

namespace {

double Horizontal(double refracted, double delta) { return std::tan(refracted + delta); }  // Eq. 24
double Vertical(double refracted, double delta) {                                          // Eq. 25, 26
  return std::cos(refracted) / std::cos(refracted + delta);
}

}  // namespace

AngleMethodUncertainty AngleMethod(double refracted, double two_sigma_angle) {
  constexpr double kCut = 8;    // standard deviations
  constexpr int kPerSigma = 4;  // nodes
  constexpr int kNodes = 2 * static_cast<int>(kCut) * kPerSigma + 1;
  assert(two_sigma_angle >= 0 && refracted + kCut / 2 * two_sigma_angle < std::numbers::pi / 2);

  // Differences from the values at delta = 0, to lose little to rounding where the variance is small.
  const double horizontal_still = Horizontal(refracted, 0), vertical_still = Vertical(refracted, 0);
  double weights = 0, x = 0, x_squared = 0, z = 0, z_squared = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double t = static_cast<double>(i) / kPerSigma - kCut;
    const double weight = std::exp(-0.5 * t * t);
    const double horizontal = Horizontal(refracted, 0.5 * two_sigma_angle * t) - horizontal_still;
    const double vertical = Vertical(refracted, 0.5 * two_sigma_angle * t) - vertical_still;
    weights += weight;
    x += weight * horizontal;
    x_squared += weight * horizontal * horizontal;
    z += weight * vertical;
    z_squared += weight * vertical * vertical;
  }
  const auto two_sigma = [&](double sum, double squares) {
    return 2 * std::sqrt(squares / weights - (sum / weights) * (sum / weights));
  };
  return {two_sigma(x, x_squared), two_sigma(z, z_squared)};
}

AngleMethodUncertainty AngleMethodByDraws(double refracted, double two_sigma_angle, int draws, NormalStream stream) {
  std::vector<double> normals(draws);
  stream.Fill(normals);
  const Eigen::ArrayXd delta = 0.5 * two_sigma_angle * Eigen::Map<const Eigen::ArrayXd>(normals.data(), draws);
  return {TwoSigma((refracted + delta).tan()).value, TwoSigma(std::cos(refracted) / (refracted + delta).cos()).value};
}

}  // namespace albtpu
