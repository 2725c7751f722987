#include "annotate/csv/csv_aircraft.h"

#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "annotate/csv/csv_pulses.h"
#include "annotate/run/exit_status.h"
#include "annotate/totals/plan_total.h"

namespace albtpu::annotate {
namespace {

constexpr BudgetInput kInputs[] = {
    BudgetInput::kAltitude,     BudgetInput::kBeamAzimuth,  BudgetInput::kRoll,
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
      aircraft.columns_.push_back({i, input});
      has_altitude |= input == BudgetInput::kAltitude;
    }
  }
  if (has_altitude) return aircraft;
  return absl::InvalidArgumentError(absl::StrCat(
      name,
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
    const absl::StatusOr<std::optional<float>> number =
        NumberOf(name_, record, column.index, NameOf(column.input), UnitsOf(column.input), may_be_empty);
    if (!number.ok()) return number.status();
    undirected |= !number->has_value();
    batch.columns[column.input].push_back(number->value_or(0));
  }
  batch.undirected.push_back(undirected);
  if (!wind_from_.has_value()) return absl::OkStatus();
  const absl::StatusOr<std::optional<float>> wind_from =
      NumberOf(name_, record, *wind_from_, Name(PulseInput::kWindFrom), Units(PulseInput::kWindFrom), true);
  if (!wind_from.ok()) return wind_from.status();
  const bool known = wind_from->has_value() && !undirected;
  batch.sea_axes.push_back(known ? static_cast<float>(std::fmod(**wind_from + 540.0, 360.0)) : NAN);
  return absl::OkStatus();
}

void WaveHeightsOfWinds(const PulseBatch& pulses, const std::string& spectrum, std::vector<float>& heights) {
  std::map<std::pair<float, float>, float> known;
  const std::vector<float>& winds = pulses.axis[Index(AxisId::kWindSpeed)];
  const std::vector<float>& fetches = pulses.axis[Index(AxisId::kFetch)];
  heights.resize(winds.size() <= 1 && fetches.size() <= 1 ? 1 : pulses.size);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const float wind = winds.empty() ? 0 : winds[winds.size() == 1 ? 0 : i];
    const float fetch = fetches.empty() ? INFINITY : fetches[fetches.size() == 1 ? 0 : i];
    // Winds that differ little use one spectrum: the height grows with the square of the wind.
    const std::pair<float, float> key = {
        std::round(wind * 50) / 50, std::isfinite(fetch) && fetch > 0 ? std::round(std::log(fetch) * 50) : 0};
    const auto [at, is_new] = known.try_emplace(key, 0.0f);
    if (is_new && std::isfinite(wind) && fetch > 0) {
      const bool developed = !std::isfinite(fetch);
      at->second = WaveHeightOfWind(
          key.first, developed ? std::nullopt : std::optional<float>(std::exp(key.second / 50)), spectrum);
    }
    heights[i] = at->second;
  }
}

}  // namespace albtpu::annotate
