#include "sea/files/ww3_points.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/angle.h"
#include "sea/files/sea_csv.h"
#include "sea/files/text_lines.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

// Of each direction, in the order given.
std::vector<double> Widths(const std::vector<double>& directions) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const std::size_t n = directions.size();
  const auto turned = [&](std::size_t i) {
    const double angle = std::fmod(directions[i], kTurn);
    return angle < 0 ? angle + kTurn : angle;
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return turned(a) < turned(b); });
  std::vector<double> gaps(n);  // behind each, in order
  for (std::size_t i = 0; i + 1 < n; ++i) gaps[i] = turned(order[i + 1]) - turned(order[i]);
  gaps[n - 1] = turned(order[0]) + kTurn - turned(order[n - 1]);

  const double equal = kTurn / static_cast<double>(n);
  if (std::all_of(gaps.begin(), gaps.end(), [&](double gap) { return std::abs(gap - equal) < 0.1 * equal; }))
    return std::vector<double>(n, equal);

  const double widest = 2 * Median(gaps);
  std::vector<double> widths(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = gaps[(i + n - 1) % n], behind = gaps[i];
    widths[order[i]] = 0.5 * ((before > widest ? behind : before) + (behind > widest ? before : behind));
  }
  return widths;
}

}  // namespace

DirectionalBins::DirectionalBins(std::vector<double> directions)
    : harmonics_(std::min(kSeaHarmonics, (directions.size() + 3) / 4 - 1)) {
  assert(directions.size() >= kFewest);
  std::array<double, kSeaHarmonics> ones;
  ones.fill(1);
  const std::vector<double> widths = Widths(directions);
  for (std::size_t i = 0; i < directions.size(); ++i)
    weights_.push_back(SymmetricEnergy(widths[i], ones, directions[i]));
}

DirectionalEnergy DirectionalBins::Sum(std::span<const double> densities) const {
  assert(densities.size() == weights_.size());
  DirectionalEnergy sum;
  for (std::size_t i = 0; i < densities.size(); ++i)
    if (densities[i] != 0) sum.Add(weights_[i], densities[i]);
  return sum;
}

SpectralGrid::SpectralGrid(std::vector<double> frequencies, std::vector<double> directions)
    : frequencies_(std::make_shared<const std::vector<double>>(std::move(frequencies))), bins_(std::move(directions)) {}

absl::StatusOr<SpectralGrid> SpectralGrid::Make(std::vector<double> frequencies, std::vector<double> directions) {
  if (frequencies.size() < 2 || directions.size() < DirectionalBins::kFewest)
    return absl::InvalidArgumentError(absl::StrCat("the spectra have ", frequencies.size(), " frequencies and ",
                                                   directions.size(), " directions (expected at least 2 and ",
                                                   DirectionalBins::kFewest, "); write them with more"));
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const bool increases = i == 0 || frequencies[i] > frequencies[i - 1];
    if (!(increases && frequencies[i] >= kLowestFrequency && frequencies[i] <= kHighestFrequency))
      return absl::InvalidArgumentError(absl::StrCat("frequency ", i + 1, " is ", frequencies[i], " Hz (expected ",
                                                     kLowestFrequency, " to ", kHighestFrequency,
                                                     " Hz, increasing); get another copy of the file"));
  }
  return SpectralGrid(std::move(frequencies), std::move(directions));
}

absl::StatusOr<BinnedWaves> SpectralGrid::WavesOf(std::span<const double> densities, Order order) const {
  assert(densities.size() == size());
  const std::size_t f_count = frequencies_->size(), d_count = bins_.size();
  std::vector<DirectionalEnergy> energies;
  std::vector<double> at_f(d_count);
  for (std::size_t f = 0; f < f_count; ++f) {
    for (std::size_t d = 0; d < d_count; ++d) {
      at_f[d] = densities[order == Order::kFrequencyFirst ? d * f_count + f : f * d_count + d];
      if (!(at_f[d] >= 0 && at_f[d] <= kMaxDensity))
        return absl::InvalidArgumentError(absl::StrCat("the spectrum that ends here has a density of ", at_f[d],
                                                       " m2/Hz/rad (expected 0 to ", kMaxDensity,
                                                       "); get another copy of the file"));
    }
    energies.push_back(bins_.Sum(at_f));
  }
  return std::make_shared<const BinnedSpectrum>(frequencies_, energies, bins_.harmonics(), frequencies_->back());
}

BinnedWaves SpectralGrid::NoWaves() const {
  return std::make_shared<const BinnedSpectrum>(frequencies_, std::vector<DirectionalEnergy>(frequencies_->size()), 0,
                                                frequencies_->back());
}

namespace {

constexpr double kLargestDirection = 2 * std::numbers::pi + 0.01;  // rad; they are rounded to 0.01
constexpr std::string_view kTitle = "'WAVEWATCH III SPECTRA'";

// Numbers of fixed width, which may touch where the next one is negative.
std::vector<double> TouchingNumbers(std::string_view line) {
  std::string separated;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '-' && i > 0 && line[i - 1] >= '0' && line[i - 1] <= '9') separated += ' ';
    separated += line[i];
  }
  std::vector<double> numbers;
  for (const std::string_view word : Words(separated)) {
    const auto number = ParseNumber(word);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

class Ww3Reader {
 public:
  explicit Ww3Reader(std::string_view text) : words_(text) {}

  absl::StatusOr<SeaSeries> Read() {
    series_.format = "point output of WAVEWATCH III";
    series_.points.clear();
    RETURN_IF_ERROR(ReadHeader());
    while (const auto line = words_.NextLine()) RETURN_IF_ERROR(ReadTime(*line));
    if (words_.lines().cut()) return words_.lines().CutError();
    if (series_.records.empty())
      return absl::InvalidArgumentError("it has a header and no record; get another copy of the file");
    series_.assumed.push_back("waves are taken from the model up to its highest frequency; currents are left out");
    SortByTime(series_);
    return std::move(series_);
  }

 private:
  absl::Status ReadHeader() {
    const auto line = words_.NextLine();
    if (!line) return words_.lines().CutError();
    if (!IsWw3Points(*line))
      return words_.lines().Error("is not the title of WAVEWATCH III's point output; get another copy of the file");
    const std::vector<std::string_view> counts = Words(line->substr(line->find(kTitle) + kTitle.size()));
    for (std::size_t i = 0; i < 3; ++i) {
      const auto count = i < counts.size() ? ParseCount(counts[i]) : std::nullopt;
      if (!count || *count < 1 || static_cast<std::size_t>(*count) > (i == 2 ? kMaxSeaRecords : kMaxFrequencies))
        return words_.lines().Error(
            "does not state the numbers of frequencies, directions and points; get another copy of the file");
      (i == 0 ? frequencies_ : i == 1 ? directions_ : points_) = static_cast<std::size_t>(*count);
    }
    ASSIGN_OR_RETURN(const auto frequencies, words_.Numbers(frequencies_, "a frequency"));
    ASSIGN_OR_RETURN(const auto directions, words_.Numbers(directions_, "a direction"));
    for (const double direction : directions)
      if (std::abs(direction) > kLargestDirection)
        return words_.lines().Error("a direction is ", direction,
                                    " rad (expected 0 to 2 pi); write directions in radians");
    absl::StatusOr<SpectralGrid> grid = SpectralGrid::Make(frequencies, directions);
    if (!grid.ok()) return words_.lines().Error(grid.status().message());
    grid_ = *std::move(grid);
    return absl::OkStatus();
  }

  absl::Status ReadTime(std::string_view line) {
    const std::vector<std::string_view> words = Words(line);
    const auto time = words.size() == 2 ? SecondsOfDigits(words[0], words[1]) : std::nullopt;
    if (!time) return words_.lines().Error(Quoted(line), " is no date and time; get another copy of the file");
    for (std::size_t i = 0; i < points_; ++i) RETURN_IF_ERROR(ReadPoint(*time));
    return absl::OkStatus();
  }

  absl::Status ReadPoint(double time) {
    const auto line = words_.NextLine();
    if (!line) return words_.lines().CutError();
    const std::size_t open = line->find('\''), close = line->find('\'', open + 1);
    if (open == line->npos || close == line->npos)
      return words_.lines().Error(Quoted(*line), " is no point's name; get another copy of the file");
    const std::vector<double> numbers = TouchingNumbers(line->substr(close + 1));
    if (numbers.size() < 5 || !(numbers[2] > 0 && numbers[2] <= kDeepestWater) ||
        !(numbers[3] >= 0 && numbers[3] <= kStrongestWind) || !(std::abs(numbers[4]) <= 360))
      return words_.lines().Error(
          "does not state a possible latitude, longitude, depth, wind speed and wind direction; get another "
          "copy of the file");
    const std::string name(Words(line->substr(open + 1, close - open - 1)).empty()
                               ? std::string_view()
                               : line->substr(open + 1, close - open - 1));
    SeaRecord record{.time = time,
                     .point = PointNamed(name.substr(0, name.find_last_not_of(' ') + 1), numbers[0], numbers[1]),
                     .water_depth = numbers[2],
                     .wind_speed_10m = numbers[3],
                     .wind_from = RadiansOfDegrees(numbers[4])};
    ASSIGN_OR_RETURN(const auto density, words_.Numbers(frequencies_ * directions_, "a spectral density"));
    absl::StatusOr<BinnedWaves> waves = grid_->WavesOf(density, SpectralGrid::Order::kFrequencyFirst);
    if (!waves.ok()) return words_.lines().Error(waves.status().message());
    record.waves = *std::move(waves);
    values_ += frequencies_ * (1 + 2 * kSeaHarmonics);
    if (values_ > kMaxSeaValues) return words_.lines().Error("ends one spectrum too many; split the file");
    series_.records.push_back(std::move(record));
    return absl::OkStatus();
  }

  std::size_t PointNamed(const std::string& name, double latitude, double longitude) {
    const auto [found, added] = numbers_.emplace(std::tuple(name, latitude, longitude), series_.points.size());
    if (added) series_.points.push_back({.name = name, .latitude = latitude, .longitude = longitude});
    return found->second;
  }

  WordStream words_;
  std::size_t frequencies_ = 0, directions_ = 0, points_ = 0, values_ = 0;
  std::optional<SpectralGrid> grid_;
  std::map<std::tuple<std::string, double, double>, std::size_t> numbers_;
  SeaSeries series_{};
};

}  // namespace

bool IsWw3Points(std::string_view first_line) { return first_line.find(kTitle) != first_line.npos; }

absl::StatusOr<SeaSeries> ReadWw3Points(std::string_view text) { return Ww3Reader(text).Read(); }

}  // namespace albtpu
