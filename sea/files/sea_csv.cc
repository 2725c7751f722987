#include "sea/files/sea_csv.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/text_lines.h"
#include "sea/sea_time.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

constexpr int kGzipWindow = 15 + 16;  // the largest window, and a gzip header

class Inflater {
 public:
  Inflater() { ready_ = inflateInit2(&stream_, kGzipWindow) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }

  bool ready() const { return ready_; }
  z_stream& stream() { return stream_; }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

bool IsGzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

absl::StatusOr<std::string> Inflated(std::string_view bytes, std::size_t most) {
  Inflater inflater;
  if (!inflater.ready()) return absl::ResourceExhaustedError("no memory to inflate it; free some memory");
  z_stream& stream = inflater.stream();
  std::string text;
  while (true) {
    char piece[1 << 16];
    const auto given = static_cast<uInt>(std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max()));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = given;
    stream.next_out = reinterpret_cast<Bytef*>(piece);
    stream.avail_out = sizeof piece;
    const int result = inflate(&stream, Z_NO_FLUSH);
    const std::size_t made = sizeof piece - stream.avail_out;
    bytes.remove_prefix(given - stream.avail_in);
    if (made > most - text.size())
      return absl::InvalidArgumentError(absl::StrCat("it inflates to more than ", most, " bytes; split the file"));
    text.append(piece, made);
    if (result == Z_STREAM_END) {
      if (bytes.empty()) return text;
      if (inflateReset(&stream) != Z_OK) break;
    } else if (result != Z_OK) {
      break;
    }
  }
  return absl::InvalidArgumentError(
      bytes.empty() ? "its compressed data end early (the file was cut); get another copy of the file"
                    : "its compressed data are damaged; get another copy of the file");
}

namespace {

constexpr std::size_t kMaxCsvHarmonics = 32;

std::string_view Trimmed(std::string_view cell) {
  const std::vector<std::string_view> words = Words(cell);
  return words.size() == 1 ? words[0] : words.empty() ? std::string_view() : cell;
}

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(Trimmed(line.substr(0, comma)));
    if (comma == line.npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

bool IsComment(std::string_view line) { return Trimmed(line).empty() || Trimmed(line).front() == '#'; }

class SeaCsvReader {
 public:
  explicit SeaCsvReader(std::string_view text) : lines_(text) {}

  absl::StatusOr<SeaSeries> Read() {
    std::optional<std::string_view> line;
    while ((line = lines_.Next()) && IsComment(*line)) {
    }
    if (!line) return lines_.CutError();
    RETURN_IF_ERROR(ReadHeader(*line));
    while ((line = lines_.Next())) {
      if (IsComment(*line)) continue;
      RETURN_IF_ERROR(ReadLine(*line));
    }
    if (lines_.cut()) return lines_.CutError();
    RETURN_IF_ERROR(Finish());
    NoteIsotropic(series_, "r2 or alpha2");
    SortByTime(series_);
    return std::move(series_);
  }

 private:
  absl::Status ReadHeader(std::string_view line) {
    std::vector<std::string_view> names = Cells(line);
    timed_ = names[0] == "time";
    if (timed_) names.erase(names.begin());
    columns_ = names.size();
    using Names = std::vector<std::string_view>;
    by_frequency_ = names == Names{"f", "E"} || names == Names{"f", "E", "r2", "alpha2"};
    bool by_wavenumber = !timed_ && columns_ >= 4 && columns_ % 2 == 0 && columns_ <= 2 + 2 * kMaxCsvHarmonics &&
                         names[0] == "k" && names[1] == "S";
    for (std::size_t i = 2; by_wavenumber && i < columns_; ++i)
      by_wavenumber = names[i] == absl::StrCat(i % 2 == 0 ? "a" : "b", i / 2 * 2);
    if (!by_frequency_ && !by_wavenumber)
      return lines_.Error("has the columns ", Quoted(line),
                          " (expected f,E,r2,alpha2 or k,S,a2,b2,a4,b4...); "
                          "name them so");
    series_.format = by_frequency_ ? "a CSV file of a sea by frequency" : "a CSV file of a sea by wavenumber";
    whole_.a.resize(columns_ / 2 - 1);
    whole_.b.resize(columns_ / 2 - 1);
    return absl::OkStatus();
  }

  absl::Status ReadLine(std::string_view line) {
    std::vector<std::string_view> cells = Cells(line);
    if (cells.size() != columns_ + (timed_ ? 1 : 0))
      return lines_.Error("has ", cells.size(), " cells (expected ", columns_ + (timed_ ? 1 : 0), "); complete it");
    if (++values_ > kMaxSeaValues / 16) return lines_.Error("is one line too many; split the file");
    if (timed_) {
      const auto time = ParseSeaTime(cells[0]);
      if (!time)
        return lines_.Error(Quoted(cells[0]), " is no time (expected UTC such as 2020-06-08T03:50Z); correct it");
      if (!axis_.empty() && time != time_) RETURN_IF_ERROR(Finish());
      time_ = time;
      cells.erase(cells.begin());
    }
    std::vector<std::optional<double>> numbers;
    for (const std::string_view cell : cells) {
      numbers.push_back(ParseNumber(cell));
      if (!numbers.back() && !(cell.empty() && by_frequency_ && numbers.size() > 2))
        return lines_.Error(Quoted(cell), " is no number; correct it");
    }
    const double at = *numbers[0];
    const double lowest = by_frequency_ ? kLowestFrequency : kLowestWavenumber,
                 highest = by_frequency_ ? kHighestFrequency : kHighestWavenumber;
    if (!(at >= lowest && at <= highest))
      return lines_.Error(by_frequency_ ? "f" : "k", " is ", at, " (expected ", lowest, " to ", highest,
                          "); correct it");
    if (!axis_.empty() && at <= axis_.back())
      return lines_.Error(by_frequency_ ? "f" : "k", " is ", at,
                          " (expected more than the line before); sort the lines");
    if (axis_.size() == kMaxFrequencies)
      return lines_.Error("is one line too many (at most ", kMaxFrequencies, " in a sea); write wider bins");
    if (!(*numbers[1] >= 0 && *numbers[1] <= kMaxDensity))
      return lines_.Error(by_frequency_ ? "E" : "S", " is ", *numbers[1], " (expected 0 to ", kMaxDensity,
                          "); correct it");
    axis_.push_back(at);
    return by_frequency_ ? AddBin(numbers) : AddSample(numbers);
  }

  absl::Status AddBin(const std::vector<std::optional<double>>& numbers) {
    const bool directional = numbers.size() == 4 && numbers[2] && numbers[3];
    if (directional && !(*numbers[2] >= 0 && *numbers[2] <= 1))
      return lines_.Error("r2 is ", *numbers[2],
                          " (expected a fraction from 0 to 1); divide r2 by 100 if it is in hundredths");
    if (directional && !(std::abs(*numbers[3]) <= 360))
      return lines_.Error("alpha2 is ", *numbers[3], " (expected -360 to 360 degrees); correct it");
    bins_.push_back(directional ? SymmetricEnergy(*numbers[1], {*numbers[2]}, RadiansOfDegrees(*numbers[3]))
                                : DirectionalEnergy{.energy = *numbers[1]});
    return absl::OkStatus();
  }

  absl::Status AddSample(const std::vector<std::optional<double>>& numbers) {
    whole_.s.push_back(*numbers[1]);
    for (std::size_t n = 0; n < whole_.a.size(); ++n) {
      const double a = *numbers[2 + 2 * n], b = *numbers[3 + 2 * n];
      if (!(std::hypot(a, b) <= 1 + kHarmonicRounding))
        return lines_.Error("harmonic ", 2 * n + 2, " is ", a, ", ", b,
                            " (expected a length up to 1); divide a and b by S");
      whole_.a[n].push_back(a);
      whole_.b[n].push_back(b);
    }
    return absl::OkStatus();
  }

  // Ends the record whose lines were read.
  absl::Status Finish() {
    if (axis_.size() < 2)
      return lines_.Error("ends a sea of ", axis_.size(), " lines (expected at least 2); add lines");
    SeaRecord record{.time = time_};
    if (by_frequency_) {
      const double last = axis_.back();
      record.waves = std::make_shared<const BinnedSpectrum>(
          std::make_shared<const std::vector<double>>(std::exchange(axis_, {})), std::exchange(bins_, {}), 1, last);
    } else {
      whole_.k = std::exchange(axis_, {});
      record.waves = std::make_shared<const HarmonicSpectrum>(std::move(whole_));
    }
    series_.records.push_back(std::move(record));
    return absl::OkStatus();
  }

  TextLines lines_;
  bool timed_ = false, by_frequency_ = false;
  std::size_t columns_ = 0, values_ = 0;
  std::optional<double> time_;
  std::vector<double> axis_;
  std::vector<DirectionalEnergy> bins_;
  HarmonicSpectrum whole_;
  SeaSeries series_{};
};

}  // namespace

bool IsSeaCsv(std::string_view first_line) {
  const std::string_view first = Cells(first_line)[0];
  return first_line.find(',') != first_line.npos && (first == "f" || first == "k" || first == "time");
}

absl::StatusOr<SeaSeries> ReadSeaCsv(std::string_view text) { return SeaCsvReader(text).Read(); }

}  // namespace albtpu
