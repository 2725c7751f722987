#include "sea/table/sea_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "sea/angle.h"
#include "sea/response/sea_response.h"
#include "sea/spectra/sea_error.h"
#include "sea/spectra/spectrum_moments.h"
#include "sea/table/sea_attributes.h"
#include "status/status_macros.h"
#include "tables/version.h"

namespace albtpu {
namespace {

std::vector<double> Radians(const std::vector<double>& degrees) {
  std::vector<double> radians;
  for (const double angle : degrees) radians.push_back(RadiansOfDegrees(angle));
  return radians;
}

// Seas are given more harmonics than many of them have, and their responses cost time in proportion.
HarmonicSpectrum WithoutEmptyHarmonics(HarmonicSpectrum spectrum) {
  const auto is_empty = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return value == 0; });
  };
  while (spectrum.harmonics() > 1 && is_empty(spectrum.a.back()) && is_empty(spectrum.b.back())) {
    spectrum.a.pop_back();
    spectrum.b.pop_back();
  }
  return spectrum;
}

SeaTableOptions WithRoundedNodes(SeaTableOptions options) {
  SeaTableNodes& nodes = options.nodes;
  for (std::vector<double>* axis : {&nodes.incidences, &nodes.azimuths, &nodes.footprints, &nodes.depths})
    for (double& node : *axis) node = static_cast<float>(node);
  return options;
}

std::vector<double> WithoutLast(std::vector<double> nodes) {
  nodes.pop_back();
  return nodes;
}

Axis MakeAxis(AxisId id, std::vector<double> nodes) {
  return Axis::Create(kOneSea.axes[Index(id)], std::move(nodes)).value();
}

// A value and its standard error.
struct Estimate {
  double value = 0, error = 0;
};

// 2 sigma of an error of which one part of the variance is in proportion to the slopes' variance, and one part to its
// square, which is known to within the relative error `relative`.
Estimate TwoSigma(double in_proportion, double to_its_square, double relative) {
  const double variance = in_proportion + to_its_square;
  if (!(variance > 0)) return {};
  const double value = 2 * std::sqrt(variance);
  return {value, relative * value * (0.5 * in_proportion + to_its_square) / variance};
}

Estimate Scaled(double value, double relative) { return {value, relative * std::abs(value)}; }

// TOML of what the sea was compiled from.
std::string CampaignText(const std::map<std::string, AttributeValue>& sea, BeamProfile profile, double index) {
  std::string text =
      absl::StrFormat("refractive_index = %.17g\nbeam_profile = \"%s\"\n\n[sea]\n", index, std::string(Name(profile)));
  for (const auto& [name, value] : sea)
    if (const auto* number = std::get_if<double>(&value))
      absl::StrAppendFormat(&text, "%s = %.17g\n", name, *number);
    else if (name != sea_attribute::kAssumptions)
      absl::StrAppendFormat(&text, "%s = \"%s\"\n", name, std::get<std::string>(value));
  return text;
}

// The variances to which the errors are proportional.
struct RelativeError {
  double slopes = 0;       // of V at the footprint
  double mean_square = 0;  // of the mean square slope of the whole sea
};

using Estimates = std::array<Estimate, kQuantityCount>;

// `nadir` is the vertical beam of the same footprint. Its vertical error is of second order throughout, and what it has
// of second order changes little with the incidence.
Estimates EstimatesOf(const BeamResponse& beam, const BeamResponse& nadir, double depth,
                      const RelativeError& relative) {
  const double horizontal = beam.covariance_per_depth.topLeftCorner<2, 2>().trace();
  const double vertical = beam.covariance_per_depth(2, 2);
  const double second_order = std::min(vertical, nadir.covariance_per_depth(2, 2));
  const Eigen::Matrix3d& at_surface = beam.covariance_at_surface;  // height times slope
  const double squared = depth * depth;
  Estimates estimates;
  estimates[Index(Quantity::kRefractionAlongWind)] =
      Scaled(DegreesOfRadians(beam.refraction_along_wind()), 0.5 * relative.slopes);
  estimates[Index(Quantity::kRefractionCrossWind)] =
      Scaled(DegreesOfRadians(beam.refraction_cross_wind()), 0.5 * relative.slopes);
  estimates[Index(Quantity::kThu)] =
      TwoSigma(squared * horizontal, at_surface.topLeftCorner<2, 2>().trace(), relative.slopes);
  estimates[Index(Quantity::kTvu)] =
      TwoSigma(squared * (vertical - second_order), squared * second_order + at_surface(2, 2), relative.slopes);
  estimates[Index(Quantity::kBiasAlongBeam)] = Scaled(beam.BiasAlongBeam(depth), relative.mean_square);
  estimates[Index(Quantity::kBiasVertical)] = Scaled(beam.BiasVertical(depth), relative.mean_square);
  return estimates;
}

}  // namespace

SeaCompiler::SeaCompiler(const SeaTableOptions& options)
    : options_(WithRoundedNodes(options)),
      directions_(Radians(options_.nodes.incidences), Radians(WithoutLast(options_.nodes.azimuths))) {
  for (const double footprint : options_.nodes.footprints) footprints_.emplace_back(options_.profile, footprint);
}

absl::StatusOr<UncertaintyTable> SeaCompiler::Compile(const SeaDescription& sea, double record_length,
                                                      double index) const {
  const SeaErrors error_of(sea, record_length);
  RelativeErrors errors;
  for (const double footprint : options_.nodes.footprints) {
    const BeamOptions beam{.footprint = footprint, .profile = options_.profile};
    errors.push_back(error_of([&](double k) { return FootprintPower(beam, k, 0); }).total);
  }
  errors.push_back(error_of([](double) { return 1; }).total);
  return Compile(Describe(sea), sea.waves ? std::optional(sea.tail) : std::nullopt, errors, index);
}

absl::StatusOr<UncertaintyTable> SeaCompiler::Compile(const DescribedSea& sea, double index) const {
  return Compile(sea, std::nullopt, std::nullopt, index);
}

absl::StatusOr<UncertaintyTable::Axes> SeaCompiler::AxesFor(double wind_speed) const {
  const SeaTableNodes& nodes = options_.nodes;
  // A wind derived from absurd waves may be infinite.
  ASSIGN_OR_RETURN(Axis wind, Axis::Create(kOneSea.axes[Index(AxisId::kWindSpeed)], {static_cast<float>(wind_speed)}));
  return UncertaintyTable::Axes{std::move(wind),
                                MakeAxis(AxisId::kFetch, {1}),
                                MakeAxis(AxisId::kIncidence, nodes.incidences),
                                MakeAxis(AxisId::kAzimuth, nodes.azimuths),
                                MakeAxis(AxisId::kFootprint, nodes.footprints),
                                MakeAxis(AxisId::kDepth, nodes.depths)};
}

Provenance SeaCompiler::ProvenanceOf(const DescribedSea& sea, std::optional<TailRule> tail, double index) const {
  std::map<std::string, AttributeValue> attributes = AttributesOf(sea, tail);
  Provenance provenance{.id = "sea",
                        .version = "1",
                        .title = absl::StrFormat("One sea: waves of %.2f m, wind of %.1f m/s",
                                                 SignificantWaveHeight(sea.spectrum), sea.wind_speed_10m),
                        .campaign = CampaignText(attributes, options_.profile, index),
                        .attributes = std::move(attributes)};
  provenance.attributes.emplace("source", "response theory of a Gaussian sea");
  provenance.attributes.emplace("program_version", std::string(Version()));
  provenance.attributes.emplace("refractive_index", index);
  provenance.attributes.emplace("beam_profile", std::string(Name(options_.profile)));
  return provenance;
}

std::vector<BeamResponse> SeaCompiler::ResponsesOf(const HarmonicSpectrum& spectrum, double index) const {
  if (MeanSquareSlope(spectrum) == 0) {  // exactly nothing, not what rounding leaves
    const BeamResponse none{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero(),
                            Eigen::Vector2d::Zero()};
    return std::vector<BeamResponse>(directions_.size() * footprints_.size(), none);
  }
  return directions_.ResponsesOf(SeaResponse(WithoutEmptyHarmonics(spectrum), index), footprints_);
}

absl::StatusOr<UncertaintyTable> SeaCompiler::Compile(const DescribedSea& sea, std::optional<TailRule> tail,
                                                      const std::optional<RelativeErrors>& errors, double index) const {
  const auto refused = [&](const absl::Status& status) {
    return absl::InvalidArgumentError(
        absl::StrFormat("the sea has no table (its mean square slope is %g, its wind %g m/s; %s); check its heights, "
                        "periods and units",
                        MeanSquareSlope(sea.spectrum), sea.wind_speed_10m, std::string(status.message())));
  };
  if (!(MeanSquareSlope(sea.spectrum) <= kMaxMeanSquareSlope))
    return refused(absl::InvalidArgumentError(absl::StrFormat("no sea has more than %g", kMaxMeanSquareSlope)));
  absl::StatusOr<UncertaintyTable::Axes> axes = AxesFor(sea.wind_speed_10m);
  if (!axes.ok()) return refused(axes.status());
  const std::vector<BeamResponse> responses = ResponsesOf(sea.spectrum, index);
  UncertaintyTable::Variables variables;
  variables.fill(Variable());
  const SeaTableNodes& nodes = options_.nodes;
  const std::size_t azimuths = nodes.azimuths.size() - 1;  // half a turn is the first one again
  for (std::size_t i = 0; i < nodes.incidences.size(); ++i) {
    for (std::size_t node = 0; node < nodes.azimuths.size(); ++node) {
      const std::size_t a = node % azimuths;
      for (std::size_t f = 0; f < nodes.footprints.size(); ++f) {
        const RelativeError relative = errors ? RelativeError{(*errors)[f], errors->back()} : RelativeError{};
        const BeamResponse& beam = responses[(i * azimuths + a) * footprints_.size() + f];
        for (std::size_t d = 0; d < nodes.depths.size(); ++d) {
          const Estimates estimates = EstimatesOf(beam, responses[f], nodes.depths[d], relative);
          for (const Quantity quantity : kQuantities) {
            if (d > 0 && !Describe(quantity).over_last_axis) continue;
            Variable& variable = *variables[Index(quantity)];
            const Estimate& estimate = estimates[Index(quantity)];
            variable.values.push_back(static_cast<float>(estimate.value));
            // Rounding may leave an error of nothing below 0.
            if (errors) variable.standard_errors.push_back(static_cast<float>(estimate.error < 0 ? 0 : estimate.error));
          }
        }
      }
    }
  }
  absl::StatusOr<UncertaintyTable> table =
      UncertaintyTable::Create(kOneSea, *std::move(axes), std::move(variables), ProvenanceOf(sea, tail, index));
  if (!table.ok()) return refused(table.status());
  return table;
}

}  // namespace albtpu
