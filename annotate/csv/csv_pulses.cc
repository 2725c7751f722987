#include "annotate/csv/csv_pulses.h"

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/plan_total.h"
#include "formats/text/text.h"
#include "status/status_macros.h"

namespace albtpu::annotate {
namespace {

std::string Trimmed(std::string cell) {
  absl::StripAsciiWhitespace(&cell);
  return cell;
}

std::vector<std::string> ColumnNames(const formats::CsvRecord& header) {
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
          absl::StrCat(file, " line 1, column ", i + 1, ": '", names[i], "' occurs twice; rename one of the columns"));
    }
  }
  for (const std::string& name : appended) {
    if (seen.count(name) > 0) {
      return absl::InvalidArgumentError(absl::StrCat(file, " line 1: column '", name,
                                                     "' exists already and would be appended again; rename it, "
                                                     "or start from the file without results"));
    }
  }
  return absl::OkStatus();
}

std::string MissingAdvice(AxisId axis, const InputOrigins& origins) {
  for (const OtherWay& way : kOtherWays) {
    if (way.axis != axis) continue;
    const std::string first(Name(way.first)), second(Name(way.second));
    if (origins[Index(way.first)] != InputOrigin::kNone) return absl::StrCat(", or add ", second, " to ", first);
    if (origins[Index(way.second)] != InputOrigin::kNone) return absl::StrCat(", or add ", first, " to ", second);
    return absl::StrCat(", or give ", first, " and ", second);
  }
  return "";
}

absl::Status MissingColumns(const std::string& file, const std::vector<AxisId>& axes,
                            const std::vector<std::string>& names, const InputOrigins& origins) {
  const auto list = [&](const char* separator, const auto& text_of) {
    return absl::StrJoin(axes, separator, [&](std::string* text, AxisId axis) { text->append(text_of(axis)); });
  };
  const bool one = axes.size() == 1;
  return absl::InvalidArgumentError(absl::StrCat(
      file, " line 1: no column", one ? " " : "s ",
      list(", ", [](AxisId axis) { return absl::StrCat("'", std::string(Describe(axis).name), "'"); }),
      " (columns found: ", absl::StrJoin(names, ", "), "); ",
      absl::StrCat("add ", one ? "it" : "them", ", or give one value for all pulses by ",
                   list(" and ", [&](AxisId axis) { return FlagName(axis) + MissingAdvice(axis, origins); }))));
}

// Where the inputs of pulses come from. A column comes before a flag; with both, Bind() fails.
InputOrigins OriginsOf(const std::vector<std::string>& names, const FixedInputs& fixed) {
  InputOrigins origins = {};
  for (std::size_t i = 0; i < kPulseInputCount; ++i)
    if (fixed[static_cast<PulseInput>(i)].has_value()) origins[i] = InputOrigin::kFlag;
  for (const std::string& name : names)
    if (const std::optional<PulseInput> input = FindInput(name)) origins[Index(*input)] = InputOrigin::kColumn;
  if (fixed.any_sea && origins[Index(PulseInput::kBeamAzimuth)] != InputOrigin::kNone)
    origins[Index(PulseInput::kWindFrom)] = InputOrigin::kFlag;  // It is north.
  return origins;
}

std::vector<AxisId> MissingIn(const InputOrigins& origins, bool any_sea) {
  std::vector<AxisId> missing;
  for (const AxisId axis : kAxes) {
    const bool given = origins[Index(axis)] != InputOrigin::kNone || IsGivenByOtherWay(axis, origins);
    if (!given && !MayBeAbsent(axis) && !(any_sea && IsOfSea(InputOf(axis)))) missing.push_back(axis);
  }
  return missing;
}

absl::Status FlagAndColumn(const std::string& name, PulseInput input) {
  return formats::UsageError(absl::StrCat(FlagName(input), ": ", name, " also has the column '",
                                          std::string(Name(input)), "'; leave out one of them"));
}

bool MayBeEmpty(PulseInput input) {
  if (input == PulseInput::kBeamAzimuth || input == PulseInput::kWindFrom) return true;
  return Index(input) < kAxisCount && MayBeAbsent(kAxes[Index(input)]);
}

}  // namespace

PulseBatch OnePulse(const FixedCoordinates& fixed) {
  PulseBatch pulse{.size = 1, .axis = {}};
  for (const AxisId axis : kAxes)
    if (fixed[Index(axis)].has_value()) pulse[axis].assign(1, *fixed[Index(axis)]);
  return pulse;
}

std::vector<AxisId> MissingAxes(const formats::CsvRecord& header, const FixedInputs& fixed) {
  return MissingIn(OriginsOf(ColumnNames(header), fixed), fixed.any_sea);
}

absl::StatusOr<CsvPulses> CsvPulses::Bind(const std::string& name, const formats::CsvRecord& header,
                                          const FixedInputs& fixed, const std::vector<std::string>& appended) {
  if (header.blank()) {
    return absl::InvalidArgumentError(
        absl::StrCat(name, " line 1: is empty; begin the file with a header that names the columns"));
  }
  const std::vector<std::string> names = ColumnNames(header);
  RETURN_IF_ERROR(CheckUnique(name, names, appended));
  CsvPulses pulses;
  pulses.name_ = name;
  pulses.column_count_ = names.size();
  std::array<std::size_t, kPulseInputCount> column_of = {};
  InputOrigins origins = OriginsOf(names, fixed);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<PulseInput> input = FindInput(names[i]);
    if (!input.has_value()) continue;
    if (fixed.any_sea && IsOfSea(*input)) {
      return absl::InvalidArgumentError(absl::StrCat(name, " line 1: column '", names[i],
                                                     "' contradicts the given sea (which has a wind of its own); leave "
                                                     "out the column, or the sea"));
    }
    column_of[Index(*input)] = i;
  }
  for (std::size_t i = 0; i < kPulseInputCount; ++i) {
    const auto input = static_cast<PulseInput>(i);
    if (!fixed[input].has_value()) continue;
    if (origins[i] == InputOrigin::kColumn) {
      return FlagAndColumn(name, input);
    }
    pulses.fixed_[i] = *fixed[input];
  }
  if (fixed.any_sea && origins[Index(PulseInput::kBeamAzimuth)] != InputOrigin::kNone) {
    pulses.fixed_[Index(PulseInput::kWindFrom)] = kWindForNorth;
    pulses.azimuths_from_north_ = true;
  }
  RETURN_IF_ERROR(CheckWays(origins, absl::StrCat(name, " line 1")));
  const std::vector<AxisId> missing = MissingIn(origins, fixed.any_sea);
  if (!missing.empty()) return MissingColumns(name, missing, names, origins);
  for (const OtherWay& way : kOtherWays) {  // Half of a way is like any other column.
    if (IsGivenByOtherWay(way.axis, origins)) continue;
    origins[Index(way.first)] = origins[Index(way.second)] = InputOrigin::kNone;
  }
  for (std::size_t i = 0; i < kPulseInputCount; ++i)
    if (origins[i] == InputOrigin::kColumn) pulses.columns_.push_back({static_cast<PulseInput>(i), column_of[i]});
  pulses.FindCoordinates(fixed, origins);
  return pulses;
}

void CsvPulses::FindCoordinates(const FixedInputs& fixed, const InputOrigins& origins) {
  const auto is_column = [&](PulseInput input) { return origins[Index(input)] == InputOrigin::kColumn; };
  constant_ = fixed.coordinates;
  for (const AxisId axis : kAxes)
    if (is_column(InputOf(axis))) varying_.push_back(axis);
  for (const OtherWay& way : kOtherWays) {
    if (!IsGivenByOtherWay(way.axis, origins)) continue;
    const bool of_incidence = way.axis == AxisId::kFootprint && is_column(PulseInput::kIncidence);
    if (is_column(way.first) || is_column(way.second) || of_incidence) {
      varying_.push_back(way.axis);
      from_other_way_.push_back(way.axis);
    } else {
      constant_[Index(way.axis)] = FromOtherWay(way.axis, fixed_);
    }
  }
  may_have_azimuth_ =
      origins[Index(AxisId::kAzimuth)] != InputOrigin::kNone || IsGivenByOtherWay(AxisId::kAzimuth, origins);
}

void CsvPulses::Clear(CsvPulseBatches& batches) const {
  for (PulseBatch* batch : {&batches.with_azimuth, &batches.without_azimuth}) {
    batch->size = 0;
    batch->azimuths_from_north = azimuths_from_north_;
    for (const AxisId axis : kAxes) {
      (*batch)[axis].clear();
      if (constant_[Index(axis)].has_value()) (*batch)[axis].push_back(*constant_[Index(axis)]);
    }
  }
}

absl::StatusOr<std::optional<float>> NumberOf(const std::string& file, const formats::CsvRecord& record,
                                              std::size_t index, std::string_view column, std::string_view units,
                                              bool may_be_empty) {
  const std::string_view raw = record.RawCell(index);
  const bool quoted = !raw.empty() && raw.front() == '"';
  const std::string unquoted = quoted ? record.Cell(index) : "";
  const absl::string_view cell =
      absl::StripAsciiWhitespace(quoted ? absl::string_view(unquoted) : absl::string_view(raw.data(), raw.size()));
  if (cell.empty() && may_be_empty) return std::nullopt;
  std::string buffer;
  const std::optional<std::string_view> text =
      formats::WithPoint(std::string_view(cell.data(), cell.size()), record.dialect, buffer);
  const std::optional<float> value = text.has_value() ? formats::ParseFloat(*text) : std::nullopt;
  if (value.has_value()) return value;
  return absl::InvalidArgumentError(absl::StrCat(
      file, " line ", record.line, ", column '", std::string(column),
      "': ", cell.empty() ? std::string("is empty") : absl::StrCat("'", cell, "' is not a number"),
      "; write a number in ", std::string(units), ", such as ", record.dialect.decimal == ',' ? "12,5" : "12.5",
      record.dialect.is_usual() ? "" : absl::StrCat(" (", record.dialect.Text(), ")")));
}

absl::StatusOr<bool> CsvPulses::Append(const formats::CsvRecord& record, CsvPulseBatches& batches) const {
  if (record.cell_count() != column_count_) {
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ": ", record.cell_count(),
                                                   " cells, but the header has ", column_count_, " (",
                                                   record.dialect.Text(), "); write one cell for each column"));
  }
  bool has_azimuth = may_have_azimuth_;
  PulseNumbers numbers = fixed_;
  for (const Column& column : columns_) {
    ASSIGN_OR_RETURN(const std::optional<float> number, NumberOf(name_, record, column.index, Name(column.input),
                                                                 Units(column.input), MayBeEmpty(column.input)));
    // An absent fetch; of the other inputs that may be empty, each makes the azimuth absent.
    numbers[Index(column.input)] = number.value_or(std::numeric_limits<float>::infinity());
    if (!number.has_value() && column.input != PulseInput::kFetch) has_azimuth = false;
  }
  for (const AxisId axis : from_other_way_) numbers[Index(axis)] = FromOtherWay(axis, numbers);
  PulseBatch& batch = batches[has_azimuth];
  ++batch.size;
  for (const AxisId axis : varying_)
    if (axis != AxisId::kAzimuth || has_azimuth) batch[axis].push_back(numbers[Index(axis)]);
  return has_azimuth;
}

namespace {

constexpr BudgetInput kInputs[] = {BudgetInput::kAltitude,     BudgetInput::kBeamAzimuth,  BudgetInput::kRoll,
                                   BudgetInput::kPitch,        BudgetInput::kHeading,      BudgetInput::kVelocityNorth,
                                   BudgetInput::kVelocityEast, BudgetInput::kVelocityDown, BudgetInput::kRollRate,
                                   BudgetInput::kPitchRate,    BudgetInput::kYawRate};

std::string_view NameOf(BudgetInput input) { return kBudgetInputNames[static_cast<std::size_t>(input)]; }

std::string_view UnitsOf(BudgetInput input) {
  if (input == BudgetInput::kAltitude) return "m";
  if (input == BudgetInput::kVelocityNorth || input == BudgetInput::kVelocityEast ||
      input == BudgetInput::kVelocityDown)
    return "m/s";
  if (input == BudgetInput::kRollRate || input == BudgetInput::kPitchRate || input == BudgetInput::kYawRate)
    return "degree/s";
  return "degree";
}

}  // namespace

absl::StatusOr<CsvAircraft> CsvAircraft::Bind(const std::string& name, const formats::CsvRecord& header,
                                              const FixedInputs& fixed) {
  CsvAircraft aircraft;
  aircraft.name_ = name;
  aircraft.altitude_ = fixed[PulseInput::kAltitude];
  aircraft.beam_azimuth_ = fixed[PulseInput::kBeamAzimuth];
  bool has_altitude = aircraft.altitude_.has_value();
  for (std::size_t i = 0; i < header.cell_count(); ++i) {
    std::string column = header.Cell(i);
    absl::StripAsciiWhitespace(&column);
    if (column == Name(PulseInput::kWindFrom) && !fixed.any_sea) aircraft.wind_from_ = i;
    for (const BudgetInput input : kInputs) {
      if (column != NameOf(input)) continue;
      if (input == BudgetInput::kAltitude && aircraft.altitude_.has_value())
        return FlagAndColumn(name, PulseInput::kAltitude);
      if (input == BudgetInput::kBeamAzimuth && aircraft.beam_azimuth_.has_value())
        return FlagAndColumn(name, PulseInput::kBeamAzimuth);
      aircraft.columns_.push_back({i, input});
      has_altitude |= input == BudgetInput::kAltitude;
    }
  }
  if (has_altitude) return aircraft;
  return absl::InvalidArgumentError(
      absl::StrCat(name,
                   " line 1: no column 'altitude' (a total needs the height of the sensor above the water); add it, "
                   "or give one value for all pulses by --altitude"));
}

void CsvAircraft::Clear(CsvAircraftBatch& batch) const {
  batch.columns = {};
  if (altitude_.has_value()) batch.columns[BudgetInput::kAltitude] = {*altitude_};
  if (beam_azimuth_.has_value()) batch.columns[BudgetInput::kBeamAzimuth] = {*beam_azimuth_};
  batch.sea_axes.clear();
  batch.undirected.clear();
}

absl::Status CsvAircraft::Append(const formats::CsvRecord& record, CsvAircraftBatch& batch) const {
  bool undirected = false;
  for (const Column& column : columns_) {
    const bool may_be_empty = column.input == BudgetInput::kBeamAzimuth;
    ASSIGN_OR_RETURN(const std::optional<float> number,
                     NumberOf(name_, record, column.index, NameOf(column.input), UnitsOf(column.input), may_be_empty));
    undirected |= !number.has_value();
    batch.columns[column.input].push_back(number.value_or(0));
  }
  batch.undirected.push_back(undirected);
  if (!wind_from_.has_value()) return absl::OkStatus();
  ASSIGN_OR_RETURN(
      const std::optional<float> wind_from,
      NumberOf(name_, record, *wind_from_, Name(PulseInput::kWindFrom), Units(PulseInput::kWindFrom), true));
  const bool known = wind_from.has_value() && !undirected;
  batch.sea_axes.push_back(known ? static_cast<float>(std::fmod(*wind_from + 540.0, 360.0)) : NAN);
  return absl::OkStatus();
}

void WaveHeightsOfWinds(const PulseBatch& pulses, const std::string& spectrum, std::vector<float>& heights) {
  constexpr double kSteps = 50;
  std::map<std::pair<double, double>, double> known;
  const auto at_node = [&](double wind, double fetch) {
    const auto [at, is_new] = known.try_emplace({wind, fetch}, 0.0);
    const auto metres = std::isfinite(fetch) ? std::optional<float>(std::exp(fetch / kSteps)) : std::nullopt;
    return is_new ? at->second = WaveHeightOfWind(wind / kSteps, metres, spectrum) : at->second;
  };
  // Linear between nodes 0.02 m/s and 2 % of the fetch apart. The height grows with the square of the wind and the root
  // of the fetch at most, so that from 1 m/s on the line is right to 1e-4 of it. Single precision may put a number
  // slightly off its node.
  const auto between = [](double place, const auto& at) {
    const double below = std::floor(place + 1e-3), part = place - below;
    return part > 1e-3 ? std::lerp(at(below), at(below + 1), part) : at(below);
  };
  const std::vector<float>& winds = pulses.axis[Index(AxisId::kWindSpeed)];
  const std::vector<float>& fetches = pulses.axis[Index(AxisId::kFetch)];
  heights.resize(winds.size() <= 1 && fetches.size() <= 1 ? 1 : pulses.size);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const float wind = winds.empty() ? 0 : winds[winds.size() == 1 ? 0 : i];
    const float fetch = fetches.empty() ? INFINITY : fetches[fetches.size() == 1 ? 0 : i];
    heights[i] = 0;
    if (!std::isfinite(wind) || !(fetch > 0)) continue;
    const auto over_wind = [&](double f) { return between(kSteps * wind, [&](double w) { return at_node(w, f); }); };
    heights[i] = static_cast<float>(between(kSteps * std::log(static_cast<double>(fetch)), over_wind));
  }
}

}  // namespace albtpu::annotate
