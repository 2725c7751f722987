#include "formats/trajectories/water_level_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/crs/foot.h"
#include "formats/csv/csv_reader.h"
#include "formats/files/file_access.h"
#include "formats/text/text.h"
#include "formats/trajectories/coops_levels.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

constexpr char kTimeColumn[] = "time", kLevelColumn[] = "water_level";
constexpr double kLatestTime = 1e11;        // s; later than any GPS time.
constexpr double kLargestLevel = 1e5;       // In any unit of heights.
constexpr std::size_t kMostOfHeader = 200;  // Characters of it in messages.
constexpr std::size_t kLargestFile = 64 << 20;

// The most by which water rises or falls within `seconds`, m. The greatest tide on Earth, 16.3 m at Burntcoat Head in
// the Bay of Fundy (Canadian Hydrographic Service), is 4.1 m/h at its fastest if it is a sine of 12.42 h; surges rise
// by less. The 2 m are for what comes within minutes: bores, seiches, gauges that are read to a wave.
double HighestRise(double seconds) {
  constexpr double kAtOnce = 2, kHourly = 5;  // m, m/h
  return kAtOnce + kHourly * seconds / 3600;
}

std::string CellText(const CsvRecord& record, std::size_t cell) {
  return std::string(absl::StripAsciiWhitespace(record.Cell(cell)));
}

}  // namespace

class WaterLevelReader {
 public:
  WaterLevelReader(std::string name, std::string text, const LevelReference& reference)
      : name_(std::move(name)), block_{.text = std::move(text)}, reference_(reference) {}

  absl::StatusOr<WaterLevelSeries> Read() {
    RETURN_IF_ERROR(AreCoopsLevels(block_.text) ? TakeCoopsLevels() : ReadRecords());
    if (series_.size() < 2)
      return Error(
          "has fewer than two water levels (levels are interpolated between two); add levels, or give one "
          "number in place of the file");
    RETURN_IF_ERROR(CheckJumps());
    series_.name_ = name_;
    series_.has_dates_ = utc_;
    series_.offset_ = reference_.offset;
    for (double& level : series_.levels_) level += reference_.offset;
    if (reference_.datum.has_value() || reference_.offset != 0) Describe();
    return std::move(series_);
  }

 private:
  // From the level before `i` to that at `i`, upwards, in highest rises of this time if levels are in metres. 0 where
  // nothing is interpolated between the two.
  double RisesTo(std::size_t i) const {
    const double seconds = series_.times_[i] - series_.times_[i - 1];
    if (seconds > WaterLevelSeries::kLongestGap) return 0;
    return (series_.levels_[i] - series_.levels_[i - 1]) / HighestRise(seconds);
  }

  // Numbers that stand for a missing level, such as 9.999 or 0, are no tide. A file that does not state its unit may be
  // in feet, of which a tide has more; a level that comes back at once is no tide in feet, either.
  absl::Status CheckJumps() const {
    const double least_unit = series_.metres_.value_or(kMetresOfFoot), unit = series_.metres_.value_or(1);
    for (std::size_t i = 1; i < series_.size(); ++i) {
      const double rises = RisesTo(i), after = i + 1 < series_.size() ? RisesTo(i + 1) : 0;
      const double before = series_.levels_[i - 1], level = series_.levels_[i];
      if (std::min(std::abs(rises), std::abs(after)) * unit > 1 && rises * after < 0) {
        return Error(absl::StrFormat(
            "goes from %g to %g and back to %g within %.0f minutes, which no water does: %g "
            "stands for a missing level; remove it",
            before, level, series_.levels_[i + 1], (series_.times_[i + 1] - series_.times_[i - 1]) / 60, level));
      }
      if (std::abs(rises) * least_unit <= 1) continue;
      return Error(
          absl::StrFormat("goes from %g to %g within %.0f minutes, which no water does: one of them stands for "
                          "a missing level, or another datum begins there; remove it, or give the levels of one "
                          "datum",
                          before, level, (series_.times_[i] - series_.times_[i - 1]) / 60));
    }
    return absl::OkStatus();
  }

  absl::Status ReadRecords() {
    ASSIGN_OR_RETURN(block_.dialect, DialectOf(name_, block_.text));
    CsvRecords records(name_, block_);
    CsvRecord record;
    while (true) {
      ASSIGN_OR_RETURN(const bool more, records.Next(record));
      if (!more) break;
      if (record.blank()) continue;
      RETURN_IF_ERROR(has_header_ ? ReadLevel(record) : ReadHeader(record));
    }
    if (!has_header_) return Error("is empty; give a CSV file with the columns time and water_level");
    if (!reference_.hours_from_utc.has_value()) return absl::OkStatus();
    return Error("has times that are UTC or GPS times by their form; leave out --level-hours-from-utc");
  }

  // Datum, zone and unit are not those of the points by themselves, as they are of the form above.
  absl::Status TakeCoopsLevels() {
    ASSIGN_OR_RETURN(const CoopsLevels coops, ReadCoopsLevels(name_, block_.text));
    if (!reference_.datum.has_value()) {
      return Error(
          "is a file of CO-OPS, which does not state the datum of its levels; name the one that they were asked for by "
          "--level-datum, such as MLLW or NAVD, and what has to be added for that of the points by --level-offset");
    }
    using Zone = CoopsLevels::Zone;
    if (coops.zone == Zone::kLocal && !reference_.hours_from_utc.has_value()) {
      return Error(
          "has times of a local zone; give its hours from UTC by --level-hours-from-utc, such as -5 for Eastern "
          "Standard Time");
    }
    if (coops.zone == Zone::kGmt && reference_.hours_from_utc.value_or(0) != 0)
      return Error("states times in GMT; leave out --level-hours-from-utc");
    const double hours = reference_.hours_from_utc.value_or(0);
    for (const CoopsLevel& each : coops.levels) {
      const double time = GpsOfUtc(UtcOfGps(each.time) - hours * 3600) - kAdjustedGpsOffset;
      if (series_.size() > 0 && !(time > series_.times_.back()))
        return Error(absl::StrCat("has ", UtcText(each.time), " after a later time; sort it by time"));
      series_.times_.push_back(time);
      series_.levels_.push_back(each.level);
    }
    utc_ = true;
    series_.metres_ = coops.metres;
    about_ = absl::StrCat(
        coops.predicted ? "predictions" : "water levels", " of CO-OPS",
        coops.station.empty() ? "" : absl::StrCat(" at ", coops.station),
        coops.preliminary > 0 ? absl::StrFormat(", %d of %d preliminary", coops.preliminary, coops.levels.size()) : "",
        coops.missing > 0 ? absl::StrFormat(", %d missing", coops.missing) : "",
        coops.zone == Zone::kAbsent && hours == 0 ? ", times taken as GMT" : "",
        coops.metres.has_value() ? "" : ", in the unit of the points' heights");
    return absl::OkStatus();
  }

  void Describe() {
    series_.description_ = absl::StrCat(
        about_.empty() ? "water levels" : about_, ", relative to ", reference_.datum.value_or("a datum without name"),
        reference_.offset == 0
            ? " (taken as the datum of the points' heights; --level-offset is added otherwise)"
            : absl::StrFormat("; %+g is added for the datum of the points' heights", reference_.offset));
  }

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
      std::optional<std::size_t>* const column = name == kTimeColumn ? &time : name == kLevelColumn ? &level : nullptr;
      if (column == nullptr) continue;
      if (column->has_value()) return CellError(record, name.c_str(), "occurs twice; remove one of the columns");
      *column = cell;
    }
    if (!time.has_value() || !level.has_value()) {
      std::vector<std::string> found;
      for (std::size_t cell = 0; cell < record.cell_count(); ++cell) found.push_back(CellText(record, cell));
      return absl::InvalidArgumentError(absl::StrCat(
          name_, " line ", record.line, ": there is no column '", time.has_value() ? kLevelColumn : kTimeColumn,
          "' (columns found: ", OneLine(absl::StrJoin(found, ", ")).substr(0, kMostOfHeader),
          "); name the columns time and water_level in the first line"));
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
    const std::optional<double> level = NumberIn(level_text);
    if (!level.has_value() || !(std::abs(*level) <= kLargestLevel)) {
      return CellError(record, kLevelColumn,
                       absl::StrCat("'", level_text, "' is not a water level; write a number in the ",
                                    "unit of the heights of the points"));
    }
    double time = 0;
    RETURN_IF_ERROR(ReadTime(record, time));
    if (series_.size() > 0 && !(time > series_.times_.back())) {
      return CellError(
          record, kTimeColumn,
          absl::StrCat("'", CellText(record, time_column_), "' is not after the time in the line above; sort by time"));
    }
    series_.times_.push_back(time);
    series_.levels_.push_back(*level);
    return absl::OkStatus();
  }

  std::optional<double> NumberIn(const std::string& cell) const {
    std::string buffer;
    const std::optional<std::string_view> text = WithPoint(cell, block_.dialect, buffer);
    return text.has_value() ? ParseDouble(*text) : std::nullopt;
  }

  absl::Status ReadTime(const CsvRecord& record, double& time) {
    const std::string text = CellText(record, time_column_);
    const std::optional<double> utc = ParseUtc(text), number = NumberIn(text);
    if (!utc.has_value() && !(number.has_value() && std::abs(*number) <= kLatestTime)) {
      return CellError(record, kTimeColumn,
                       absl::StrCat("'", text, "' is not a time; write UTC such as 2016-05-11T14:00:00Z, or the GPS ",
                                    "time of the points in seconds"));
    }
    if (series_.size() == 0) utc_ = utc.has_value();
    if (utc_ != utc.has_value()) {
      return CellError(record, kTimeColumn,
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

  std::string name_;
  CsvBlock block_;
  LevelReference reference_;
  std::string about_;  // Of a file of CO-OPS.
  WaterLevelSeries series_;
  bool has_header_ = false, utc_ = false;
  std::size_t time_column_ = 0, level_column_ = 0, column_count_ = 0;
};

absl::StatusOr<WaterLevelSeries> ParseWaterLevels(std::string name, std::string text, const LevelReference& reference) {
  return WaterLevelReader(std::move(name), std::move(text), reference).Read();
}

absl::StatusOr<WaterLevelSeries> ReadWaterLevels(const std::filesystem::path& path, const LevelReference& reference) {
  ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(path, "a CSV file of water levels"));
  if (file.bytes().size() > kLargestFile) {
    return absl::InvalidArgumentError(absl::StrFormat("%s: is larger than %d MB; give a CSV file of water levels",
                                                      path.string(), kLargestFile >> 20));
  }
  return ParseWaterLevels(path.string(), std::string(file.bytes()), reference);
}

}  // namespace albtpu::formats
