#include "quality/crosscheck/cross_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

constexpr double kMedianOfNormal = 0.6744897501960817;  // Of the magnitude of a standard normal number.

// With that of a bottom whose height departs from its plane by `rough` m^2 in the square of a metre of distance.
double Predicted(const CrossPair& pair, double rough) {
  return pair.variance() + rough * pair.distance * pair.distance;
}

double MedianFactor(const std::vector<CrossPair>& pairs, double rough) {
  std::vector<double> ratios;
  for (const CrossPair& pair : pairs) ratios.push_back(std::abs(pair.difference) / std::sqrt(Predicted(pair, rough)));
  return Median(std::move(ratios)) / kMedianOfNormal;
}

template <typename Coordinate>
std::vector<CrossBand> Bands(const std::vector<CrossPair>& pairs, double rough, std::span<const double> ends,
                             Coordinate coordinate) {
  std::vector<CrossBand> bands(ends.size() - 1);
  for (std::size_t i = 0; i < bands.size(); ++i) bands[i].from = ends[i], bands[i].to = ends[i + 1];
  for (const CrossPair& pair : pairs) {
    const double at = coordinate(pair);
    for (CrossBand& band : bands) {
      if (at < band.from || at >= band.to) continue;
      ++band.pairs;
      band.chi_square += std::pow(pair.difference, 2) / Predicted(pair, rough);
    }
  }
  std::erase_if(bands, [](const CrossBand& band) { return band.pairs == 0; });
  for (CrossBand& band : bands) band.chi_square /= static_cast<double>(band.pairs);
  return bands;
}

// k^2 = sum over parts of share k_part^2, and the distance of each end of the interval from it the root of the sum of
// the squares of those of the parts.
Estimate OfBoth(const CrossCheck& check) {
  const double of_line = check.line.factor.has_value() ? check.line_in_variance : 0;
  double value = 0, below = 0, above = 0;
  for (const auto& [part, share] : {std::pair{check.pulse.factor, 1 - of_line},
                                    std::pair{check.line.factor.value_or(Estimate{1, 1, 1}), of_line}}) {
    if (share == 0) continue;
    const double squared = part.value * part.value;
    value += share * squared;
    below += std::pow(share * (squared - part.low * part.low), 2);
    above += std::pow(share * (part.high * part.high - squared), 2);
  }
  return {std::sqrt(value), std::sqrt(std::max(value - std::sqrt(below), 0.0)), std::sqrt(value + std::sqrt(above))};
}

std::string NameOfGuilty(const CrossCheck& check) {
  if (check.line.differs) return "trajectory";
  if (!check.pulse.differs) return "";
  return check.pulse.named.empty() || !check.sea_known ? "pulse" : check.pulse.named;
}

}  // namespace

std::optional<CrossCheck> CheckPairs(PatchPairs& of_patches, double patch, const SharedWaves& waves) {
  std::vector<CrossPair>& pairs = of_patches.across;
  if (pairs.empty()) return std::nullopt;
  CrossCheck check;
  check.median_factor = MedianFactor(pairs, 0);
  const double most = kOutlier * std::max(check.median_factor, 1.0);
  const auto is_outlier = [most](const CrossPair& pair) {
    return std::abs(pair.difference) > most * std::sqrt(pair.variance());
  };
  check.outliers = std::erase_if(pairs, is_outlier);
  std::erase_if(of_patches.within, is_outlier);
  check.pairs = pairs.size();
  check.sea_known =
      std::ranges::none_of(pairs, [](const CrossPair& pair) { return pair.a.pulse.sea == PulseOnWater::kNoSea; });
  double air = 0, sea = 0, line = 0;
  for (const CrossPair& pair : pairs)
    air += pair.variance_air(), sea += pair.variance_sea(), line += pair.variance_line();
  check.air_in_variance = air / (air + sea + line);
  check.line_in_variance = line / (air + sea + line);
  const PairGroups groups = GroupPairs(pairs, patch, waves);
  check.pulse = FitPulses(SquaredDifferences(of_patches, groups, waves), check.median_factor);
  check.line = TestLines(groups);
  check.factor = OfBoth(check);
  check.guilty = NameOfGuilty(check);
  const double rough = check.pulse.rough;
  check.median_factor = MedianFactor(pairs, rough);
  std::map<std::pair<int, int>, double> means;
  for (const LineDifference& each : check.line.differences) means[{each.line_a, each.line_b}] = each.mean;
  const auto count = static_cast<double>(pairs.size());
  for (const CrossPair& pair : pairs) {
    const double variance = Predicted(pair, rough);
    const double square = std::pow(pair.difference, 2) / variance;
    check.chi_square += square / count;
    check.chi_square_within_lines +=
        std::pow(pair.difference - means.at({pair.line_a, pair.line_b}), 2) / variance / count;
    check.beyond_three_sigma += (square > 9 ? 1 : 0) / count;
  }
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  constexpr std::array<double, 9> kDepths = {0, 2, 5, 10, 15, 20, 30, 50, kNoEnd};
  constexpr std::array<double, 8> kIncidences = {0, 5, 10, 15, 20, 25, 30, 90};
  constexpr std::array<double, 5> kShares = {0, 0.25, 0.5, 0.75, 1.001};
  check.by_depth = Bands(pairs, rough, kDepths, [](const CrossPair& pair) { return pair.depth; });
  check.by_incidence = Bands(pairs, rough, kIncidences, [](const CrossPair& pair) { return pair.incidence; });
  check.by_sea_share = Bands(pairs, rough, kShares, [](const CrossPair& pair) {
    return pair.variance_sea() / (pair.variance_sea() + pair.variance_air() + pair.variance_line());
  });
  return check;
}

annotate::FileProgress ProgressOver(const std::vector<AnnotatedLasFile>& files) {
  std::uint64_t bytes = 0;
  for (const AnnotatedLasFile& file : files) bytes += file.reader().file_size();
  return annotate::FileProgress("points", files.size(), bytes);
}

absl::Status NoBathymetricPoint(const std::vector<AnnotatedLasFile>& files) {
  return absl::FailedPreconditionError(
      absl::StrCat(files.front().path().parent_path().string(),
                   ": no file has a point of the bathymetric classes; give the outputs of albtpu-query las"));
}

absl::StatusOr<FileSeas> SeasOf(const std::vector<AnnotatedLasFile>& files, const annotate::SeaTimeline* seas) {
  FileSeas of;
  std::vector<SeaOfSource> known;
  for (const AnnotatedLasFile& file : files) {
    absl::StatusOr<SeaOfSource> sea = SeaOfFile(file, seas);
    if (!sea.ok()) {
      if (seas != nullptr) return sea.status();
      of.of_files.push_back(PulseOnWater::kNoSea);
      continue;
    }
    const auto same = std::ranges::find(known, *sea);
    of.of_files.push_back(static_cast<std::uint16_t>(same - known.begin()));
    if (same != known.end()) continue;
    of.waves.Add(*sea);
    known.push_back(*std::move(sea));
  }
  return of;
}

absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, const FileSeas& seas, OverlapPatches& patches,
                         const AnnotatedLasFile::Visit& also) {
  patches.Choose();
  annotate::FileProgress progress = ProgressOver(files);
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress.NextFile();
    const auto visit = [&](std::span<const AnnotatedPoint> points) {
      patches.Fill(points, seas.of_files[i]);
      if (also) also(points);
    };
    RETURN_IF_ERROR(files[i].ForEach(progress, visit).status());
  }
  return absl::OkStatus();
}

std::optional<CrossCheck> CheckPatches(OverlapPatches& patches, const SharedWaves& waves) {
  std::vector<Patch> taken = patches.Take();
  PatchPairs pairs;
  for (Patch& patch : taken) AppendPairs(patch, waves, pairs);
  std::optional<CrossCheck> check = CheckPairs(pairs, patches.side(), waves);
  if (!check.has_value()) return check;
  for (LineDifference& each : check->line.differences) {
    const FlightLine a = patches.lines().Line(static_cast<std::uint16_t>(each.line_a)),
                     b = patches.lines().Line(static_cast<std::uint16_t>(each.line_b));
    each.line_a = a.id, each.begin_a = a.begin;
    each.line_b = b.id, each.begin_b = b.begin;
  }
  return check;
}

absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch,
                                        const annotate::SeaTimeline* seas) {
  ASSIGN_OR_RETURN(const FileSeas of_files, SeasOf(files, seas));
  OverlapPatches patches(patch, files.front().metres_per_unit(), files.front().coverage());
  annotate::FileProgress progress = ProgressOver(files);
  std::uint64_t points = 0;
  LeftOutPoints left_out;
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    ASSIGN_OR_RETURN(const LeftOutPoints of_file, file.ForEach(progress, [&](std::span<const AnnotatedPoint> some) {
      points += some.size();
      patches.Find(some);
    }));
    left_out.Add(of_file);
  }
  if (points == 0) return NoBathymetricPoint(files);
  RETURN_IF_ERROR(FillPatches(files, of_files, patches));
  std::optional<CrossCheck> check = CheckPatches(patches, of_files.waves);
  if (!check.has_value()) {
    return absl::FailedPreconditionError(
        absl::StrCat(patches.lines().NothingToCompare(), "; give files of several lines over the same bottom"));
  }
  check->left_out = left_out;
  return *std::move(check);
}

}  // namespace albtpu::quality
