#include "annotate/totals/source_sums.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "annotate/totals/pulse_totals.h"
#include "budget/air/air_sources.h"

namespace albtpu::annotate {
namespace {

bool IsAssumed(const TotalPlan& plan, std::string_view name) {
  const auto found = std::ranges::find(plan.numbers, name, &StatedNumber::name);
  return found != plan.numbers.end() && found->assumed;
}

// Of its uncertainty; the other numbers are those of its geometry.
bool IsWaterAssumed(const TotalPlan& plan) {
  return IsAssumed(plan, "water_attenuation_sigma") || IsAssumed(plan, "water_albedo") ||
         IsAssumed(plan, "water_backscatter_fraction");
}

AxisVariances SumOf(const TotalBatch::Covariance& covariance, std::size_t i) {
  if (covariance[2].empty()) return {};
  return {.horizontal = static_cast<double>(covariance[0][i]) + covariance[1][i], .vertical = covariance[2][i]};
}

// The numbers of one pulse in the columns of a batch.
class PulseOf {
 public:
  PulseOf(const TotalPlan& plan, const PulseBatch& pulses, const AircraftColumns& aircraft, std::size_t i)
      : plan_(plan), pulses_(pulses), aircraft_(aircraft), i_(i) {}

  AirPulse pulse() const {
    const auto number = [this](BudgetInput input) { return At(input, 0); };
    const auto vector = [&](BudgetInput first) {
      return Eigen::Vector3d(number(first), number(first + 1), number(first + 2));
    };
    return {.incidence = pulses_.coordinate(AxisId::kIncidence, i_),
            .beam_azimuth = number(BudgetInput::kBeamAzimuth),
            .altitude = number(BudgetInput::kAltitude),
            .depth = pulses_.coordinate(AxisId::kDepth, i_),
            .roll = number(BudgetInput::kRoll),
            .pitch = number(BudgetInput::kPitch),
            .heading = number(BudgetInput::kHeading),
            .velocity = vector(BudgetInput::kVelocityNorth),
            .rates = vector(BudgetInput::kRollRate),
            .lever_arm = Eigen::Vector3d(plan_.options.lever_arm.data()),
            .index = plan_.options.index};
  }

  AirErrors errors() const {
    AirErrors errors = plan_.options.errors;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      errors.position[axis] = At(BudgetInput::kPositionSigmaNorth + axis, errors.position[axis]);
      errors.attitude[axis] = At(BudgetInput::kRollSigma + axis, errors.attitude[axis]);
    }
    return errors;
  }

 private:
  double At(BudgetInput input, double absent) const {
    const std::vector<float>& column = aircraft_[input];
    const double value = column.empty() ? absent : column[column.size() == 1 ? 0 : i_];
    return std::isfinite(value) ? value : absent;
  }

  const TotalPlan& plan_;
  const PulseBatch& pulses_;
  const AircraftColumns& aircraft_;
  std::size_t i_;
};

}  // namespace

void SourceSums::Merge(const SourceSums& other) {
  samples += other.samples;
  for (std::size_t i = 0; i < sources.size(); ++i) sources[i].Add(other.sources[i]);
  assumed.Add(other.assumed);
  total.Add(other.total);
}

nlohmann::ordered_json SourceSums::Json() const {
  const auto fractions = [this](const AxisVariances& of) {
    const auto fraction = [](double part, double whole) { return whole > 0 ? part / whole : 0.0; };
    return nlohmann::ordered_json{{"horizontal", fraction(of.horizontal, total.horizontal)},
                                  {"vertical", fraction(of.vertical, total.vertical)}};
  };
  nlohmann::ordered_json json = {{"samples", samples},
                                 {"variance_horizontal", total.horizontal},
                                 {"variance_vertical", total.vertical},
                                 {"assumed", fractions(assumed)}};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].horizontal <= 0 && sources[i].vertical <= 0) continue;
    const std::string_view name =
        i < kErrorSourceCount ? kErrorSources[i].name : kOtherSourceNames[i - kErrorSourceCount];
    json["sources"][std::string(name)] = fractions(sources[i]);
  }
  return json;
}

SourceSums SampleSources(const TotalPlan& plan, const PulseBatch& pulses, const AircraftColumns& aircraft,
                         const TotalBatch& totals, std::size_t samples) {
  SourceSums sums;
  std::array<double, kErrorSourceCount> assumed = {};
  const std::size_t size = totals.size();
  for (std::size_t i = 0; i < kErrorSourceCount; ++i) assumed[i] = IsAssumed(plan, kErrorSources[i].name) ? 1 : 0;
  const double without_sigmas = static_cast<double>(totals.sigmas_assumed) / static_cast<double>(size);
  if (plan.position_by_pulse) assumed[Index(&AirErrors::position)] = without_sigmas;
  if (plan.attitude_by_pulse) assumed[Index(&AirErrors::attitude)] = without_sigmas;
  const bool water_assumed = IsWaterAssumed(plan);
  const auto is_known = [&](std::size_t i) { return std::isfinite(totals.thu[i]) && std::isfinite(totals.tvu[i]); };
  for (std::size_t part = 0; part < samples; ++part) {
    const std::size_t begin = part * size / samples, end = (part + 1) * size / samples;
    std::size_t known = 0, first = end;
    for (std::size_t i = begin; i < end; ++i)
      if (is_known(i)) first = std::min(first, i), ++known;
    if (known == 0) continue;
    const auto weight = static_cast<double>(known);
    ++sums.samples;
    const PulseOf pulse(plan, pulses, aircraft, first);
    for (const AirSource& source : AirSources(pulse.pulse(), plan.options.located, pulse.errors())) {
      const auto i = static_cast<std::size_t>(std::ranges::find(kErrorSources, source.name, &ErrorSource::name) -
                                              std::begin(kErrorSources));
      const Eigen::Matrix3d c = source.Covariance();
      const AxisVariances variances = {.horizontal = c(0, 0) + c(1, 1), .vertical = c(2, 2)};
      sums.sources[i].Add(variances, weight);
      sums.assumed.Add(variances, weight * assumed[i]);
    }
    const AxisVariances water = SumOf(totals.of_water, first);
    sums[OtherSource::kSea].Add(SumOf(totals.sea, first), weight);
    sums[OtherSource::kWater].Add(water, weight);
    if (water_assumed) sums.assumed.Add(water, weight);
    sums[OtherSource::kDatum].Add({.vertical = plan.options.datum * plan.options.datum}, weight);
    sums[OtherSource::kExtra].Add({totals.extra_horizontal_variance, totals.extra_vertical_variance}, weight);
    for (const TotalBatch::Covariance& group : totals.groups) sums.total.Add(SumOf(group, first), weight);
  }
  return sums;
}

}  // namespace albtpu::annotate
