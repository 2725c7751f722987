#include "validation/published/published_angles.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "validation/published/published_table.h"

namespace albtpu {
namespace {

std::vector<double> Distinct(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

absl::StatusOr<std::vector<PublishedAngles::Cell>> ReadCells(const PublishedTable& table) {
  const absl::StatusOr<std::vector<double>> along = table.Numbers("along_wind_deg");
  if (!along.ok()) return along.status();
  const absl::StatusOr<std::vector<double>> cross = table.Numbers("cross_wind_deg");
  if (!cross.ok()) return cross.status();
  std::vector<PublishedAngles::Cell> cells;
  for (std::size_t i = 0; i < table.size(); ++i) cells.push_back({.along = (*along)[i], .cross = (*cross)[i]});
  return cells;
}

// The rows must be in the order of PublishedAngles::cells.
absl::StatusOr<PublishedAngles> Arrange(const std::filesystem::path& file, const PublishedTable& table) {
  const absl::StatusOr<std::vector<double>> winds = table.Numbers("wind_speed_m_s");
  if (!winds.ok()) return winds.status();
  const absl::StatusOr<std::vector<double>> incidences = table.Numbers("incidence_deg");
  if (!incidences.ok()) return incidences.status();
  absl::StatusOr<std::vector<PublishedAngles::Cell>> cells = ReadCells(table);
  if (!cells.ok()) return cells.status();

  PublishedAngles angles{Distinct(*winds), Distinct(*incidences), *std::move(cells)};
  const std::size_t columns = angles.incidences.size();
  bool complete = table.size() == angles.wind_speeds.size() * columns;
  for (std::size_t i = 0; complete && i < table.size(); ++i)
    complete = (*winds)[i] == angles.wind_speeds[i / columns] && (*incidences)[i] == angles.incidences[i % columns];
  if (complete) return angles;
  return absl::InvalidArgumentError(
      absl::StrCat(file.string(), ": expected every wind with every incidence, once, in increasing order"));
}

}  // namespace

absl::StatusOr<PublishedAngles> ReadTable3(const std::filesystem::path& published) {
  const std::filesystem::path file = published / "table3_simulated.csv";
  const absl::StatusOr<PublishedTable> table = PublishedTable::Read(file);
  if (!table.ok()) return table.status();
  absl::StatusOr<PublishedAngles> angles = Arrange(file, *table);
  if (!angles.ok()) return angles;
  const absl::StatusOr<std::vector<std::string>> along = table->Words("along_reading");
  if (!along.ok()) return along.status();
  const absl::StatusOr<std::vector<std::string>> cross = table->Words("cross_reading");
  if (!cross.ok()) return cross.status();
  for (std::size_t i = 0; i < angles->cells.size(); ++i) {
    angles->cells[i].along_is_clean = (*along)[i] == "clean";
    angles->cells[i].cross_is_clean = (*cross)[i] == "clean";
  }
  return angles;
}

absl::StatusOr<PublishedAngles> ReadTable4(const std::filesystem::path& published) {
  const std::filesystem::path file = published / "table4_empirical.csv";
  const absl::StatusOr<PublishedTable> table = PublishedTable::Read(file);
  if (!table.ok()) return table.status();
  return Arrange(file, *table);
}

}  // namespace albtpu
