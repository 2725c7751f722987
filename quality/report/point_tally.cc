#include "quality/report/point_tally.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "budget/total/radius_factors.h"

namespace albtpu::quality {
namespace {

using nlohmann::ordered_json;

// The horizontal uncertainty at each coverage, m.
struct HorizontalUncertainty {
  explicit HorizontalUncertainty(const AnnotatedPoint& point) {
    const float mean = (point.variance_x + point.variance_y) / 2;
    const float split = std::hypot((point.variance_x - point.variance_y) / 2, point.covariance_xy);
    root_of_trace = std::sqrt(2 * mean);
    ratio = mean + split > 0 ? std::sqrt(std::clamp((mean - split) / (mean + split), 0.F, 1.F)) : 0;
  }
  double At(Coverage coverage) const {
    if (coverage == Coverage::kOneSigma) return root_of_trace;
    const double two_sigma = 2 * root_of_trace;
    return coverage == Coverage::kTwoSigma ? two_sigma : two_sigma * RadiusFactors::Get()(ratio);
  }
  float root_of_trace = 0, ratio = 0;
};

ordered_json SpreadJson(const annotate::LengthSpread& spread) {
  return {{"mean", spread.mean()},
          {"median", spread.quantile(0.5)},
          {"p95", spread.quantile(0.95)},
          {"greatest", spread.greatest()}};
}

}  // namespace

ClassJudge::ClassJudge(const std::vector<Specification>& specifications) {
  for (const Specification& each : specifications)
    classes_.insert(classes_.end(), each.classes.begin(), each.classes.end());
  assert(classes_.size() <= kMaxClasses);
}

std::uint64_t ClassJudge::Met(const AnnotatedPoint& point) const {
  if (!point.has_number) return 0;
  const HorizontalUncertainty horizontal(point);
  const double sigma_vertical = std::sqrt(point.variance_z);
  std::uint64_t met = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    const SpecificationClass& limits = classes_[i];
    const bool thu =
        !limits.horizontal.has_value() || horizontal.At(limits.coverage) + std::abs(point.bias_along_beam) <=
                                              limits.horizontal->At(point.depth);
    const bool tvu = !limits.vertical.has_value() ||
                     VerticalFactor(limits.coverage) * sigma_vertical + std::abs(point.bias_vertical) <=
                         limits.vertical->At(point.depth);
    met |= static_cast<std::uint64_t>(thu && tvu) << i;
  }
  return met;
}

std::array<double, 4> VerticalShares(const AnnotatedPoint& point, Coverage coverage) {
  const auto variance = [factor = VerticalFactor(coverage)](float tvu) { return std::pow(tvu / factor, 2); };
  const double air = variance(point.tvu_air), sea = variance(point.tvu_sea),
               water = variance(point.tvu_water);
  return {air, sea, water, std::max(point.variance_z - air - sea - water, 0.0)};
}

void PointTally::Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage) {
  ++points_;
  if (!point.has_number) return;
  thu_.Add(point.thu);
  tvu_.Add(point.tvu);
  const std::array<double, 4> shares = VerticalShares(point, coverage);
  for (std::size_t i = 0; i < shares.size(); ++i) shares_[i] += shares[i];
  const double factor = VerticalFactor(coverage);
  pulse_ += std::pow(point.tvu_pulse / factor, 2);
  line_ += std::pow(point.tvu_line / factor, 2);
  bias_vertical_ += point.bias_vertical;
  for (std::size_t i = 0; met >> i != 0; ++i) {
    met_[i] += met >> i & 1;
    if (i + 1 == ClassJudge::kMaxClasses) break;
  }
}

void PointTally::Merge(const PointTally& other) {
  points_ += other.points_;
  thu_.Merge(other.thu_);
  tvu_.Merge(other.tvu_);
  for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i] += other.shares_[i];
  pulse_ += other.pulse_;
  line_ += other.line_;
  bias_vertical_ += other.bias_vertical_;
  for (std::size_t i = 0; i < met_.size(); ++i) met_[i] += other.met_[i];
}

ordered_json PointTally::Json(std::size_t classes) const {
  ordered_json json = {{"points", points_}, {"with_number", with_number()}};
  if (with_number() > 0) {
    json["thu"] = SpreadJson(thu_);
    json["tvu"] = SpreadJson(tvu_);
    json["bias_vertical"] = bias_vertical_ / static_cast<double>(with_number());
    double total = 0;
    for (const double share : shares_) total += share;
    for (std::size_t i = 0; i < shares_.size(); ++i)
      json["shares_vertical"][kVerticalShareNames[i]] = total > 0 ? shares_[i] / total : 0;
    const auto of_total = [total](double sum) { return total > 0 ? sum / total : 0; };
    json["groups_vertical"] = {{"pulse", of_total(pulse_)},
                               {"line", of_total(line_)},
                               {"survey", std::max(of_total(total - pulse_ - line_), 0.0)}};
  }
  json["meeting"] =
      std::vector<std::uint64_t>(met_.begin(), met_.begin() + static_cast<std::ptrdiff_t>(classes));
  return json;
}

void DepthTallies::Add(const AnnotatedPoint& point, std::uint64_t met, Coverage coverage) {
  bins_[std::min(static_cast<std::size_t>(point.depth), bins_.size() - 1)].Add(point, met, coverage);
}

ordered_json DepthTallies::Json(std::size_t classes, const std::vector<int>& ends) const {
  ordered_json list = ordered_json::array();
  const auto end_after = [&](int begin) {
    const auto end = std::ranges::upper_bound(ends, begin);
    return ends.empty() ? begin + 1 : end != ends.end() ? std::min(*end, kBins) : kBins;
  };
  for (int begin = 0; begin < kBins; begin = end_after(begin)) {
    PointTally merged;
    const int end = end_after(begin);
    for (int i = begin; i < end; ++i) merged.Merge(bins_[static_cast<std::size_t>(i)]);
    if (merged.points() == 0) continue;
    ordered_json json = {{"from", begin}, {"to", nullptr}};
    if (end < kBins) json["to"] = end;
    json.update(merged.Json(classes));
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace albtpu::quality
