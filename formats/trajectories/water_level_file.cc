#include "formats/trajectories/water_level_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/csv/csv_reader.h"
#include "formats/text/text.h"
#include "formats/trajectories/point_clock.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr char kTime[] = "time", kLevel[] = "water_level";
constexpr double kLargestTime = 1e11;  // s; later than any GPS time.
constexpr double kLargestLevel = 1e5;  // In any unit of heights.
constexpr std::size_t kLargestFile = 64 << 20;

std::string CellText(const CsvRecord& record, std::size_t cell) {
  return std::string(absl::StripAsciiWhitespace(record.Cell(cell)));
}

}  // namespace

class WaterLevelReader {
 public:
  WaterLevelReader(std::string name, std::string text, PointTimeForm form)
      : name_(std::move(name)), block_{.text = std::move(text)}, form_(form) {}

  absl::StatusOr<WaterLevelSeries> Read() {
    CsvRecords records(name_, block_);
    CsvRecord record;
    while (true) {
      ASSIGN_OR_RETURN(const bool more, records.Next(record));
      if (!more) break;
      if (record.blank()) continue;
      RETURN_IF_ERROR(has_header_ ? ReadLevel(record) : ReadHeader(record));
    }
    if (!has_header_) return Error("is empty; give a CSV file with the columns time and water_level");
    if (series_.size() < 2)
      return Error(
          "has fewer than two water levels (levels are interpolated between two); add levels, or give one "
          "number in place of the file");
    if (utc_ && form_ == PointTimeForm::kWeekSeconds) RETURN_IF_ERROR(TakeSecondsOfWeek());
    series_.has_dates_ = utc_;
    return std::move(series_);
  }

 private:
  absl::Status Error(std::string_view text) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ": ", std::string(text)));
  }
  absl::Status CellError(const CsvRecord& record, const char* column, std::string_view text) const {
    return absl::InvalidArgumentError(
        absl::StrCat(name_, " line ", record.line, ", column '", column, "': ", std::string(text)));
  }

  absl::Status ReadHeader(const CsvRecord& record) {
    std::optional<std::size_t> time, level;
    for (std::size_t cell = 0; cell < record.cell_count(); ++cell) {
      const std::string name = CellText(record, cell);
      std::optional<std::size_t>* const column = name == kTime ? &time : name == kLevel ? &level : nullptr;
      if (column == nullptr) continue;
      if (column->has_value()) return CellError(record, name.c_str(), "occurs twice; remove one of the columns");
      *column = cell;
    }
    if (!time.has_value() || !level.has_value()) {
      return absl::InvalidArgumentError(absl::StrCat(name_, " line ", record.line, ": there is no column '",
                                                     time.has_value() ? kLevel : kTime,
                                                     "'; name the columns time and water_level in the first line"));
    }
    time_column_ = *time;
    level_column_ = *level;
    column_count_ = record.cell_count();
    has_header_ = true;
    return absl::OkStatus();
  }

  absl::Status ReadLevel(const CsvRecord& record) {
    // A decimal comma makes two cells of one number, of which the first is a wrong level.
    if (record.cell_count() != column_count_) {
      return absl::InvalidArgumentError(
          absl::StrCat(name_, " line ", record.line, ": has ", record.cell_count(), " cells, but the first line names ",
                       column_count_,
                       " columns (a decimal comma, or a cell that is missing); write one cell for each "
                       "column, and decimal points"));
    }
    const std::string level_text = CellText(record, level_column_);
    const std::optional<double> level = ParseDouble(level_text);
    if (!level.has_value() || !(std::abs(*level) <= kLargestLevel)) {
      return CellError(record, kLevel,
                       absl::StrCat("'", level_text, "' is not a water level; write a number in the ",
                                    "unit of the heights of the points"));
    }
    double time = 0;
    RETURN_IF_ERROR(ReadTime(record, time));
    if (series_.size() > 0 && !(time > series_.times_.back())) {
      return CellError(
          record, kTime,
          absl::StrCat("'", CellText(record, time_column_), "' is not after the time in the line above; sort by time"));
    }
    series_.times_.push_back(time);
    series_.levels_.push_back(*level);
    return absl::OkStatus();
  }

  absl::Status ReadTime(const CsvRecord& record, double& time) {
    const std::string text = CellText(record, time_column_);
    const std::optional<double> utc = ParseUtc(text), number = ParseDouble(text);
    if (!utc.has_value() && !(number.has_value() && std::abs(*number) <= kLargestTime)) {
      return CellError(record, kTime,
                       absl::StrCat("'", text, "' is not a time; write UTC such as 2016-05-11T14:00:00Z, or the GPS ",
                                    "time of the points in seconds"));
    }
    if (series_.size() == 0) utc_ = utc.has_value();
    if (utc_ != utc.has_value()) {
      return CellError(record, kTime,
                       absl::StrCat("'", text, "' is ", utc_ ? "a number" : "a date",
                                    ", unlike the times above; write all in one form"));
    }
    if (utc_) {
      time = *utc - kAdjustedGpsOffset;
      return absl::OkStatus();
    }
    time = *number;
    if (series_.size() == 0) return absl::OkStatus();
    const double before = series_.times_.back() - (series_.crosses_week_ ? kSecondsPerWeek : 0);
    if (!series_.crosses_week_ && StartsNextWeek(before, time)) series_.crosses_week_ = true;
    if (series_.crosses_week_) time += kSecondsPerWeek;
    return absl::OkStatus();
  }

  // From adjusted GPS times to seconds of the week in which the series begins. Times of points do not name their week,
  // so a longer series would be ambiguous.
  absl::Status TakeSecondsOfWeek() {
    std::vector<double>& times = series_.times_;
    if (times.back() - times.front() >= kSecondsPerWeek) {
      return Error(
          "covers more than a week, but the times of the points are seconds of a week that they do not name; "
          "give the levels of the week of the survey alone");
    }
    const double week =
        std::floor((times.front() + kAdjustedGpsOffset) / kSecondsPerWeek) * kSecondsPerWeek - kAdjustedGpsOffset;
    for (double& time : times) time -= week;
    series_.crosses_week_ = times.back() > kSecondsPerWeek;
    return absl::OkStatus();
  }

  std::string name_;
  CsvBlock block_;
  PointTimeForm form_;
  WaterLevelSeries series_;
  bool has_header_ = false, utc_ = false;
  std::size_t time_column_ = 0, level_column_ = 0, column_count_ = 0;
};

absl::StatusOr<WaterLevelSeries> WaterLevelSeries::Parse(std::string name, std::string text, PointTimeForm form) {
  return WaterLevelReader(std::move(name), std::move(text), form).Read();
}

double WaterLevelSeries::Continued(double stated) const {
  const double time = scale_ * stated + shift_;
  return crosses_week_ && time < start() ? time + kSecondsPerWeek : time;
}

std::optional<std::size_t> WaterLevelSeries::After(double time) const {
  if (!(time >= start() && time <= end())) return std::nullopt;
  const auto after = std::upper_bound(times_.begin(), times_.end(), time) - times_.begin();
  return std::min(static_cast<std::size_t>(after), times_.size() - 1);
}

std::optional<double> WaterLevelSeries::Between(double time, std::size_t after) const {
  const double first = times_[after - 1], second = times_[after];
  if (time == first) return levels_[after - 1];
  if (time == second) return levels_[after];
  if (second - first > kLongestGap) return std::nullopt;
  const double weight = (time - first) / (second - first);
  return levels_[after - 1] + weight * (levels_[after] - levels_[after - 1]);
}

std::optional<double> WaterLevelSeries::At(double time) const {
  const double continued = Continued(time);
  const std::optional<std::size_t> after = After(continued);
  return after.has_value() ? Between(continued, *after) : std::nullopt;
}

void WaterLevelSeries::LevelsAt(std::span<const double> times, std::span<double> levels) const {
  std::size_t after = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double time = Continued(times[i]);
    std::optional<double> level;
    if (!IsBetween(time, after)) after = After(time).value_or(0);
    if (after > 0) level = Between(time, after);
    levels[i] = level.value_or(std::numeric_limits<double>::quiet_NaN());
  }
}

absl::StatusOr<WaterLevelSeries> ReadWaterLevels(const std::filesystem::path& path, PointTimeForm form) {
  ASSIGN_OR_RETURN(CsvReader reader, CsvReader::Open(path));
  ASSIGN_OR_RETURN(CsvBlock block, reader.ReadHeader());
  std::string text = std::move(block.text);
  while (true) {
    ASSIGN_OR_RETURN(const bool more, reader.Read(block));
    if (!more) break;
    text += block.text;
    if (text.size() > kLargestFile) {
      return absl::InvalidArgumentError(absl::StrFormat("%s: is larger than %d MB; give a CSV file of water levels",
                                                        path.string(), kLargestFile >> 20));
    }
  }
  return WaterLevelSeries::Parse(path.string(), std::move(text), form);
}

absl::StatusOr<WaterLevelSeries> FindWaterLevels(const std::filesystem::path& path, const PointTimes& points,
                                                 std::string& note) {
  note.clear();
  ASSIGN_OR_RETURN(WaterLevelSeries stated, ReadWaterLevels(path, points.form));
  const auto covered = [&](const WaterLevelSeries& series, const PointClock& clock) {
    const PointTimes times = clock(points.span);
    return Overlap({series.start(), series.end()}, times.span) / std::max(times.span.last - times.span.first, 1e-9);
  };
  const std::vector<PointClock> clocks = ClocksOf(points, TimeFormat::kAuto);
  if (!stated.has_dates() || stated.crosses_week_ || covered(stated, clocks.front()) >= 0) return stated;
  std::vector<PointClock> fitting;
  std::optional<WaterLevelSeries> found;
  for (const PointClock& clock : clocks) {
    // Dates of more than a week cannot be seconds of a week: an error of that form alone.
    absl::StatusOr<WaterLevelSeries> series = ReadWaterLevels(path, clock.form);
    if (!series.ok() || !(covered(*series, clock) >= 0.5)) continue;
    series->scale_ = clock.scale;
    series->shift_ = clock.shift;
    fitting.push_back(clock);
    found = *std::move(series);
  }
  if (fitting.empty()) return stated;
  if (fitting.size() > 1) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": covers the GPS times of the points as ", ClocksText(fitting),
                     ", but not as their header states; give the levels of the day of the survey alone"));
  }
  note = ClockNote(fitting.front(), points, path.string());
  return *std::move(found);
}

}  // namespace albtpu::formats
