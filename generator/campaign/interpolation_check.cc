#include "generator/campaign/interpolation_check.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "generator/math/random_stream.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "generator/surface/discretization.h"
#include "sea/angle.h"

namespace albtpu {
namespace {

constexpr std::uint32_t kCellOfPulses = 0xffffffff;        // of random numbers, used for nothing else
constexpr double kLeastAngle = 0.01, kLeastLength = 5e-3;  // degree, m
constexpr float kMinWind = 2;                              // m/s

// The coordinate at the fraction `t` of an axis, in its scale.
float AlongAxis(const Axis& axis, double t) {
  const double first = axis.nodes().front(), last = axis.nodes().back();
  const double x =
      axis.scale() == Scale::kLog ? first * std::pow(last / first, t) : first + t * (last - first);
  return static_cast<float>(std::clamp(x, first, last));
}

Estimate ValueOf(const BeamUncertainty& beam, Quantity quantity) {
  const auto in_degrees = [](const Estimate& radians) {
    return Estimate{DegreesOfRadians(radians.value), DegreesOfRadians(radians.standard_error)};
  };
  switch (quantity) {
    case Quantity::kRefractionAlongWind:
      return in_degrees(beam.refraction_along_wind);
    case Quantity::kRefractionCrossWind:
      return in_degrees(beam.refraction_cross_wind);
    case Quantity::kThu:
      return beam.thu[0];
    case Quantity::kTvu:
      return beam.tvu[0];
    default:
      assert(false);
      return {};
  }
}

}  // namespace

Pulse CheckedPulse(const Campaign& campaign, std::size_t index) {
  std::array<double, kAxisCount + 2> normals;  // rounded up to a multiple of four
  NormalStream(campaign.seed, kCellOfPulses, static_cast<std::uint32_t>(index)).Fill(normals);
  const auto coordinate = [&](AxisId axis) {
    const double uniform =
        0.5 * std::erfc(-normals[Index(axis)] / std::sqrt(2.0));  // the normal distribution function
    return AlongAxis(campaign.axes[Index(axis)], uniform);
  };
  return {.wind_speed = coordinate(AxisId::kWindSpeed),
          .fetch = coordinate(AxisId::kFetch),
          .incidence = coordinate(AxisId::kIncidence),
          .azimuth = coordinate(AxisId::kAzimuth),
          .footprint = coordinate(AxisId::kFootprint),
          .depth = coordinate(AxisId::kDepth)};
}

std::vector<Estimate> ComputeDirectly(const Campaign& campaign, const Pulse& pulse) {
  SeaCase sea_case = SeaCaseOf(campaign, 0);  // for what all sea cases have in common
  sea_case.sea = SeaOf(campaign, pulse.wind_speed, pulse.fetch);
  sea_case.depths = {pulse.depth};
  const BeamOptions beam{.incidence = RadiansOfDegrees(pulse.incidence),
                         .azimuth = RadiansOfDegrees(*pulse.azimuth),
                         .footprint = pulse.footprint,
                         .profile = campaign.profile,
                         .source_height = campaign.source_height};
  // The outermost beams of a sea case determine grid, patch and rays, and the widest one the reach. They are the same
  // here as at the nodes.
  for (BeamOptions& node : sea_case.beams) node.footprint = pulse.footprint;
  sea_case.discretization = ChooseDiscretization(SeaState(sea_case.sea), sea_case.beams);
  sea_case.beams = {beam, WidestBeam(sea_case.beams)};
  const SeaCaseResult result = Simulate(sea_case, campaign.effort, campaign.seed, kCellOfTables);
  std::vector<Estimate> estimates;
  for (const Quantity quantity : kChecked) estimates.push_back(ValueOf(result.beams[0], quantity));
  return estimates;
}

InterpolationError CompareWithTable(const Campaign& campaign, const UncertaintyTable& table,
                                    const std::vector<std::vector<Estimate>>& direct, std::size_t checked) {
  const Quantity quantity = kChecked[checked];
  const double least = Describe(quantity).over_last_axis ? kLeastLength : kLeastAngle;
  InterpolationError summary;
  std::vector<double> errors;  // relative magnitudes
  for (std::size_t i = 0; i < direct.size(); ++i) {
    const Estimate& expected = direct[i][checked];
    const Pulse pulse = CheckedPulse(campaign, i);
    if (expected.value < least || (!campaign.sea && pulse.wind_speed < kMinWind)) continue;
    const PulseUncertainty interpolated = Interpolate(table, pulse);
    assert(interpolated.outcome == Outcome::kInterpolated);
    errors.push_back(std::abs(interpolated[quantity] / expected.value - 1));
    summary.rms += errors.back() * errors.back();
    summary.noise += std::pow(expected.standard_error / expected.value, 2);
  }
  if (errors.empty()) return summary;
  const double count = static_cast<double>(errors.size());
  std::sort(errors.begin(), errors.end());
  summary.pulses = static_cast<int>(errors.size());
  summary.rms = std::sqrt(summary.rms / count);
  summary.noise = std::sqrt(summary.noise / count);
  summary.percentile_99 = errors[static_cast<std::size_t>(std::ceil(0.99 * count)) - 1];
  summary.greatest = errors.back();
  return summary;
}

}  // namespace albtpu
