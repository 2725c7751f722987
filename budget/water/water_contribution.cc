#include "budget/water/water_contribution.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "absl/strings/str_cat.h"
#include "budget/water/water_draws.h"
#include "budget/water/water_lookup.h"

namespace albtpu {
namespace {

constexpr double kIncidenceStep = 1.5;  // degree
constexpr std::size_t kDepths = 65;     // even in the root of the depth
constexpr double kFootprintsInView = 2.5;
const double kSigmaOfWidth = 1 / (2 * std::sqrt(2 * std::log(2.0)));
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Whether the table covers the waters.
absl::Status CheckOptics(const WaterColumnTable& table, const WaterOptics& optics) {
  const auto [least, most] = table.Range(WaterAxis::kBackscatterFraction);
  // The ends of the table are floats.
  if (optics.least_fraction < least * (1 - 1e-6) || optics.most_fraction > most * (1 + 1e-6)) {
    return absl::InvalidArgumentError(
        absl::StrCat("backscatter_fraction is outside the table of the water column; give ", static_cast<float>(least),
                     " to ", static_cast<float>(most)));
  }
  const double greatest = table.Range(WaterAxis::kScatteringOverAbsorption).second;
  if (optics.scattering_over_absorption <= greatest) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("the water scatters ", optics.scattering_over_absorption,
                   " times as much as it absorbs, which is outside the table of the water column; give at most ",
                   greatest, ", an albedo of ", greatest / (1 + greatest)));
}

absl::Status CheckTreatment(const BiasTreatment& treatment, double greatest_depth) {
  if (treatment.handling == BiasHandling::kVendor &&
      !(treatment.residual_fraction >= 0 && treatment.residual_fraction <= 1))
    return absl::InvalidArgumentError(absl::StrCat("residual_fraction ", treatment.residual_fraction,
                                                   " is no fraction; give 0 (nothing remains) to 1 (all does)"));
  if (treatment.handling != BiasHandling::kCalibrated) return absl::OkStatus();
  if (!(treatment.calibration_depth > 0 && treatment.calibration_depth <= greatest_depth))
    return absl::InvalidArgumentError(absl::StrCat("the calibration at ", treatment.calibration_depth,
                                                   " m is beyond the table; give a depth above 0, up to ",
                                                   greatest_depth, " m"));
  return absl::OkStatus();
}

// Mean and covariance of the vertical and the along part.
struct Moments {
  double vertical = 0, along = 0, vertical2 = 0, along2 = 0, both = 0;
  double count = 0;

  void Add(double v, double a) {
    vertical += v;
    along += a;
    vertical2 += v * v;
    along2 += a * a;
    both += v * a;
    ++count;
  }
  double mean_vertical() const { return vertical / count; }
  double mean_along() const { return along / count; }
  double variance_vertical() const { return std::max(0.0, vertical2 / count - mean_vertical() * mean_vertical()); }
  double variance_along() const { return std::max(0.0, along2 / count - mean_along() * mean_along()); }
  double covariance() const { return both / count - mean_vertical() * mean_along(); }
};

double QuantileOf(std::vector<double>& values, double fraction) {
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto lower = static_cast<std::size_t>(place);
  std::sort(values.begin(), values.end());
  const double part = place - static_cast<double>(lower);
  return values[lower] * (1 - part) + values[std::min(lower + 1, values.size() - 1)] * part;
}

// The waters that return an echo at one incidence and depth.
struct WatersThere {
  Moments before, scaled;  // by a calibration
  Looked sums;
  std::vector<double> verticals;

  void Add(const Looked& looked, double scale) {
    before.Add(looked.vertical, looked.along);
    scaled.Add(scale * looked.vertical, scale * looked.along);
    verticals.push_back(looked.vertical);
    sums.spot += looked.spot;
    sums.stretch += looked.stretch;
    sums.energy += looked.energy;
  }
};

}  // namespace

absl::StatusOr<WaterContribution> WaterContribution::Create(const WaterColumnTable& table, const WaterOptics& optics,
                                                            const WaterReceiver& receiver,
                                                            const BiasTreatment& treatment) {
  if (absl::Status status = CheckOptics(table, optics); !status.ok()) return status;
  WaterContribution contribution;
  contribution.receiver_ = receiver;
  contribution.max_incidence_ = table.Range(WaterAxis::kIncidence).second;
  contribution.max_footprint_ = receiver.field_of_view / kFootprintsInView;
  const double by_turbidity =
      table.Range(WaterAxis::kOpticalDepth).second / (optics.attenuation * std::exp(optics.attenuation_log_sigma));
  const double by_view = receiver.field_of_view / table.Range(WaterAxis::kFieldOfView).first;
  const double by_pulse =
      PulseLengthOverDepth(receiver.pulse_length, table.Range(WaterAxis::kPulseLength).first, receiver.group_index);
  contribution.max_depth_ = std::min({by_turbidity, by_view, by_pulse});
  if (!(contribution.max_depth_ > 0)) {
    return absl::InvalidArgumentError(
        "a field of view and a pulse above 0 are needed; give field_of_view in m and pulse_length in ns");
  }
  WaterOptics within = optics;
  within.max_ratio = std::min(within.max_ratio, table.Range(WaterAxis::kScatteringOverAbsorption).second);
  contribution.beyond_table_ = ShareBeyond(optics, within.max_ratio);
  const std::vector<DrawnWater> draws = DrawWaters(within, kDraws);
  std::vector<WaterLookup> lookups;
  lookups.reserve(draws.size());
  for (const DrawnWater& draw : draws) lookups.emplace_back(table, receiver, draw);
  // The point was reported, so only waters that return an echo count. At the largest depth, half of the draws do.
  const auto sees = [&](double depth) {
    const auto seeing = std::count_if(lookups.begin(), lookups.end(), [&](const WaterLookup& lookup) {
      return lookup.At(depth).At(0).energy >= kMinEchoEnergy;
    });
    return 2 * static_cast<std::size_t>(seeing) >= lookups.size();
  };
  if (!sees(contribution.max_depth_)) {
    double seen = 0;
    for (int step = 0; step < 30; ++step) {
      const double middle = (seen + contribution.max_depth_) / 2;
      (sees(middle) ? seen : contribution.max_depth_) = middle;
    }
  }
  if (absl::Status status = CheckTreatment(treatment, contribution.max_depth_); !status.ok()) return status;
  const double first = table.Range(WaterAxis::kIncidence).first;
  contribution.incidences_ = static_cast<std::size_t>((contribution.max_incidence_ - first) / kIncidenceStep) + 1;
  contribution.incidence_step_ = contribution.incidences_ > 1 ? (contribution.max_incidence_ - first) /
                                                                    static_cast<double>(contribution.incidences_ - 1)
                                                              : 1;
  contribution.nodes_.resize(contribution.incidences_ * kDepths);
  std::vector<double> incidences(contribution.incidences_);
  for (std::size_t i = 0; i < incidences.size(); ++i)
    incidences[i] =
        std::min(first + static_cast<double>(i) * contribution.incidence_step_, contribution.max_incidence_);
  const CalibratedWaters calibrated(lookups, incidences, treatment);
  if (calibrated.disagree()) {
    return absl::InvalidArgumentError(absl::StrCat("a calibration at ", treatment.calibration_depth,
                                                   " m cannot be scaled (there the bias passes through zero, "
                                                   "with other signs in other waters); calibrate at "
                                                   "another depth, or by another detector"));
  }
  tbb::parallel_for(std::size_t{0}, kDepths, [&](std::size_t k) {
    const double root = std::max(0.25, static_cast<double>(k)) / static_cast<double>(kDepths - 1);
    const double depth = contribution.max_depth_ * root * root;
    std::vector<WatersThere> there(incidences.size());
    for (std::size_t j = 0; j < lookups.size(); ++j) {
      const WaterAtDepth water = lookups[j].At(depth);
      for (std::size_t i = 0; i < incidences.size(); ++i) {
        const Looked looked = water.At(incidences[i]);
        if (looked.energy >= kMinEchoEnergy) there[i].Add(looked, calibrated.scale(i, j));
      }
    }
    for (std::size_t i = 0; i < incidences.size(); ++i) {
      auto& [before, scaled, sums, verticals] = there[i];
      std::array<double, kNumbers> node = {};
      if (verticals.empty()) {
        for (std::size_t n = 0; n < kNumbers; ++n) contribution.nodes_[i * kDepths + k][n] = static_cast<float>(kNan);
        continue;
      }
      node[kMeanVertical] = before.mean_vertical();
      node[kMeanAlong] = before.mean_along();
      node[kVarianceVertical] = node[kLeftVertical] = before.variance_vertical();
      node[kVarianceAlong] = node[kLeftAlong] = before.variance_along();
      node[kCovariance] = node[kLeftCovariance] = before.covariance();
      node[kLow] = QuantileOf(verticals, 0.025);
      node[kHigh] = QuantileOf(verticals, 0.975);
      node[kSpot] = sums.spot / before.count;
      node[kStretch] = sums.stretch / before.count;
      node[kEnergy] = sums.energy / before.count;
      switch (treatment.handling) {
        case BiasHandling::kNone:
          node[kBiasVertical] = node[kMeanVertical];
          node[kBiasAlong] = node[kMeanAlong];
          break;
        case BiasHandling::kCorrect:
          break;
        case BiasHandling::kVendor: {
          const double f2 = treatment.residual_fraction * treatment.residual_fraction;
          node[kLeftVertical] = f2 * before.vertical2 / before.count;
          node[kLeftAlong] = f2 * before.along2 / before.count;
          node[kLeftCovariance] = f2 * before.both / before.count;
          break;
        }
        case BiasHandling::kCalibrated: {
          const double v = calibrated.noise(i) * before.mean_vertical(), a = calibrated.noise(i) * before.mean_along();
          node[kLeftVertical] = scaled.variance_vertical() + v * v;
          node[kLeftAlong] = scaled.variance_along() + a * a;
          node[kLeftCovariance] = scaled.covariance() + v * a;
          break;
        }
      }
      Node& kept = contribution.nodes_[i * kDepths + k];
      for (std::size_t n = 0; n < kNumbers; ++n) kept[n] = static_cast<float>(node[n]);
    }
  });
  return contribution;
}

WaterContribution::Node WaterContribution::Blend(double incidence, double depth) const {
  const double x =
      incidences_ > 1
          ? std::clamp((incidence - (max_incidence_ - incidence_step_ * static_cast<double>(incidences_ - 1))) /
                           incidence_step_,
                       0.0, static_cast<double>(incidences_ - 1))
          : 0;
  const double y = std::sqrt(std::min(1.0, depth / max_depth_)) * static_cast<double>(kDepths - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), std::max<std::size_t>(incidences_, 2) - 2);
  const std::size_t k = std::min(static_cast<std::size_t>(y), kDepths - 2);
  const auto u = static_cast<float>(x - static_cast<double>(i)), v = static_cast<float>(y - static_cast<double>(k));
  const std::size_t next = incidences_ > 1 ? kDepths : 0;
  const Node* const corner = nodes_.data() + i * kDepths + k;
  Node blend;
  for (std::size_t n = 0; n < kNumbers; ++n) {
    const float near = corner[0][n] + v * (corner[1][n] - corner[0][n]);
    const float far = corner[next][n] + v * (corner[next + 1][n] - corner[next][n]);
    blend[n] = near + u * (far - near);
  }
  return blend;
}

std::optional<WaterAnswerOfSurvey> WaterContribution::At(double incidence, double depth) const {
  if (!(incidence >= 0 && incidence <= max_incidence_ && depth >= 0 && depth <= max_depth_)) return std::nullopt;
  const Node node = Blend(incidence, depth);
  const auto root = [&](Number n) { return depth * std::sqrt(std::max(0.0f, node[n])); };
  WaterAnswerOfSurvey answer{.mean_vertical = depth * node[kMeanVertical],
                             .sigma_vertical = root(kVarianceVertical),
                             .low_vertical = depth * node[kLow],
                             .high_vertical = depth * node[kHigh],
                             .mean_along = depth * node[kMeanAlong],
                             .sigma_along = root(kVarianceAlong),
                             .spot = depth * node[kSpot],
                             .stretch = node[kStretch],
                             .energy = node[kEnergy],
                             .bias_vertical = depth * node[kBiasVertical],
                             .bias_along = depth * node[kBiasAlong],
                             .left_vertical = root(kLeftVertical),
                             .left_along = root(kLeftAlong)};
  const float product = std::sqrt(node[kLeftVertical] * node[kLeftAlong]);
  answer.correlation = product > 0 ? std::clamp(node[kLeftCovariance] / product, -1.0f, 1.0f) : 0;
  return answer;
}

void WaterContribution::Compute(std::span<const float> incidence, std::span<const float> depth,
                                const WaterColumns& columns) const {
  const std::size_t size = std::max(
      {incidence.size(), depth.size(), columns.bias_along.size(), columns.bias_vertical.size(),
       columns.sigma_along.size(), columns.sigma_vertical.size(), columns.correlation.size(), columns.stretch.size()});
  const auto put = [](std::span<float> column, std::size_t i, double value) {
    if (!column.empty()) column[i] = static_cast<float>(value);
  };
  for (std::size_t i = 0; i < size; ++i) {
    const double theta = incidence[incidence.size() == 1 ? 0 : i], z = depth[depth.size() == 1 ? 0 : i];
    const bool known = theta >= 0 && theta <= max_incidence_ && z >= 0 && z <= max_depth_;
    const Node node = Blend(known ? theta : 0, known ? z : 0);
    const double length = known ? z : kNan;
    put(columns.bias_vertical, i, length * node[kBiasVertical]);
    put(columns.bias_along, i, length * node[kBiasAlong]);
    const float vertical = std::sqrt(std::max(0.0f, node[kLeftVertical])),
                along = std::sqrt(std::max(0.0f, node[kLeftAlong]));
    put(columns.sigma_vertical, i, length * vertical);
    put(columns.sigma_along, i, length * along);
    const float product = vertical * along;
    put(columns.correlation, i, product > 0 ? std::clamp(node[kLeftCovariance] / product, -1.0f, 1.0f) : 0);
    put(columns.stretch, i, node[kStretch]);
  }
}

double WaterContribution::PhotonNoise(double photons, double stretch, double cosine_refracted) const {
  const double sigma_time = receiver_.pulse_length * stretch * kSigmaOfWidth;
  return cosine_refracted * kLightSpeed * sigma_time / (2 * receiver_.group_index * std::sqrt(photons));
}

}  // namespace albtpu
