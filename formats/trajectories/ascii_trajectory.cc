#include "formats/trajectories/ascii_trajectory.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/csv/csv_reader.h"
#include "formats/files/file_access.h"
#include "formats/trajectories/ascii_columns.h"
#include "formats/trajectories/trajectory_sigmas.h"
#include "sea/angle.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

bool IsBlank(char character) { return character == ' ' || character == '\t' || character == '\r'; }
bool IsMark(char character) { return character == ',' || character == ';'; }
bool IsSeparator(char character) { return IsBlank(character) || IsMark(character); }

// The longest beginning of `text` without separators, at most 32 characters: what a message quotes.
std::string Word(std::string_view text) {
  std::size_t size = 0;
  while (size < std::min<std::size_t>(text.size(), 32) && !IsSeparator(text[size])) ++size;
  return std::string(text.substr(0, size));
}

void SkipBlanks(std::string_view& text) {
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
}

// Reads a finite number that a separator or the end of the line follows.
bool ReadNumber(std::string_view& text, double& number) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  // from_chars takes no plus sign.
  if (begin + 1 < end && *begin == '+' && begin[1] != '-') ++begin;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || !std::isfinite(number)) return false;
  if (stop != end && !IsSeparator(*stop)) return false;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return true;
}

// Moves on to the next cell of a line; false at its end. One comma or semicolon, with blanks around it, or blanks alone
// separate cells.
bool NextCell(std::string_view& text) {
  SkipBlanks(text);
  if (text.empty()) return false;
  if (IsMark(text.front())) {
    text.remove_prefix(1);
    SkipBlanks(text);
  }
  return true;
}

std::size_t CountCells(std::string_view line) {
  SkipBlanks(line);
  std::size_t cells = 1;
  while (true) {
    while (!line.empty() && !IsSeparator(line.front())) line.remove_prefix(1);
    if (!NextCell(line)) return cells;
    ++cells;
  }
}

bool BeginsWithNumber(std::string_view line) {
  SkipBlanks(line);
  double ignored;
  return ReadNumber(line, ignored);
}

// The line with decimal points in place of commas.
std::string PointLine(std::string_view line) {
  std::string points(line);
  std::replace(points.begin(), points.end(), ',', '.');
  return points;
}

bool IsText(std::string_view bytes) {
  return std::none_of(bytes.begin(), bytes.end(), [](char character) {
    const auto code = static_cast<unsigned char>(character);
    return code < 32 && code != '\t' && code != '\n' && code != '\r';
  });
}

}  // namespace

// Reads the lines of a file into a trajectory.
class AsciiReader {
 public:
  AsciiReader(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {
    if (rest_.substr(0, kByteOrderMark.size()) == kByteOrderMark) rest_.remove_prefix(kByteOrderMark.size());
  }

  absl::StatusOr<std::unique_ptr<AsciiTrajectory>> Read() {
    if (rest_.empty()) return Error("is empty; give an ASCII trajectory");
    if (!AsciiTrajectory::Recognizes(rest_))
      return Error("is not text; give an SBET, or an ASCII trajectory of 15 or 20 columns");
    RETURN_IF_ERROR(ReadHeader());
    std::unique_ptr<AsciiTrajectory> trajectory(new AsciiTrajectory(name_, columns_.size()));
    Reserve(*trajectory);
    while (true) {
      RETURN_IF_ERROR(ReadLine(*trajectory));
      if (!NextLine()) break;
      if (decimal_comma_) RETURN_IF_ERROR(TakeDecimalCommas());
    }
    if (trajectory->size() < 2) return Error("has a single record; give a trajectory of at least two");
    return trajectory;
  }

  bool FindsColumns() {
    ReadHeader().IgnoreError();
    return !columns_.empty();
  }

 private:
  absl::Status Error(std::string_view text) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, ": ", std::string(text)));
  }
  absl::Status LineError(std::string_view text) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", line_number_, ": ", std::string(text)));
  }
  absl::Status ColumnError(std::size_t column, std::string_view text) const {
    return absl::InvalidArgumentError(absl::StrCat(name_, " line ", line_number_, ", column ", column + 1, " '",
                                                   columns_[column].name, "': ", std::string(text)));
  }

  // Takes the next line that is not blank; false at the end of the file.
  bool NextLine() {
    while (!rest_.empty()) {
      const void* const newline = std::memchr(rest_.data(), '\n', rest_.size());
      const std::size_t size = newline == nullptr
                                   ? rest_.size()
                                   : static_cast<std::size_t>(static_cast<const char*>(newline) - rest_.data());
      line_ = rest_.substr(0, size);
      rest_.remove_prefix(newline == nullptr ? size : size + 1);
      ++line_number_;
      SkipBlanks(line_);
      if (!line_.empty()) return true;
    }
    return false;
  }

  // Stops at the first line of numbers.
  absl::Status ReadHeader() {
    constexpr std::size_t kLongestHeader = 200;  // Lines.
    std::vector<std::pair<std::size_t, std::string_view>> header;
    while (true) {
      if (!NextLine()) return Error("has no line of numbers; give an ASCII trajectory of 15 or 20 columns");
      if (BeginsWithNumber(line_)) break;
      header.emplace_back(line_number_, line_);
      if (header.size() > kLongestHeader) {
        return LineError(absl::StrCat("'", Word(line_), "' is not a number, nor is any line above; give an ASCII ",
                                      "trajectory of 15 or 20 columns"));
      }
    }
    RETURN_IF_ERROR(FindDecimalMark());
    const std::size_t cells = CountCells(line_);
    columns_ = AsciiColumns(cells);
    if (columns_.empty()) {
      return LineError(absl::StrCat("has ", cells,
                                    " columns; a trajectory has 15 (time, longitude, latitude, X, Y, Z, ",
                                    "roll, pitch, heading and six sigmas), or the 20 of POSPac's export"));
    }
    for (const auto& [number, line] : header) {
      const std::string contradiction = HeaderContradiction(line, columns_);
      if (contradiction.empty()) continue;
      return absl::InvalidArgumentError(absl::StrCat(name_, " line ", number, ": the header states ", contradiction));
    }
    return absl::OkStatus();
  }

  // Whether commas are decimal marks, as beside semicolons, or separate columns: what makes a layout.
  absl::Status FindDecimalMark() {
    if (line_.find(',') == line_.npos) return absl::OkStatus();
    decimal_comma_ = line_.find(';') != line_.npos;
    if (!decimal_comma_ && line_.find('.') == line_.npos && !AsciiColumns(CountCells(PointLine(line_))).empty()) {
      if (!AsciiColumns(CountCells(line_)).empty())
        return LineError("has commas that may separate columns or be decimal marks; separate columns by semicolons");
      decimal_comma_ = true;
    }
    return decimal_comma_ ? TakeDecimalCommas() : absl::OkStatus();
  }

  // The line with points.
  absl::Status TakeDecimalCommas() {
    if (line_.find('.') != line_.npos)
      return LineError("has both decimal commas and decimal points, or thousands; write one mark");
    points_ = PointLine(line_);
    line_ = points_;
    return absl::OkStatus();
  }

  void Reserve(AsciiTrajectory& trajectory) const {
    const std::size_t shortest = 2 * columns_.size();  // A digit and a separator for each number.
    const auto lines = static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), '\n'));
    const std::size_t most = std::min(lines, rest_.size() / shortest) + 2;
    trajectory.lines_.reserve(most);
    if (HasVelocities()) trajectory.velocities_.reserve(most);
  }

  bool HasVelocities() const { return columns_.size() == kMaxAsciiColumns; }

  absl::Status CheckValue(std::size_t column, double value) const {
    const AsciiColumn& expected = columns_[column];
    if (value >= expected.least && value <= expected.largest) return absl::OkStatus();
    const bool exchanged = expected.field == AsciiField::kLatitude && std::abs(value) <= 360;
    return ColumnError(
        column, absl::StrFormat("%g %s is outside %g to %g%s", value, expected.unit, expected.least, expected.largest,
                                exchanged ? "; exchange latitude and longitude"
                                          : "; check the order and the units of the columns"));
  }

  absl::Status ReadNumbers(std::array<double, kAsciiFields>& values) const {
    std::string_view rest = line_;
    for (std::size_t column = 0; column < columns_.size(); ++column) {
      double& value = values[static_cast<std::size_t>(columns_[column].field)];
      if (!ReadNumber(rest, value)) {
        return rest.empty() ? LineError(absl::StrCat("ends after ", column, " of ", columns_.size(),
                                                     " columns; give the whole file"))
                            : ColumnError(column, absl::StrCat("'", Word(rest), "' is not a finite number"));
      }
      RETURN_IF_ERROR(CheckValue(column, value));
      const bool more = NextCell(rest);
      if (more && column + 1 == columns_.size()) {
        return LineError(absl::StrCat("has ", CountCells(line_), " columns, not ", columns_.size(),
                                      " as the first line of numbers"));
      }
    }
    return absl::OkStatus();
  }

  // Seconds of the week go on where the next week begins.
  absl::Status ContinueTime(const AsciiTrajectory& trajectory, double& time) {
    if (trajectory.lines_.empty()) return absl::OkStatus();
    const double before = trajectory.lines_.back().time;
    if (!next_week_ && StartsNextWeek(before, time)) next_week_ = true;
    const double continued = next_week_ ? time + kSecondsPerWeek : time;
    if (continued > before) {
      time = continued;
      return absl::OkStatus();
    }
    return ColumnError(0, absl::StrFormat("%.6f s follows %.6f s: times must increase; sort the lines by time", time,
                                          next_week_ ? before - kSecondsPerWeek : before));
  }

  absl::Status ReadLine(AsciiTrajectory& trajectory) {
    std::array<double, kAsciiFields> values;
    RETURN_IF_ERROR(ReadNumbers(values));
    const auto value = [&values](AsciiField field) -> double& { return values[static_cast<std::size_t>(field)]; };
    const auto angle = [&value](AsciiField field) { return RadiansOfDegrees(value(field)); };
    const auto sigma = [&](AsciiField field) { return static_cast<float>(value(field)); };
    const auto angle_sigma = [&](AsciiField field) { return static_cast<float>(angle(field)); };
    using enum AsciiField;
    RETURN_IF_ERROR(ContinueTime(trajectory, value(kTime)));
    trajectory.lines_.push_back({.time = value(kTime),
                                 .longitude = std::remainder(angle(kLongitude), 2 * std::numbers::pi),
                                 .latitude = angle(kLatitude),
                                 .x = value(kX),
                                 .y = value(kY),
                                 .height = value(kHeight),
                                 .roll = angle(kRoll),
                                 .pitch = angle(kPitch),
                                 .heading = angle(kHeading),
                                 .sigma_x = sigma(kSigmaX),
                                 .sigma_y = sigma(kSigmaY),
                                 .sigma_z = sigma(kSigmaZ),
                                 .sigma_roll = angle_sigma(kSigmaRoll),
                                 .sigma_pitch = angle_sigma(kSigmaPitch),
                                 .sigma_heading = angle_sigma(kSigmaHeading)});
    if (HasVelocities())
      trajectory.velocities_.push_back({value(kVelocityNorth), value(kVelocityEast), value(kVelocityUp)});
    const AsciiTrajectory::Line& line = trajectory.lines_.back();
    trajectory.has_grid_ = trajectory.has_grid_ || line.x != 0 || line.y != 0;
    trajectory.has_position_sigma_ |= line.sigma_x > 0 || line.sigma_y > 0 || line.sigma_z > 0;
    trajectory.has_attitude_sigma_ |= line.sigma_roll > 0 || line.sigma_pitch > 0 || line.sigma_heading > 0;
    return absl::OkStatus();
  }

  std::string name_;
  std::string_view rest_, line_;
  std::size_t line_number_ = 0;
  std::span<const AsciiColumn> columns_;
  bool next_week_ = false, decimal_comma_ = false;
  std::string points_;  // The line, with decimal points.
};

absl::StatusOr<std::unique_ptr<AsciiTrajectory>> AsciiTrajectory::Open(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const MappedFile file, MappedFile::Open(path, "an ASCII trajectory"));
  return Parse(path.string(), file.bytes());
}

absl::StatusOr<std::unique_ptr<AsciiTrajectory>> AsciiTrajectory::Parse(std::string name, std::string_view text) {
  absl::StatusOr<std::unique_ptr<AsciiTrajectory>> trajectory = AsciiReader(std::move(name), text).Read();
  if (!trajectory.ok()) return trajectory;
  const auto grid_position = [&trajectory](std::size_t i) { return (*trajectory)->GridPositionAt(i); };
  RETURN_IF_ERROR(CheckMotion(**trajectory, grid_position));
  RETURN_IF_ERROR(CheckJumps(**trajectory, [&trajectory](std::size_t i) { return (*trajectory)->Record(i); }));
  const auto sigma = [&](std::size_t i) { return (*trajectory)->SigmaAt(i).value_or(TrajectorySigma{}); };
  const SigmaColumns columns = SigmaColumnsOf(AsciiColumns((*trajectory)->columns()));
  RETURN_IF_ERROR(CheckSigmaUnits((*trajectory)->name(), columns, (*trajectory)->size(), sigma));
  return trajectory;
}

bool AsciiTrajectory::Recognizes(std::string_view bytes) { return !bytes.empty() && IsText(bytes.substr(0, 4096)); }

bool AsciiTrajectory::HasRecords(std::string_view text) { return AsciiReader("", text).FindsColumns(); }

TrajectoryRecord AsciiTrajectory::Record(std::size_t record) const {
  const Line& line = lines_[record];
  TrajectoryRecord result{.time = line.time,
                          .latitude = line.latitude,
                          .longitude = line.longitude,
                          .height = line.height,
                          .roll = line.roll,
                          .pitch = line.pitch,
                          .heading = line.heading};
  if (!velocities_.empty()) {
    result.velocity_north = velocities_[record][0];
    result.velocity_east = velocities_[record][1];
    result.velocity_up = velocities_[record][2];
  }
  return result;
}

std::optional<TrajectorySigma> AsciiTrajectory::SigmaAt(std::size_t record) const {
  if (!has_position_sigma_ && !has_attitude_sigma_) return std::nullopt;
  const Line& line = lines_[record];
  const auto or_not = [](bool stated, float sigma) { return stated ? double{sigma} : kNotStated; };
  return TrajectorySigma{.north = or_not(has_position_sigma_, line.sigma_y),
                         .east = or_not(has_position_sigma_, line.sigma_x),
                         .down = or_not(has_position_sigma_, line.sigma_z),
                         .roll = or_not(has_attitude_sigma_, line.sigma_roll),
                         .pitch = or_not(has_attitude_sigma_, line.sigma_pitch),
                         .heading = or_not(has_attitude_sigma_, line.sigma_heading)};
}

std::optional<GridPosition> AsciiTrajectory::GridPositionAt(std::size_t record) const {
  if (!has_grid_) return std::nullopt;
  return GridPosition{lines_[record].x, lines_[record].y};
}

}  // namespace albtpu::formats
