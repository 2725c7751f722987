#include "survey/csv/csv_pulses.h"

#include <limits>
#include <set>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"

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
      return absl::InvalidArgumentError(absl::StrCat(file, " line 1, column ", i + 1, ": '", names[i],
                                                     "' occurs twice; rename one of the columns"));
    }
  }
  for (const std::string& name : appended) {
    if (seen.count(name) > 0) {
      return absl::InvalidArgumentError(
          absl::StrCat(file, " line 1: column '", name,
                       "' exists already and would be appended again; rename it, "
                       "or start from the file without results"));
    }
  }
  return absl::OkStatus();
}

absl::Status MissingColumn(const std::string& file, AxisId axis, const std::vector<std::string>& names) {
  const bool other_separator = names.size() == 1 && names[0].find_first_of(";\t") != std::string::npos;
  return absl::InvalidArgumentError(absl::StrCat(
      file, " line 1: no column '", std::string(Describe(axis).name),
      "' (columns found: ", absl::StrJoin(names, ", "), "); ",
      other_separator ? std::string("separate the columns by commas")
                      : absl::StrCat("add it, or give one value for all pulses by ", FlagName(axis))));
}

}  // namespace

PulseBatch OnePulse(const FixedCoordinates& fixed) {
  PulseBatch pulse{.size = 1, .axis = {}};
  for (const AxisId axis : kAxes) {
    if (fixed[Index(axis)].has_value()) pulse[axis].assign(1, *fixed[Index(axis)]);
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
      return UsageError(absl::StrCat(FlagName(axis), ": ", name, " also has the column '",
                                     std::string(Describe(axis).name), "'; leave out one of them"));
    }
    if (!in_file && !given && !MayBeAbsent(axis)) return MissingColumn(name, axis, names);
  }
  return pulses;
}

void CsvPulses::Clear(CsvPulseBatches& batches) const {
  for (PulseBatch* batch : {&batches.with_azimuth, &batches.without_azimuth}) {
    batch->size = 0;
    for (const AxisId axis : kAxes) {
      (*batch)[axis].clear();
      if (fixed_[Index(axis)].has_value()) (*batch)[axis].push_back(*fixed_[Index(axis)]);
    }
  }
}

absl::StatusOr<std::optional<float>> CsvPulses::Number(const CsvRecord& record, AxisId axis) const {
  const std::size_t column = *columns_[Index(axis)];
  const std::string_view raw = record.RawCell(column);
  const bool quoted = !raw.empty() && raw.front() == '"';
  const std::string unquoted = quoted ? record.Cell(column) : "";
  const absl::string_view cell = absl::StripAsciiWhitespace(
      quoted ? absl::string_view(unquoted) : absl::string_view(raw.data(), raw.size()));
  if (cell.empty() && MayBeAbsent(axis)) return std::nullopt;
  const std::optional<float> value = ParseFloat(std::string_view(cell.data(), cell.size()));
  if (value.has_value()) return value;
  return absl::InvalidArgumentError(absl::StrCat(
      name_, " line ", record.line, ", column '", std::string(Describe(axis).name),
      "': ", cell.empty() ? std::string("is empty") : absl::StrCat("'", cell, "' is not a number"),
      "; write a number in ", std::string(Describe(axis).units), ", such as 12.5"));
}

absl::StatusOr<bool> CsvPulses::Append(const CsvRecord& record, CsvPulseBatches& batches) const {
  if (record.cell_count() != column_count_) {
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ": ", record.cell_count(),
                                                   " cells, but the header has ", column_count_,
                                                   "; write one cell for each column"));
  }
  bool has_azimuth = fixed_[Index(AxisId::kAzimuth)].has_value();
  std::array<float, kAxisCount> numbers;
  for (const AxisId axis : kAxes) {
    if (!columns_[Index(axis)].has_value()) continue;
    const absl::StatusOr<std::optional<float>> number = Number(record, axis);
    if (!number.ok()) return number.status();
    if (axis == AxisId::kAzimuth) has_azimuth = number->has_value();
    numbers[Index(axis)] = number->value_or(std::numeric_limits<float>::infinity());  // An absent fetch.
  }
  PulseBatch& batch = has_azimuth ? batches.with_azimuth : batches.without_azimuth;
  ++batch.size;
  for (const AxisId axis : kAxes) {
    if (!columns_[Index(axis)].has_value() || (axis == AxisId::kAzimuth && !has_azimuth)) continue;
    batch[axis].push_back(numbers[Index(axis)]);
  }
  return has_azimuth;
}

}  // namespace albtpu::client
