#include "generator/campaign/water_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "generator/campaign/provenance.h"
#include "generator/math/random_stream.h"
#include "generator/water/water_column.h"
#include "sea/angle.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kCellOfChecks = 0xffffffff;  // of random numbers, used for nothing else

// The tolerance of an interpolated bias: 3 mm, or 4 % if that is more.
constexpr double kAllowed = 3e-3, kAllowedShare = 0.04;

const std::vector<double>& NodesOf(const Campaign& campaign, WaterAxis axis) {
  return campaign.axes[Index(axis)].nodes();
}

std::vector<double> ViewsOf(const Campaign& campaign) {
  std::vector<double> views = NodesOf(campaign, WaterAxis::kFieldOfView);
  views.back() = kInfinity;
  return views;
}

WaterColumn ColumnOf(const Campaign& campaign, double incidence, double scattering_over_absorption) {
  return {.incidence = RadiansOfDegrees(incidence),
          .refractive_index = campaign.refractive_index,
          .group_index = campaign.water->group_index,
          .absorption = 1 / scattering_over_absorption};
}

// The more light is scattered, the larger the standard error: the number of photons grows with b / a, from a third of
// that of the campaign to nearly twice as many.
WaterEffort EffortOf(const Campaign& campaign, double scattering_over_absorption) {
  const double share = std::clamp(scattering_over_absorption / 4, 0.35, 1.8);
  return {.photons = static_cast<std::uint32_t>(std::lround(share * campaign.water->photons)),
          .pairs_per_photon = campaign.water->pairs_per_photon,
          .seed = campaign.seed,
          .cell = kCellOfTables};
}

std::size_t EstimatesOfEcho(const Campaign& campaign) {
  return 7 * NodesOf(campaign, WaterAxis::kPulseLength).size() + 2;
}

std::size_t EchoesOfCase(const Campaign& campaign) {
  return NodesOf(campaign, WaterAxis::kOpticalDepth).size() * NodesOf(campaign, WaterAxis::kFieldOfView).size();
}

// An echo without a clear end has no biases: their standard errors are infinite.
void Append(const std::optional<DetectedBias>& detected, std::vector<Estimate>& estimates) {
  if (!detected) {
    estimates.insert(estimates.end(), 7, Estimate{0, kInfinity});
    return;
  }
  const DetectedBias& bias = *detected;
  estimates.insert(estimates.end(), bias.vertical.begin(), bias.vertical.end());
  estimates.insert(estimates.end(), bias.along.begin(), bias.along.end());
  estimates.push_back(bias.stretch);
}

// Of one bias over all checked beams [m]; `within` is the fraction within the tolerance.
struct CheckedError {
  double rms = 0, within = 0, greatest = 0, noise = 0, beams = 0;
};

CheckedError ErrorOf(const WaterColumnTable& table, const Campaign& campaign,
                     const std::vector<std::vector<Estimate>>& direct, std::size_t bias) {
  CheckedError error;
  for (std::size_t i = 0; i < direct.size(); ++i) {
    if (direct[i][kCheckedBiases].value < kMinEchoEnergy || std::isinf(direct[i][bias].standard_error)) continue;
    ++error.beams;
    const CheckedBeam checked = CheckedBeamOf(campaign, i);
    const OneWater water = table.Of(checked.backscatter_fraction, checked.scattering_over_absorption);
    // A checked beam lies within the nodes, and so it has an answer.
    const double off = water.At(checked.beam).value()[bias] * checked.depth - direct[i][bias].value;
    error.rms += off * off;
    error.noise += direct[i][bias].standard_error * direct[i][bias].standard_error;
    error.greatest = std::max(error.greatest, std::abs(off));
    error.within += std::abs(off) <= std::max(kAllowed, kAllowedShare * std::abs(direct[i][bias].value));
  }
  const double count = std::max(1.0, error.beams);
  return {std::sqrt(error.rms / count), error.within / count, error.greatest, std::sqrt(error.noise / count),
          error.beams};
}

Provenance ProvenanceOf(const Campaign& campaign) {
  Provenance provenance = CommonProvenance(campaign);
  provenance.attributes.insert({
      {"source", "Monte Carlo of photons in a homogeneous water over a flat Lambertian bottom, albtpu-generate"},
      {"references",
       "Fournier and Jonasz (1999), doi:10.1117/12.366488; Mobley et al. (2002), doi:10.1364/AO.41.001035"},
      {"component", "water column only: no sea surface, air side, platform or system"},
      {"group_index", campaign.water->group_index},
      {"beam_profile", "a line; a pulse of Gaussian shape"},
      {"photons", static_cast<std::int64_t>(campaign.water->photons * WaterEffort().pools)},
      {"pairs_per_photon", static_cast<std::int64_t>(campaign.water->pairs_per_photon)},
  });
  return provenance;
}

void DescribeErrors(const WaterColumnTable& table, const Campaign& campaign,
                    const std::vector<std::vector<Estimate>>& direct, Provenance& provenance) {
  provenance.attributes["interpolation_error"] =
      "Of the interpolated table against direct computation by the random numbers of the nodes, for random "
      "coastal waters, depths and systems whose echo has 0.3 % of the energy of unscattered light: root mean "
      "square (m), share within 3 mm or 4 %, greatest (m), rms standard error of the direct values (m), "
      "number "
      "of beams";
  for (std::size_t bias = 0; bias < kCheckedBiases; ++bias) {
    const CheckedError error = ErrorOf(table, campaign, direct, bias);
    provenance.attributes["interpolation_error_" + std::string(kWaterColumn.quantities[bias].name)] =
        std::vector<double>{error.rms, error.within, error.greatest, error.noise, error.beams};
  }
}

absl::StatusOr<Table::Variables> VariablesOf(const Campaign& campaign,
                                             const std::vector<std::vector<Estimate>>& cases) {
  Table::Variables variables;
  for (const QuantitySchema& quantity : kWaterColumn.quantities) {
    Variable& variable = variables.emplace_back().emplace();
    variable.values.reserve(ValueCount(campaign.axes, quantity));
    variable.standard_errors.reserve(variable.values.capacity());
  }
  const std::size_t of_echo = EstimatesOfEcho(campaign), pulses = (of_echo - 2) / 7;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].size() != EchoesOfCase(campaign) * of_echo)
      return absl::DataLossError(absl::StrCat("water case ", i, " does not have the nodes of its campaign; delete it"));
    for (std::size_t at = 0; at < cases[i].size(); ++at) {
      const std::size_t in_echo = at % of_echo;
      const std::size_t quantity = in_echo < 7 * pulses ? in_echo % 7 : 7 + in_echo - 7 * pulses;
      if (!std::isfinite(cases[i][at].standard_error)) {
        const std::size_t views = NodesOf(campaign, WaterAxis::kFieldOfView).size();
        return absl::FailedPreconditionError(
            absl::StrCat("the echo of water case ", i, " has no clear end at an optical depth of ",
                         NodesOf(campaign, WaterAxis::kOpticalDepth)[at / of_echo / views],
                         " (too few photons come back); give a smaller maximum optical depth, or more photons"));
      }
      const Estimate rounded = Rounded(cases[i][at]);
      variables[quantity]->values.push_back(static_cast<float>(rounded.value));
      variables[quantity]->standard_errors.push_back(static_cast<float>(rounded.standard_error));
    }
  }
  return variables;
}

}  // namespace

std::size_t WaterCaseCount(const Campaign& campaign) {
  return NodesOf(campaign, WaterAxis::kBackscatterFraction).size() *
         NodesOf(campaign, WaterAxis::kScatteringOverAbsorption).size() *
         NodesOf(campaign, WaterAxis::kIncidence).size();
}

std::vector<Estimate> ComputeWaterCase(const Campaign& campaign, std::size_t index) {
  const std::vector<double>& incidences = NodesOf(campaign, WaterAxis::kIncidence);
  const std::vector<double>& ratios = NodesOf(campaign, WaterAxis::kScatteringOverAbsorption);
  const double ratio = ratios[index / incidences.size() % ratios.size()];
  const double fraction = NodesOf(campaign, WaterAxis::kBackscatterFraction)[index / incidences.size() / ratios.size()];
  std::vector<double> scattering = NodesOf(campaign, WaterAxis::kOpticalDepth);
  for (double& depth : scattering) depth /= OpticalDepthPerScattering(ratio, fraction);
  const std::vector<double> views = ViewsOf(campaign);
  const std::vector<double>& pulses = NodesOf(campaign, WaterAxis::kPulseLength);
  const std::vector<std::vector<WaterColumnBias>> biases = ComputeWaterColumns(
      PhaseFunction::FournierForand(fraction), ColumnOf(campaign, incidences[index % incidences.size()], ratio),
      scattering, views, pulses, EffortOf(campaign, ratio));
  std::vector<Estimate> estimates;
  estimates.reserve(EchoesOfCase(campaign) * EstimatesOfEcho(campaign));
  for (const std::vector<WaterColumnBias>& of_depth : biases) {
    for (const WaterColumnBias& bias : of_depth) {
      for (const std::optional<DetectedBias>& detected : bias.by_pulse) Append(detected, estimates);
      estimates.push_back(bias.spot);
      estimates.push_back(bias.energy);
    }
  }
  return estimates;
}

CheckedBeam CheckedBeamOf(const Campaign& campaign, std::size_t index) {
  UniformStream random(campaign.seed, kCellOfChecks, static_cast<std::uint32_t>(index));
  const auto between = [&](double least, double most) { return least * std::pow(most / least, random.Next()); };
  const auto along = [&](WaterAxis axis) {
    const std::vector<double>& nodes = NodesOf(campaign, axis);
    return between(nodes.front(), nodes.back());
  };
  const auto has = [&](WaterAxis axis, double x) {
    const std::vector<double>& nodes = NodesOf(campaign, axis);
    return x >= nodes.front() && x <= nodes.back();
  };
  const std::vector<double>& incidences = NodesOf(campaign, WaterAxis::kIncidence);
  CheckedBeam checked;
  // A campaign of few nodes may have no such beam; then the last one that was drawn is held within the nodes.
  for (int draw = 0; draw < 1000; ++draw) {
    checked.backscatter_fraction = along(WaterAxis::kBackscatterFraction);
    checked.scattering_over_absorption = along(WaterAxis::kScatteringOverAbsorption);
    checked.depth = between(1, 40);
    checked.beam = {.incidence = incidences.front() + (incidences.back() - incidences.front()) * random.Next(),
                    .optical_depth = between(0.05, 0.5) * checked.depth,
                    .field_of_view = between(1.5, 20) / checked.depth,
                    .pulse_length = PulseLengthOverDepth(between(1, 7), checked.depth, campaign.water->group_index)};
    if (has(WaterAxis::kOpticalDepth, checked.beam.optical_depth) &&
        has(WaterAxis::kFieldOfView, checked.beam.field_of_view) &&
        has(WaterAxis::kPulseLength, checked.beam.pulse_length))
      return checked;
  }
  const auto hold = [&](WaterAxis axis, double& x) {
    x = std::clamp(x, NodesOf(campaign, axis).front(), NodesOf(campaign, axis).back());
  };
  hold(WaterAxis::kOpticalDepth, checked.beam.optical_depth);
  hold(WaterAxis::kFieldOfView, checked.beam.field_of_view);
  hold(WaterAxis::kPulseLength, checked.beam.pulse_length);
  return checked;
}

std::vector<Estimate> ComputeDirectly(const Campaign& campaign, const CheckedBeam& checked) {
  WaterColumn column = ColumnOf(campaign, checked.beam.incidence, checked.scattering_over_absorption);
  column.scattering = checked.beam.optical_depth /
                      OpticalDepthPerScattering(checked.scattering_over_absorption, checked.backscatter_fraction);
  column.field_of_view = checked.beam.field_of_view;
  const std::array pulses = {checked.beam.pulse_length};
  const WaterColumnBias bias = ComputeWaterColumn(PhaseFunction::FournierForand(checked.backscatter_fraction), column,
                                                  pulses, EffortOf(campaign, checked.scattering_over_absorption));
  std::vector<Estimate> estimates;
  Append(bias.by_pulse.front(), estimates);
  estimates.resize(kCheckedBiases);
  for (Estimate& estimate : estimates) {
    estimate.value *= checked.depth;
    estimate.standard_error *= checked.depth;
  }
  estimates.push_back(bias.energy);
  return estimates;
}

absl::StatusOr<Table> BuildWaterTable(const Campaign& campaign, const std::vector<std::vector<Estimate>>& cases,
                                      const std::vector<std::vector<Estimate>>& direct) {
  ASSIGN_OR_RETURN(const Table::Variables variables, VariablesOf(campaign, cases));
  const Table::Axes axes(campaign.axes.begin(), campaign.axes.end());
  Provenance provenance = ProvenanceOf(campaign);
  ASSIGN_OR_RETURN(Table table, Table::Create(kWaterColumn, axes, variables, provenance));
  ASSIGN_OR_RETURN(const WaterColumnTable interpolated, WaterColumnTable::Create(std::move(table)));
  DescribeErrors(interpolated, campaign, direct, provenance);
  return Table::Create(kWaterColumn, axes, variables, std::move(provenance));
}

}  // namespace albtpu
