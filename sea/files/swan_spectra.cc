#include "sea/files/swan_spectra.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/sea_csv.h"
#include "sea/files/text_lines.h"
#include "sea/files/ww3_points.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

constexpr double kSwanWeight = 1025 * 9.81;  // N/m^3, by which SWAN turns variance into energy

class SwanReader {
 public:
  explicit SwanReader(std::string_view text) : words_(text) {}

  absl::StatusOr<SeaSeries> Read() {
    series_.format = "SWAN spectra";
    series_.points.clear();
    RETURN_IF_ERROR(ReadHeader());
    RETURN_IF_ERROR(ReadSpectra());
    if (words_.lines().cut()) return words_.lines().CutError();
    if (series_.records.empty()) return absl::InvalidArgumentError("it has no spectrum; give another file");
    series_.assumed.push_back("waves are taken from the model up to its highest frequency; currents are left out");
    if (without_data_ > 0)
      series_.assumed.push_back(absl::StrCat(without_data_, " spectra have no data and are left out"));
    SortByTime(series_);
    return std::move(series_);
  }

 private:
  absl::Status ReadHeader() {
    RETURN_IF_ERROR(NextKeyword());
    if (keyword_ != "SWAN") return Unexpected("SWAN");
    RETURN_IF_ERROR(NextKeyword());
    if (keyword_ == "TIME") {
      RETURN_IF_ERROR(Count(1).status());
      timed_ = true;
      RETURN_IF_ERROR(NextKeyword());
    }
    RETURN_IF_ERROR(ReadLocations());
    RETURN_IF_ERROR(ReadGrid());
    return ReadQuantity();
  }

  absl::Status ReadLocations() {
    const bool geographic = keyword_ == "LONLAT";
    if (!geographic && keyword_ != "LOCATIONS") return Unexpected("LONLAT or LOCATIONS");
    ASSIGN_OR_RETURN(const auto count, Count(kMaxSeaRecords));
    for (std::size_t i = 0; i < count; ++i) {
      const auto line = words_.NextLine();
      if (!line) return words_.lines().CutError();
      const std::vector<std::string_view> words = Words(*line);
      const auto x = ParseNumber(words[0]), y = words.size() > 1 ? ParseNumber(words[1]) : std::nullopt;
      if (!x || !y) return words_.lines().Error("does not begin with two coordinates; get another copy of the file");
      SeaPoint point{.name = words.size() > 2 ? std::string(words[2]) : std::string()};
      if (geographic) {
        point.longitude = *x;
        point.latitude = *y;
      }
      series_.points.push_back(std::move(point));
    }
    return NextKeyword();
  }

  absl::Status ReadGrid() {
    if (keyword_ != "AFREQ" && keyword_ != "RFREQ") return Unexpected("AFREQ or RFREQ");
    ASSIGN_OR_RETURN(auto frequencies, ReadAxis("a frequency"));
    const bool cartesian = keyword_ == "CDIR";
    if (keyword_ == "QUANT")
      return words_.lines().Error("the spectra have no directions; write them by SPECOUT with SPEC2D");
    if (!cartesian && keyword_ != "NDIR") return Unexpected("NDIR or CDIR");
    ASSIGN_OR_RETURN(auto directions, ReadAxis("a direction"));
    const auto [least, largest] = std::minmax_element(directions.begin(), directions.end());
    if (*largest - *least <= 2 * std::numbers::pi)
      return words_.lines().Error("the directions reach from ", *least, " to ", *largest,
                                  " degrees (a turn in radians is as wide); write directions in degrees");
    for (double& direction : directions) direction = RadiansOfDegrees(cartesian ? 90 - direction : direction);
    absl::StatusOr<SpectralGrid> grid = SpectralGrid::Make(std::move(frequencies), std::move(directions));
    if (!grid.ok()) return words_.lines().Error(grid.status().message());
    grid_ = *std::move(grid);
    return absl::OkStatus();
  }

  // The numbers behind a keyword, one on each line; then comes the next keyword.
  absl::StatusOr<std::vector<double>> ReadAxis(std::string_view what) {
    ASSIGN_OR_RETURN(const auto count, Count(kMaxFrequencies));
    std::vector<double> axis;
    for (std::size_t i = 0; i < count; ++i) {
      const auto line = words_.NextLine();
      if (!line) return words_.lines().CutError();
      const auto number = ParseNumber(Words(*line)[0]);
      if (!number)
        return words_.lines().Error(Quoted(*line), " is not ", std::string(what), "; get another copy of the file");
      axis.push_back(*number);
    }
    RETURN_IF_ERROR(NextKeyword());
    return axis;
  }

  absl::Status ReadQuantity() {
    if (keyword_ != "QUANT") return Unexpected("QUANT");
    RETURN_IF_ERROR(Count(1).status());
    RETURN_IF_ERROR(NextKeyword());
    const std::string quantity = keyword_;
    RETURN_IF_ERROR(NextKeyword());
    const bool energy = quantity == "EnDens", variance = quantity == "VaDens";
    if (!(energy && keyword_ == "J/m2/Hz/degr") && !(variance && keyword_ == "m2/Hz/degr"))
      return words_.lines().Error(
          "states ", Quoted(quantity), " in ", Quoted(keyword_),
          " (expected VaDens in m2/Hz/degr or EnDens in J/m2/Hz/degr); write spectra of variance");
    unit_ = DegreesOfRadians(energy ? 1 / kSwanWeight : 1);
    ASSIGN_OR_RETURN(const auto exception, words_.Numbers(1, "an exception value"));
    exception_ = exception.front();
    return absl::OkStatus();
  }

  // Every spectrum to the end of the text.
  absl::Status ReadSpectra() {
    while (const auto line = words_.NextLine()) {
      std::optional<double> time;
      std::string_view first = Words(*line)[0];
      if (timed_) {
        if (first.size() == 15 && first[8] == '.') time = SecondsOfDigits(first.substr(0, 8), first.substr(9));
        if (!time)
          return words_.lines().Error(
              Quoted(*line),
              " is no date and time (expected one such as 20161011.000000); get another copy of the file");
      }
      for (std::size_t point = 0; point < series_.points.size(); ++point) {
        if (timed_ || point > 0) {
          const auto next = words_.NextLine();
          if (!next) return words_.lines().CutError();
          first = Words(*next)[0];
        }
        RETURN_IF_ERROR(ReadSpectrum(first, point, time));
      }
    }
    return absl::OkStatus();
  }

  absl::Status ReadSpectrum(std::string_view keyword, std::size_t point, std::optional<double> time) {
    if (keyword == "NODATA") {
      ++without_data_;
      return absl::OkStatus();
    }
    SeaRecord record{.time = time, .point = point};
    if (keyword == "ZERO") {
      record.waves = grid_->NoWaves();
    } else if (keyword == "FACTOR") {
      ASSIGN_OR_RETURN(const auto factor, words_.Numbers(1, "a factor"));
      ASSIGN_OR_RETURN(auto densities, words_.Numbers(grid_->size(), "a spectral density"));
      for (double& density : densities) {
        if (density == exception_) {
          ++without_data_;
          return absl::OkStatus();
        }
        density *= factor.front() * unit_;
      }
      absl::StatusOr<BinnedWaves> waves = grid_->WavesOf(densities, SpectralGrid::Order::kDirectionFirst);
      if (!waves.ok()) return words_.lines().Error(waves.status().message());
      record.waves = *std::move(waves);
    } else {
      return words_.lines().Error(
          Quoted(keyword), " begins no spectrum (expected FACTOR, ZERO or NODATA); get another copy of the file");
    }
    values_ += 16 + std::get<BinnedWaves>(record.waves)->size() * (1 + 2 * kSeaHarmonics);
    if (values_ > kMaxSeaValues) return words_.lines().Error("ends one spectrum too many; split the file");
    series_.records.push_back(std::move(record));
    return absl::OkStatus();
  }

  // The first word of the next line that is no comment.
  absl::Status NextKeyword() {
    do {
      const auto line = words_.NextLine();
      if (!line) return words_.lines().CutError();
      keyword_ = Words(*line)[0];
    } while (keyword_.starts_with('$'));
    return absl::OkStatus();
  }

  // A count from 1 to `most`, alone on a line.
  absl::StatusOr<std::size_t> Count(std::size_t most) {
    RETURN_IF_ERROR(NextKeyword());
    const auto count = ParseCount(keyword_);
    if (!count || *count < 1 || static_cast<std::size_t>(*count) > most)
      return words_.lines().Error("states ", Quoted(keyword_), " (expected ",
                                  most == 1 ? "1" : absl::StrCat("1 to ", most), "); write the file anew");
    return static_cast<std::size_t>(*count);
  }

  absl::Status Unexpected(std::string_view expected) const {
    return words_.lines().Error("begins with ", Quoted(keyword_), " (expected ", std::string(expected),
                                "); get another copy of the file");
  }

  WordStream words_;
  std::string keyword_;
  bool timed_ = false;
  std::optional<SpectralGrid> grid_;
  double unit_ = 1, exception_ = 0;  // unit_: to m^2/Hz/rad
  std::size_t values_ = 0, without_data_ = 0;
  SeaSeries series_{};
};

}  // namespace

bool IsSwanSpectra(std::string_view first_line) {
  const std::vector<std::string_view> words = Words(first_line);
  return !words.empty() && words[0] == "SWAN";
}

absl::StatusOr<SeaSeries> ReadSwanSpectra(std::string_view text) { return SwanReader(text).Read(); }

}  // namespace albtpu
