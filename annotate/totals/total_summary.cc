#include "annotate/totals/total_summary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/text/text.h"

namespace albtpu::annotate {
namespace {

using nlohmann::ordered_json;

// From 0.1 mm to 10 km in steps of 1 %.
constexpr double kLeastLength = 1e-4, kStep = 0.01;
constexpr std::size_t kBins = 1843;

std::size_t BinByLogarithm(float metres) {
  const double bin = std::log(std::max<double>(metres, kLeastLength) / kLeastLength) / kStep;
  return std::min(static_cast<std::size_t>(bin), kBins - 1);
}

// The bins of lengths without a logarithm each. Floats of one exponent and of equal first 8 bits of the mantissa differ
// by 0.4 % at most, so that they are of one bin or of two.
class LengthBins {
 public:
  LengthBins() {
    for (std::uint32_t i = 0; i < kGroups; ++i) {
      std::uint32_t begin = (kFirst + i) << kShift, end = begin + (1u << kShift);
      const std::size_t bin = BinByLogarithm(std::bit_cast<float>(begin));
      if (BinByLogarithm(std::bit_cast<float>(end - 1)) != bin) {
        while (end - begin > 1) {  // `begin` is of this bin, `end` is not.
          const std::uint32_t middle = begin + (end - begin) / 2;
          (BinByLogarithm(std::bit_cast<float>(middle)) == bin ? begin : end) = middle;
        }
      }
      groups_[i] = {end, static_cast<std::uint32_t>(bin)};
    }
  }

  std::size_t operator()(float metres) const {
    const auto bits = std::bit_cast<std::uint32_t>(metres >= kLeast ? std::min(metres, kMost) : kLeast);
    const Group& group = groups_[(bits >> kShift) - kFirst];
    return group.bin + (bits >= group.end ? 1 : 0);
  }

 private:
  struct Group {
    std::uint32_t end, bin;  // The bits of the first float that is not of the bin.
  };

  // A power of two below the first bin, and one above the last.
  static constexpr float kLeast = 0x1p-14f, kMost = 0x1p14f;
  static constexpr int kShift = std::numeric_limits<float>::digits - 1 - 8;
  static constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(kLeast) >> kShift;
  static constexpr std::size_t kGroups = (std::bit_cast<std::uint32_t>(kMost) >> kShift) - kFirst + 1;

  std::array<Group, kGroups> groups_;
};

ordered_json SpreadJson(const LengthSpread& spread) {
  return {{"mean", spread.mean()},
          {"median", spread.quantile(0.5)},
          {"percentile_95", spread.quantile(0.95)},
          {"greatest", formats::JsonNumber(spread.greatest())}};
}

}  // namespace

void LengthSpread::Add(float metres) {
  if (bins_.empty()) bins_.resize(kBins);
  static const LengthBins bins;
  ++bins_[bins(metres)];
  ++count_;
  sum_ += metres;
  greatest_ = std::max(greatest_, metres);
}

void LengthSpread::Merge(const LengthSpread& other) {
  if (other.count_ == 0) return;
  bins_.resize(kBins);
  for (std::size_t i = 0; i < kBins; ++i) bins_[i] += other.bins_[i];
  count_ += other.count_;
  sum_ += other.sum_;
  greatest_ = std::max(greatest_, other.greatest_);
}

double LengthSpread::quantile(double fraction) const {
  const double wanted = fraction * static_cast<double>(count_);
  double reached = 0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && reached + bins_[bin] < wanted) reached += bins_[bin++];
  return std::min<double>(kLeastLength * std::exp(kStep * (static_cast<double>(bin) + 0.5)), greatest_);
}

void TotalSummary::Add(const PulseBatch& pulses, const AnswerBatch& sea, const TotalBatch& totals) {
  for (std::size_t i = 0; i < totals.size(); ++i) Add(pulses, sea, totals, i);
}

void TotalSummary::Add(const PulseBatch& pulses, const AnswerBatch& sea, const TotalBatch& totals, std::size_t i) {
  if (!std::isfinite(totals.thu[i]) || !std::isfinite(totals.tvu[i])) return;
  const float depth = pulses.coordinate(AxisId::kDepth, i);
  Band& band = bands_[BandOf(depth)];
  band.thu.Add(totals.thu[i]);
  band.tvu.Add(totals.tvu[i]);
  band.air.Add(totals.air, i);
  band.sea.Add(totals.sea, i);
  if (!totals.of_water[2].empty()) band.water.Add(totals.of_water, i);
  band.extra.Merge({totals.extra_horizontal_variance, totals.extra_vertical_variance});
  for (std::size_t g = 0; g < kErrorGroups; ++g) {
    band.groups[g].Add(totals.groups[g], i);
    band.total.Add(totals.groups[g], i);
  }
  const auto bias = [&](Quantity quantity) {
    const float value = sea[quantity][i];
    return std::isfinite(value) ? value : 0;
  };
  band.bias_along_beam += bias(Quantity::kBiasAlongBeam);
  band.bias_vertical += bias(Quantity::kBiasVertical);
  ++band.best_orders[totals.best_orders[i]];
}

std::uint64_t TotalSummary::Band::Meeting(S44Order order) const {
  // A pulse that meets a stricter order meets this one, too: its limits are wider.
  std::uint64_t meeting = 0;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(order) + 1; ++i) meeting += best_orders[i];
  return meeting;
}

void TotalSummary::Band::Merge(const Band& other) {
  thu.Merge(other.thu);
  tvu.Merge(other.tvu);
  air.Merge(other.air);
  sea.Merge(other.sea);
  water.Merge(other.water);
  extra.Merge(other.extra);
  total.Merge(other.total);
  for (std::size_t g = 0; g < kErrorGroups; ++g) groups[g].Merge(other.groups[g]);
  bias_along_beam += other.bias_along_beam;
  bias_vertical += other.bias_vertical;
  for (std::size_t i = 0; i < best_orders.size(); ++i) best_orders[i] += other.best_orders[i];
}

void TotalSummary::Merge(const TotalSummary& other) {
  for (std::size_t i = 0; i < bands_.size(); ++i) bands_[i].Merge(other.bands_[i]);
  sources_.Merge(other.sources_);
}

std::string TotalSummary::Medians() const {
  const Band all = All();
  return absl::StrFormat("THU %.3f m, TVU %.3f m in the median", all.thu.quantile(0.5), all.tvu.quantile(0.5));
}

TotalSummary::Band TotalSummary::All() const {
  Band all;
  for (const Band& band : bands_) all.Merge(band);
  return all;
}

std::uint64_t TotalSummary::count() const {
  std::uint64_t count = 0;
  for (const Band& band : bands_) count += band.thu.count();
  return count;
}

ordered_json TotalSummary::Band::Json() const {
  ordered_json json = {{"pulses", thu.count()}, {"total_thu", SpreadJson(thu)}, {"total_tvu", SpreadJson(tvu)}};
  // Of the sums of variances over all pulses.
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
  const auto shares = [&](double Sums::*axis) {
    const double whole = total.*axis, datum = std::max(0.0, whole - air.*axis - sea.*axis - water.*axis - extra.*axis);
    return ordered_json{{"air", share(air.*axis, whole)},
                        {"sea", share(sea.*axis, whole)},
                        {"water", share(water.*axis, whole)},
                        {"datum", share(axis == &Sums::vertical ? datum : 0, whole)},
                        {"extra", share(extra.*axis, whole)}};
  };
  const auto pulses = static_cast<double>(thu.count());
  json["variance_horizontal"] = total.horizontal / pulses;  // Means, m^2.
  json["variance_vertical"] = total.vertical / pulses;
  json["shares_horizontal"] = shares(&Sums::horizontal);
  json["shares_vertical"] = shares(&Sums::vertical);
  for (std::size_t g = 0; g < kErrorGroups; ++g)
    json["groups_horizontal"][std::string(kErrorGroupNames[g])] = share(groups[g].horizontal, total.horizontal);
  for (std::size_t g = 0; g < kErrorGroups; ++g)
    json["groups_vertical"][std::string(kErrorGroupNames[g])] = share(groups[g].vertical, total.vertical);
  json["mean_bias_along_beam"] = bias_along_beam / pulses;
  json["mean_bias_vertical"] = bias_vertical / pulses;
  for (const S44Order order : kS44Orders) json["s44_met"][std::string(Name(order))] = Meeting(order);
  return json;
}

ordered_json TotalSummary::Json() const {
  ordered_json json;
  const Band all = All();
  json["pulses"] = all.thu.count();
  if (all.thu.count() == 0) return json;
  json["all"] = all.Json();
  if (sources_.samples > 0) json["sources"] = sources_.Json();
  ordered_json& bands = json["depth_bands"] = ordered_json::array();
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    if (bands_[i].thu.count() == 0) continue;
    ordered_json band = BandJson(i);
    band.update(bands_[i].Json());
    bands.push_back(std::move(band));
  }
  return json;
}

std::string TotalSummary::Text(Coverage coverage, S44Order order) const {
  const std::string at = CoverageText(coverage);
  const Band all = All();
  const bool extra = all.extra.vertical > 0 || all.extra.horizontal > 0;  // Shown where there is something in it.
  // Contributions to the variance in %; the sensor with its trajectory. Nothing of the datum is horizontal.
  const char* const of_horizontal = extra ? "sensor  sea water extra" : "sensor  sea water";
  const char* const of_vertical = extra ? "sensor  sea water datum extra" : "sensor  sea water datum";
  const auto width = [](const char* head) { return static_cast<int>(std::string_view(head).size()); };
  std::string text =
      absl::StrFormat("\n  %9s %9s %17s %17s | %*s | %*s | %13s %8s", "depth", "points", absl::StrCat("THU, ", at),
                      absl::StrCat("TVU, ", at), width(of_horizontal), "horizontal, %", width(of_vertical),
                      "vertical, %", "mean bias, m", absl::StrCat("S-44 ", std::string(Name(order))));
  absl::StrAppendFormat(&text, "\n  %9s %9s %8s %8s %8s %8s | %s | %s | %6s %6s %8s", "m", "", "median m", "95 % m",
                        "median m", "95 % m", of_horizontal, of_vertical, "along", "up", "met");
  const auto contributions = [&](const Band& band, double Sums::*axis) {
    const double whole = band.total.*axis > 0 ? band.total.*axis : 1;
    const double air = band.air.*axis / whole, sea = band.sea.*axis / whole, water = band.water.*axis / whole;
    const double added = band.extra.*axis / whole;
    std::string shares = absl::StrFormat("%6.0f %4.0f %5.0f", 100 * air, 100 * sea, 100 * water);
    if (axis == &Sums::vertical)
      absl::StrAppendFormat(&shares, " %5.0f", 100 * std::max(0.0, 1 - air - sea - water - added));
    if (extra) absl::StrAppendFormat(&shares, " %5.0f", 100 * added);
    return shares;
  };
  const auto line = [&](const std::string& name, const Band& band) {
    const auto count = static_cast<double>(band.thu.count());
    absl::StrAppendFormat(&text, "\n  %9s %9d %8.3f %8.3f %8.3f %8.3f | %s | %s | %+6.3f %+6.3f %6.1f %%", name,
                          band.thu.count(), band.thu.quantile(0.5), band.thu.quantile(0.95), band.tvu.quantile(0.5),
                          band.tvu.quantile(0.95), contributions(band, &Sums::horizontal),
                          contributions(band, &Sums::vertical), band.bias_along_beam / count,
                          band.bias_vertical / count, 100 * static_cast<double>(band.Meeting(order)) / count);
  };
  for (std::size_t i = 0; i < bands_.size(); ++i)
    if (bands_[i].thu.count() > 0) line(BandText(i), bands_[i]);
  if (all.thu.count() > 0) line("all", all);
  return text;
}

void DrySummary::Add(const TotalBatch& totals, std::size_t i) {
  if (!std::isfinite(totals.thu[i]) || !std::isfinite(totals.tvu[i])) return;
  thu_.Add(totals.thu[i]);
  tvu_.Add(totals.tvu[i]);
  for (std::size_t g = 0; g < kErrorGroups; ++g) {
    const TotalBatch::Covariance& group = totals.groups[g];
    horizontal_[g] += static_cast<double>(group[0][i]) + group[1][i];
    vertical_ += group[2][i];
  }
}

void DrySummary::Merge(const DrySummary& other) {
  thu_.Merge(other.thu_);
  tvu_.Merge(other.tvu_);
  for (std::size_t g = 0; g < kErrorGroups; ++g) horizontal_[g] += other.horizontal_[g];
  vertical_ += other.vertical_;
}

double DrySummary::horizontal() const { return std::accumulate(horizontal_.begin(), horizontal_.end(), 0.0); }

std::string DrySummary::Text(Coverage coverage) const {
  if (count() == 0) return "";
  const auto points = static_cast<double>(count());
  return absl::StrFormat(
      "%d dry points (%s): total THU %.3f m in the median, %.3f m at most; total TVU %.3f m, %.3f m; RMSE %.3f m "
      "horizontal, %.3f m vertical",
      count(), CoverageText(coverage), thu_.quantile(0.5), thu_.greatest(), tvu_.quantile(0.5), tvu_.greatest(),
      std::sqrt(horizontal() / points), std::sqrt(vertical_ / points));
}

ordered_json DrySummary::Json() const {
  const auto points = static_cast<double>(count());
  ordered_json json = {{"points", count()}};
  if (count() == 0) return json;
  json["total_thu"] = SpreadJson(thu_);
  json["total_tvu"] = SpreadJson(tvu_);
  json["rmse_horizontal"] = std::sqrt(horizontal() / points);
  json["rmse_vertical"] = std::sqrt(vertical_ / points);
  const double whole = horizontal();
  for (std::size_t g = 0; g < kErrorGroups; ++g)
    json["groups_horizontal"][std::string(kErrorGroupNames[g])] = whole > 0 ? horizontal_[g] / whole : 0.0;
  return json;
}

ordered_json WithTotal(ordered_json answers, const TotalPlan& plan, const TotalSummary& totals,
                       const std::map<int, TotalSummary>& lines) {
  for (const char* const of_sea : {"s44_best_order", "depth_bands"}) {
    if (!answers.contains(of_sea)) continue;
    answers["sea_surface"][of_sea] = std::move(answers[of_sea]);
    answers.erase(of_sea);
  }
  ordered_json& total = answers["total"] = totals.Json();
  total["coverage"] = CoverageName(plan.options.coverage);
  total["assumed"] = Assumptions(plan);
  for (const auto& [line, summary] : lines) total["lines"][absl::StrCat(line)] = summary.Json();
  return answers;
}

}  // namespace albtpu::annotate
