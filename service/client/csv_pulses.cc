#include "service/client/csv_pulses.h"

#include <set>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "service/client/exit_status.h"
#include "service/client/number_text.h"

namespace albtpu::client {
namespace {

std::string Trimmed(std::string cell) {
  absl::StripAsciiWhitespace(&cell);
  return cell;
}

std::vector<std::string> ColumnNames(const CsvRecord& header) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < header.cell_count(); ++i) names.push_back(Trimmed(header.Cell(i)));
  return names;
}

absl::Status CheckUnique(const std::string& file, const std::vector<std::string>& names,
                         const std::vector<std::string>& appended) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty() && !seen.insert(names[i]).second) {
      return absl::InvalidArgumentError(
          absl::StrCat(file, " line 1, column ", i + 1, ": '", names[i], "' stands twice: rename one"));
    }
  }
  for (const std::string& name : appended) {
    if (seen.count(name) > 0) {
      return absl::InvalidArgumentError(
          absl::StrCat(file, " line 1: column '", name,
                       "' is there already and would be appended again: rename it, "
                       "or start from the file without results"));
    }
  }
  return absl::OkStatus();
}

absl::Status MissingColumn(const std::string& file, AxisId axis, const std::vector<std::string>& names) {
  const bool other_separator = names.size() == 1 && names[0].find_first_of(";\t") != std::string::npos;
  return absl::InvalidArgumentError(
      absl::StrCat(file, " line 1: no column '", std::string(Describe(axis).name), "': ",
                   other_separator ? std::string("separate the columns by commas")
                                   : absl::StrCat("add it, or give one value for all by ", FlagName(axis),
                                                  " (columns found: ", absl::StrJoin(names, ", "), ")")));
}

}  // namespace

void SetCoordinate(AxisId axis, float value, Pulse& pulse) {
  switch (axis) {
    case AxisId::kWindSpeed:
      pulse.wind_speed = value;
      return;
    case AxisId::kFetch:
      pulse.fetch = value;
      return;
    case AxisId::kIncidence:
      pulse.incidence = value;
      return;
    case AxisId::kAzimuth:
      pulse.azimuth = value;
      return;
    case AxisId::kFootprint:
      pulse.footprint = value;
      return;
    case AxisId::kDepth:
      pulse.depth = value;
      return;
  }
}

Pulse PulseAt(const FixedCoordinates& fixed) {
  Pulse pulse;
  for (const AxisId axis : kAxes) {
    if (fixed[Index(axis)].has_value()) SetCoordinate(axis, *fixed[Index(axis)], pulse);
  }
  return pulse;
}

std::string FlagName(AxisId axis) {
  std::string flag = "--";
  for (const char letter : Describe(axis).name) flag += letter == '_' ? '-' : letter;
  return flag;
}

absl::StatusOr<CsvPulses> CsvPulses::Bind(const std::string& name, const CsvRecord& header,
                                          const FixedCoordinates& fixed,
                                          const std::vector<std::string>& appended) {
  const std::vector<std::string> names = ColumnNames(header);
  if (absl::Status status = CheckUnique(name, names, appended); !status.ok()) return status;
  CsvPulses pulses;
  pulses.name_ = name;
  pulses.column_count_ = names.size();
  pulses.fixed_ = fixed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (const std::optional<AxisId> axis = FindAxis(names[i])) pulses.columns_[Index(*axis)] = i;
  }
  for (const AxisId axis : kAxes) {
    const bool in_file = pulses.columns_[Index(axis)].has_value();
    const bool given = fixed[Index(axis)].has_value();
    if (in_file && given) {
      return UsageError(absl::StrCat(FlagName(axis), ": ", name, " has the column '",
                                     std::string(Describe(axis).name), "': leave out one of them"));
    }
    if (!in_file && !given && !MayBeAbsent(axis)) return MissingColumn(name, axis, names);
  }
  return pulses;
}

absl::StatusOr<Pulse> CsvPulses::Read(const CsvRecord& record) const {
  if (record.cell_count() != column_count_) {
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ": ", record.cell_count(),
                                                   " cells under a header of ", column_count_,
                                                   ": one cell a column is right"));
  }
  Pulse pulse = PulseAt(fixed_);
  for (const AxisId axis : kAxes) {
    if (!columns_[Index(axis)].has_value()) continue;
    const std::string cell = Trimmed(record.Cell(*columns_[Index(axis)]));
    if (cell.empty() && MayBeAbsent(axis)) continue;
    const std::optional<float> value = ParseFloat(cell);
    if (!value.has_value()) {
      return absl::InvalidArgumentError(absl::StrCat(
          name_, " line ", record.line, ", column '", std::string(Describe(axis).name),
          "': ", cell.empty() ? std::string("is empty") : absl::StrCat("'", cell, "' is not a number"),
          ": write a number in ", std::string(Describe(axis).units), ", such as 12.5"));
    }
    SetCoordinate(axis, *value, pulse);
  }
  return pulse;
}

}  // namespace albtpu::client
