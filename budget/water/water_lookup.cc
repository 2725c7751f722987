#include "budget/water/water_lookup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

namespace albtpu {
namespace {

// Of draws whose bias at the depth of a calibration has the other sign.
constexpr double kMostOfOtherSign = 0.02;

}  // namespace

Looked WaterAtDepth::At(double incidence) const {
  const std::optional<WaterAnswer> answer = water_.At(incidence);
  assert(answer.has_value());
  return {.vertical = (*answer)[Index(WaterQuantity::kBiasVerticalPeak) + detector_] * beyond_,
          .along = (*answer)[Index(WaterQuantity::kBiasAlongPeak) + detector_] * beyond_,
          .spot = (*answer)[Index(WaterQuantity::kSpot)],
          .stretch = (*answer)[Index(WaterQuantity::kStretch)],
          .energy = (*answer)[Index(WaterQuantity::kEnergy)]};
}

WaterLookup::WaterLookup(const WaterColumnTable& table, const WaterReceiver& receiver, const DrawnWater& draw)
    : receiver_(receiver),
      draw_(draw),
      min_view_(table.Range(WaterAxis::kFieldOfView).first),
      min_pulse_(table.Range(WaterAxis::kPulseLength).first),
      min_ratio_(table.Range(WaterAxis::kScatteringOverAbsorption).first),
      last_(table.Range(WaterAxis::kOpticalDepth).second),
      water_(table.Of(draw.fraction, draw.ratio)) {}

WaterAtDepth WaterLookup::At(double depth) const {
  const double tau = draw_.attenuation * depth;
  // At the largest depth a ratio may be rounded to just outside the table.
  std::optional<WaterOverIncidence> over = water_.OverIncidence(
      {.optical_depth = std::min(tau, last_),
       .field_of_view = std::max(receiver_.field_of_view / depth, min_view_),
       .pulse_length =
           std::max(PulseLengthOverDepth(receiver_.pulse_length, depth, receiver_.group_index), min_pulse_)});
  assert(over.has_value());
  WaterAtDepth there;
  there.water_ = *std::move(over);
  // Below the lowest scattering of the table, values are in proportion to the scattering.
  there.beyond_ = std::max(1.0, tau / last_) * std::min(1.0, draw_.ratio / min_ratio_);
  there.detector_ = static_cast<std::size_t>(receiver_.detector);
  return there;
}

CalibratedWaters::CalibratedWaters(const std::vector<WaterLookup>& waters, const std::vector<double>& incidences,
                                   const BiasTreatment& treatment)
    : waters_(waters.size()) {
  if (treatment.handling != BiasHandling::kCalibrated) return;
  std::vector<WaterAtDepth> there;
  there.reserve(waters.size());
  for (const WaterLookup& water : waters) there.push_back(water.At(treatment.calibration_depth));
  std::vector<double> biases(waters.size());
  for (const double incidence : incidences) {
    double sum = 0;
    for (std::size_t j = 0; j < waters.size(); ++j) sum += biases[j] = there[j].At(incidence).vertical;
    const double mean = sum / static_cast<double>(waters.size());
    std::size_t other_sign = 0;
    for (const double bias : biases) {
      other_sign += bias * mean <= 0;
      scales_.push_back(treatment.calibration_offset / (bias * treatment.calibration_depth));
    }
    disagree_ |= static_cast<double>(other_sign) > kMostOfOtherSign * static_cast<double>(waters.size());
    noises_.push_back(treatment.calibration_sigma / (std::abs(mean) * treatment.calibration_depth));
  }
}

}  // namespace albtpu
