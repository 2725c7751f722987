#include "quality/crosscheck/cross_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <tuple>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "sea/samples.h"
#include "status/status_macros.h"

namespace albtpu::quality {
namespace {

constexpr double kMedianOfNormal = 0.6744897501960817;  // Of the magnitude of a standard normal number.

double MedianFactor(const std::vector<CrossPair>& pairs, double rough) {
  std::vector<double> ratios;
  for (const CrossPair& pair : pairs)
    ratios.push_back(std::abs(pair.difference) / std::sqrt(PredictedVariance(pair, rough)));
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
      band.chi_square += std::pow(pair.difference, 2) / PredictedVariance(pair, rough);
    }
  }
  std::erase_if(bands, [](const CrossBand& band) { return band.pairs == 0; });
  for (CrossBand& band : bands) band.chi_square /= static_cast<double>(band.pairs);
  return bands;
}

std::vector<LineDifference> DifferencesOfLines(const std::vector<CrossPair>& pairs) {
  struct Mean {
    double sum = 0;
    std::size_t count = 0;
  };
  std::map<std::pair<int, int>, std::map<Place, Mean>> lines;
  for (const CrossPair& pair : pairs) {
    Mean& mean = lines[{pair.line_a, pair.line_b}][PlaceOf(pair)];
    mean.sum += pair.difference;
    ++mean.count;
  }
  std::vector<LineDifference> list;
  for (const auto& [names, stretches] : lines) {
    LineDifference line{.line_a = names.first, .line_b = names.second};
    for (const auto& [place, mean] : stretches) line.mean += mean.sum, line.pairs += mean.count;
    const auto count = static_cast<double>(line.pairs);
    line.mean /= count;
    double squares = 0;  // Of what each stretch adds to the mean.
    for (const auto& [place, mean] : stretches)
      squares += std::pow((mean.sum - line.mean * static_cast<double>(mean.count)) / count, 2);
    const auto n = static_cast<double>(stretches.size());
    line.standard_error = n > 1 ? std::sqrt(squares * n / (n - 1)) : std::numeric_limits<double>::quiet_NaN();
    list.push_back(line);
  }
  std::ranges::stable_sort(list, std::ranges::greater(),
                           [](const LineDifference& line) { return std::abs(line.mean); });
  return list;
}

void NameGuilty(const std::vector<CrossPair>& pairs, const VarianceFit& fit, CrossCheck& check) {
  double air = 0, sea = 0;
  for (const CrossPair& pair : pairs) air += pair.variance_air, sea += pair.variance_sea;
  check.air_in_variance = air / (air + sea);
  double most = 0;
  for (const auto& [name, factor, differs, variance] :
       {std::tuple{"air", fit.air, fit.air_differs, air}, std::tuple{"sea", fit.sea, fit.sea_differs, sea}}) {
    const double explained = std::abs(std::pow(factor.value, 2) - 1) * variance;
    if (!differs || std::abs(factor.value - 1) < kMinDifference || explained <= most) continue;
    check.guilty = name;
    most = explained;
  }
}

nlohmann::ordered_json EstimateJson(const Estimate& estimate) {
  nlohmann::ordered_json json = {{"value", estimate.value}, {"low", nullptr}, {"high", nullptr}};
  if (std::isfinite(estimate.high)) json["low"] = estimate.low, json["high"] = estimate.high;
  return json;
}

nlohmann::ordered_json BandsJson(const std::vector<CrossBand>& bands) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CrossBand& band : bands) {
    list.push_back({{"from", band.from}, {"to", nullptr}, {"pairs", band.pairs}, {"chi_square", band.chi_square}});
    if (std::isfinite(band.to)) list.back()["to"] = band.to;
  }
  return list;
}

}  // namespace

std::optional<CrossCheck> CheckPairs(std::vector<CrossPair>& pairs) {
  if (pairs.empty()) return std::nullopt;
  CrossCheck check;
  check.median_factor = MedianFactor(pairs, 0);
  const double most = kOutlier * std::max(check.median_factor, 1.0);
  const std::size_t before = pairs.size();
  std::erase_if(
      pairs, [most](const CrossPair& pair) { return std::abs(pair.difference) > most * std::sqrt(pair.variance()); });
  check.outliers = before - pairs.size();
  check.pairs = pairs.size();
  const VarianceFit fit = FitVariance(pairs, check.median_factor);
  const double rough = fit.rough;
  check.factor = fit.factor;
  check.factor_air = fit.air;
  check.factor_sea = fit.sea;
  check.interval_units = fit.units;
  check.roughness = std::sqrt(rough);
  NameGuilty(pairs, fit, check);
  check.median_factor = MedianFactor(pairs, rough);
  check.lines = DifferencesOfLines(pairs);
  std::map<std::pair<int, int>, double> means;
  for (const LineDifference& line : check.lines) means[{line.line_a, line.line_b}] = line.mean;
  const auto count = static_cast<double>(pairs.size());
  for (const CrossPair& pair : pairs) {
    const double variance = PredictedVariance(pair, rough);
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
    return pair.variance_sea / (pair.variance_sea + pair.variance_air);
  });
  return check;
}

nlohmann::ordered_json CrossCheckJson(const CrossCheck& check) {
  nlohmann::ordered_json json = {{"pairs", check.pairs},
                                 {"outliers", check.outliers},
                                 {"chi_square", check.chi_square},
                                 {"chi_square_within_lines", check.chi_square_within_lines},
                                 {"beyond_three_sigma", check.beyond_three_sigma},
                                 {"median_factor", check.median_factor},
                                 {"factor", EstimateJson(check.factor)},
                                 {"factor_air", EstimateJson(check.factor_air)},
                                 {"factor_sea", EstimateJson(check.factor_sea)},
                                 {"intervals_by", check.interval_units},
                                 {"air_in_variance", check.air_in_variance},
                                 {"roughness", check.roughness},
                                 {"guilty_share", nullptr},
                                 {"by_depth", BandsJson(check.by_depth)},
                                 {"by_incidence", BandsJson(check.by_incidence)},
                                 {"by_share_of_sea", BandsJson(check.by_sea_share)},
                                 {"lines", nlohmann::ordered_json::array()}};
  if (!check.guilty.empty()) json["guilty_share"] = check.guilty;
  if (!check.left_out.empty()) json["left_out"] = LeftOutJson(check.left_out);
  for (const LineDifference& line : check.lines) {
    json["lines"].push_back({{"a", line.line_a},
                             {"b", line.line_b},
                             {"pairs", line.pairs},
                             {"mean_difference", line.mean},
                             {"standard_error", nullptr}});
    if (std::isfinite(line.begin_a)) json["lines"].back()["a_begin"] = line.begin_a;
    if (std::isfinite(line.begin_b)) json["lines"].back()["b_begin"] = line.begin_b;
    if (std::isfinite(line.standard_error)) json["lines"].back()["standard_error"] = line.standard_error;
  }
  return json;
}

std::string CrossCheckText(const CrossCheck& check) {
  const auto estimate = [](const Estimate& e) {
    if (!std::isfinite(e.high)) return absl::StrFormat("%.2f (one place gives no interval)", e.value);
    return absl::StrFormat("%.2f (95 %%: %.2f to %.2f)", e.value, e.low, e.high);
  };
  std::string text = absl::StrFormat(
      "%d pairs of neighbouring points of different lines, %d outliers left out\n"
      "reduced chi-square                  %.2f; without the mean difference of each two lines %.2f\n"
      "predicted sigma would have to be    %s times as large\n"
      "  of the air side, %2.0f %% of it      %s\n"
      "  of the sea surface                %s\n",
      check.pairs, check.outliers, check.chi_square, check.chi_square_within_lines, estimate(check.factor),
      100 * check.air_in_variance, estimate(check.factor_air), estimate(check.factor_sea));
  if (check.guilty.empty()) {
    absl::StrAppendFormat(&text, "no share differs from its prediction by %.0f %% and beyond its interval\n",
                          100 * kMinDifference);
  } else {
    absl::StrAppend(&text, "the share that differs most from its prediction: ", check.guilty, "\n");
  }
  if (!check.left_out.empty()) absl::StrAppend(&text, LeftOutText(check.left_out), "\n");
  constexpr std::size_t kShown = 5;
  for (std::size_t i = 0; i < std::min(kShown, check.lines.size()); ++i) {
    const LineDifference& line = check.lines[i];
    const std::string error = std::isfinite(line.standard_error) ? absl::StrFormat("%.3f m", line.standard_error)
                                                                 : "not known from one place";
    absl::StrAppendFormat(&text, "%s lies %+.3f m above %s (standard error %s, %d pairs)\n",
                          NameOf(FlightLine{line.line_a, line.begin_a}), line.mean,
                          NameOf(FlightLine{line.line_b, line.begin_b}), error, line.pairs);
  }
  return text;
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

absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, OverlapPatches& patches) {
  patches.Choose();
  annotate::FileProgress progress = ProgressOver(files);
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    RETURN_IF_ERROR(
        file.ForEach(progress, [&](std::span<const AnnotatedPoint> points) { patches.Fill(points); }).status());
  }
  return absl::OkStatus();
}

std::optional<CrossCheck> CheckPatches(OverlapPatches& patches) {
  std::vector<Patch> taken = patches.Take();
  std::vector<CrossPair> pairs;
  for (Patch& patch : taken) AppendPairs(patch, pairs);
  std::optional<CrossCheck> check = CheckPairs(pairs);
  if (!check.has_value()) return check;
  for (LineDifference& each : check->lines) {
    const FlightLine a = patches.lines().Line(static_cast<std::uint16_t>(each.line_a)),
                     b = patches.lines().Line(static_cast<std::uint16_t>(each.line_b));
    each.line_a = a.id, each.begin_a = a.begin;
    each.line_b = b.id, each.begin_b = b.begin;
  }
  return check;
}

absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch) {
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
  RETURN_IF_ERROR(FillPatches(files, patches));
  std::optional<CrossCheck> check = CheckPatches(patches);
  if (!check.has_value()) {
    return absl::FailedPreconditionError(
        absl::StrCat(patches.lines().NothingToCompare(), "; give files of several lines over the same bottom"));
  }
  check->left_out = left_out;
  return *std::move(check);
}

}  // namespace albtpu::quality
