#include "validation/published/published_angles.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "status/status_macros.h"
#include "validation/published/published_table.h"

namespace albtpu {
namespace {

std::vector<double> Distinct(std::vector<double> numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

// The rows must be in the order of PublishedAngles::cells.
absl::StatusOr<PublishedAngles> Arrange(const std::filesystem::path& file, const PublishedTable& table) {
  ASSIGN_OR_RETURN(const auto numbers,
                   table.Numbers({"wind_speed_m_s", "incidence_deg", "along_wind_deg", "cross_wind_deg"}));
  const std::vector<double>&winds = numbers[0], &incidences = numbers[1];

  PublishedAngles angles{Distinct(winds), Distinct(incidences), {}};
  const std::size_t columns = angles.incidences.size();
  bool complete = table.size() == angles.wind_speeds.size() * columns;
  for (std::size_t i = 0; complete && i < table.size(); ++i) {
    complete = winds[i] == angles.wind_speeds[i / columns] && incidences[i] == angles.incidences[i % columns];
    angles.cells.push_back({.along = numbers[2][i], .cross = numbers[3][i]});
  }
  if (complete) return angles;
  return absl::InvalidArgumentError(
      absl::StrCat(file.string(), ": expected every wind with every incidence, once, in increasing order"));
}

}  // namespace

absl::StatusOr<PublishedAngles> ReadTable3(const std::filesystem::path& published) {
  const std::filesystem::path file = published / "table3_simulated.csv";
  ASSIGN_OR_RETURN(const PublishedTable table, PublishedTable::Read(file));
  ASSIGN_OR_RETURN(PublishedAngles angles, Arrange(file, table));
  ASSIGN_OR_RETURN(const std::vector<std::string> along, table.Words("along_reading"));
  ASSIGN_OR_RETURN(const std::vector<std::string> cross, table.Words("cross_reading"));
  for (std::size_t i = 0; i < angles.cells.size(); ++i) {
    angles.cells[i].along_is_clean = along[i] == "clean";
    angles.cells[i].cross_is_clean = cross[i] == "clean";
  }
  return angles;
}

absl::StatusOr<PublishedAngles> ReadTable4(const std::filesystem::path& published) {
  const std::filesystem::path file = published / "table4_empirical.csv";
  ASSIGN_OR_RETURN(const PublishedTable table, PublishedTable::Read(file));
  return Arrange(file, table);
}

}  // namespace albtpu
