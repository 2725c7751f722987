#include "generator/campaign/campaign.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "generator/campaign/toml_reader.h"
#include "sea/angle.h"
#include "sea/response/refraction.h"
#include "tables/format.h"
#include "tables/provenance.h"

namespace albtpu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A campaign of hundreds of nodes has a tenth of it. Longer texts could hold keys that nest so deep ("a.a.a
// ...") that the reader of TOML, which calls itself for each level, would run out of stack.
constexpr std::size_t kMostBytes = 32768;

// Nodes are kept in single precision, as tables are: 0.1 in the file is the float nearest to it.
std::vector<double> InSinglePrecision(std::vector<double> nodes) {
  for (double& node : nodes) node = static_cast<float>(node);
  return nodes;
}

// The least float at or above `x`.
double FloatNotBelow(double x) {
  const float nearest = static_cast<float>(x);
  return nearest >= x ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

// `inf` as the last fetch becomes the least fetch at which the sea of the strongest wind is fully developed:
// there the seas of all winds are, and beyond it nothing changes.
absl::Status ResolveFetch(const SpectrumModel& model, std::vector<double>& fetch,
                          const std::vector<double>& wind_speed) {
  if (fetch.empty() || fetch.back() != kInfinity) {
    return absl::InvalidArgumentError(
        "the last node of 'axes.fetch' must be inf, the fully developed sea: beyond it nothing changes");
  }
  const double developed =
      FloatNotBelow(model.fully_developed_fetch(*std::max_element(wind_speed.begin(), wind_speed.end())));
  fetch.back() = developed;
  if (fetch.size() > 1 && !(fetch[fetch.size() - 2] < developed)) {
    return absl::InvalidArgumentError(
        absl::StrCat("node ", fetch.size() - 2, " of 'axes.fetch', ", fetch[fetch.size() - 2],
                     " m, is beyond full development of the strongest wind (", developed,
                     " m): leave it out, the last node is that sea"));
  }
  return absl::OkStatus();
}

using Nodes = std::array<std::vector<double>, kAxisCount>;

Nodes ReadNodes(TomlReader& toml) {
  Nodes nodes;
  for (const AxisId axis : kAxes) {
    nodes[Index(axis)] = InSinglePrecision(toml.Numbers("axes", Describe(axis).name));
  }
  return nodes;
}

// "apel" or "elfouhaily", for messages.
std::string SpectrumKeys() {
  return absl::StrJoin(kSpectrumModels, " or ", [](std::string* keys, const SpectrumModel* model) {
    absl::StrAppend(keys, "\"", std::string(model->key), "\"");
  });
}

WindSea ReadWindSea(TomlReader& toml) {
  WindSea sea;
  const std::string key = toml.Text("sea", "spectrum", sea.model->key);
  if (const SpectrumModel* model = FindSpectrumModel(key)) {
    sea.model = model;
  } else {
    toml.Fail(absl::StrCat("'sea.spectrum' must be ", SpectrumKeys()));
  }
  constexpr double kNotGiven = 0;
  const double spreading = toml.Number("sea", "spreading", 0.5, 30, kNotGiven);
  if (spreading != kNotGiven) sea.spreading = spreading;
  if (spreading != kNotGiven && !sea.model->takes_spreading) {
    toml.Fail(absl::StrCat("'sea.spreading' is not taken by \"", key,
                           "\", which has a spreading of its own: leave it out"));
  }
  return sea;
}

Effort ReadEffort(TomlReader& toml) {
  constexpr int kMost = 10'000'000;
  constexpr int kMostUnlessSaid = 40'000;
  Effort effort;
  effort.realizations = static_cast<int>(toml.Integer("effort", "realizations", 2, kMost).value_or(1000));
  effort.relative_error = toml.Number("effort", "relative_error", 1e-4, 0.5, 0);
  const std::string estimator = toml.Text("effort", "estimator", Name(effort.estimator));
  if (const std::optional<Estimator> found = FindEstimator(estimator)) {
    effort.estimator = *found;
  } else {
    toml.Fail("'effort.estimator' must be \"control_variate\" or \"plain\"");
  }
  const int most =
      effort.relative_error > 0 ? std::max(effort.realizations, kMostUnlessSaid) : effort.realizations;
  effort.most_realizations = static_cast<int>(
      toml.Integer("effort", "most_realizations", effort.realizations, kMost).value_or(most));
  return effort;
}

// Beyond the rules of all axes, those of a sea that can be simulated.
absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const SpectrumModel& model, Nodes nodes) {
  for (const AxisId axis : kAxes) {
    if (nodes[Index(axis)].empty()) {
      return absl::InvalidArgumentError(
          absl::StrCat("'axes.", std::string(Describe(axis).name), "' has no node: give at least one"));
    }
  }
  for (const AxisId axis : {AxisId::kWindSpeed, AxisId::kFetch, AxisId::kFootprint}) {
    if (nodes[Index(axis)].front() <= 0) {
      return absl::InvalidArgumentError(
          absl::StrCat("node 0 of 'axes.", std::string(Describe(axis).name), "' must be above 0"));
    }
  }
  constexpr double kGreatestIncidence = 60;  // degree; beyond it waves hide behind each other
  if (nodes[Index(AxisId::kIncidence)].back() > kGreatestIncidence) {
    return absl::InvalidArgumentError(
        "the last node of 'axes.incidence' is above 60 degrees: waves would hide behind each other, which is "
        "not "
        "modelled");
  }
  const absl::Status fetch =
      ResolveFetch(model, nodes[Index(AxisId::kFetch)], nodes[Index(AxisId::kWindSpeed)]);
  if (!fetch.ok()) return fetch;

  std::vector<Axis> axes;
  for (const AxisId id : kAxes) {
    absl::StatusOr<Axis> axis = Axis::Create(id, nodes[Index(id)]);
    if (!axis.ok()) return axis.status();
    axes.push_back(*std::move(axis));
  }
  return UncertaintyTable::Axes{axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]};
}

// What the table would refuse after the work is refused before it.
absl::Status CheckTable(const Campaign& campaign) {
  std::size_t most_nodes = format::kMaxValueCount;  // Of all axes together: their product could overflow.
  for (const Axis& axis : campaign.axes) most_nodes /= axis.size();
  if (most_nodes == 0) {
    return absl::InvalidArgumentError(absl::StrCat("the axes make more cells than a table holds (",
                                                   format::kMaxValueCount, "): give fewer nodes"));
  }
  Provenance provenance;
  provenance.id = campaign.id;
  provenance.version = campaign.version;
  provenance.title = campaign.title;
  provenance.campaign = campaign.text;
  return CheckProvenance(provenance);
}

}  // namespace

absl::StatusOr<Campaign> ParseCampaign(std::string_view text) {
  if (text.size() > kMostBytes) {
    return absl::InvalidArgumentError(
        absl::StrCat("has ", text.size(), " bytes: a campaign has ", kMostBytes, " at most"));
  }
  absl::StatusOr<TomlReader> parsed = TomlReader::Parse(text);
  if (!parsed.ok()) return parsed.status();
  TomlReader& toml = *parsed;

  const std::string id = toml.Text("", "id");
  const std::string version = toml.Text("", "version");
  const std::string title = toml.Text("", "title");
  const auto seed = toml.Integer("", "seed", 0, std::numeric_limits<std::int64_t>::max());
  const Nodes nodes = ReadNodes(toml);
  const std::optional<BeamProfile> profile =
      FindBeamProfile(toml.Text("beam", "profile", Name(BeamProfile::kUniform)));
  if (!profile) toml.Fail("'beam.profile' must be \"uniform\" or \"gaussian\"");
  const double source_height = toml.Number("beam", "source_height", 0.1, kInfinity, kInfinity);
  const double refractive_index = toml.Number("water", "refractive_index", 1.01, 2, kRefractiveIndex);
  constexpr double kShortestCorrected = 0.1;  // m
  const WindSea wind_sea = ReadWindSea(toml);
  const double corrected_above =
      toml.Number("sea", "corrected_above", kShortestCorrected, kInfinity, kInfinity);
  const Effort effort = ReadEffort(toml);
  const auto rays = toml.Integer("effort", "rays", 100, kMostRays);
  const std::string node_values = toml.Text("interpolation", "nodes", "exact");
  if (node_values != "exact" && node_values != "balanced") {
    toml.Fail("'interpolation.nodes' must be \"exact\" or \"balanced\"");
  }
  const auto checked_pulses = toml.Integer("interpolation", "checked_pulses", 1, 10'000);
  if (const absl::Status status = toml.Finish(); !status.ok()) return status;

  absl::StatusOr<UncertaintyTable::Axes> axes = MakeAxes(*wind_sea.model, nodes);
  if (!axes.ok()) return axes.status();
  Campaign campaign{.text = std::string(text),
                    .id = id,
                    .version = version,
                    .title = title,
                    .seed = static_cast<std::uint64_t>(seed.value_or(1)),
                    .axes = *std::move(axes),
                    .profile = *profile,
                    .source_height = source_height,
                    .refractive_index = refractive_index,
                    .wind_sea = wind_sea,
                    .corrected_above = corrected_above,
                    .effort = effort,
                    .rays = rays ? std::optional<int>(static_cast<int>(*rays)) : std::nullopt};
  campaign.balanced_nodes = node_values == "balanced";
  if (checked_pulses) campaign.checked_pulses = static_cast<std::size_t>(*checked_pulses);
  if (const absl::Status status = CheckTable(campaign); !status.ok()) return status;
  return campaign;
}

absl::StatusOr<Campaign> ReadCampaign(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": is a folder: name a campaign file"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return absl::NotFoundError(absl::StrCat(path.string(), ": no such campaign file, or not readable"));
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  absl::StatusOr<Campaign> campaign = ParseCampaign(text);
  if (!campaign.ok()) {
    return absl::Status(campaign.status().code(),
                        absl::StrCat(path.string(), ": ", campaign.status().message()));
  }
  return campaign;
}

std::size_t SeaCaseCount(const Campaign& campaign) {
  return campaign.nodes(AxisId::kWindSpeed).size() * campaign.nodes(AxisId::kFetch).size() *
         campaign.nodes(AxisId::kFootprint).size();
}

SeaCase SeaCaseOf(const Campaign& campaign, std::size_t index) {
  const std::size_t footprints = campaign.nodes(AxisId::kFootprint).size();
  const std::size_t fetches = campaign.nodes(AxisId::kFetch).size();
  SeaCase sea_case;
  const std::size_t fetch = index / footprints % fetches;
  sea_case.sea = SeaOf(campaign, campaign.nodes(AxisId::kWindSpeed)[index / footprints / fetches],
                       fetch + 1 < fetches ? campaign.nodes(AxisId::kFetch)[fetch] : kInfinity);
  sea_case.refractive_index = campaign.refractive_index;
  sea_case.depths = campaign.nodes(AxisId::kDepth);
  sea_case.rays = campaign.rays;
  for (const double incidence : campaign.nodes(AxisId::kIncidence)) {
    for (const double azimuth : campaign.nodes(AxisId::kAzimuth)) {
      sea_case.beams.push_back({.incidence = RadiansOfDegrees(incidence),
                                .azimuth = RadiansOfDegrees(azimuth),
                                .footprint = campaign.nodes(AxisId::kFootprint)[index % footprints],
                                .profile = campaign.profile,
                                .source_height = campaign.source_height});
    }
  }
  return sea_case;
}

SeaOptions SeaOf(const Campaign& campaign, double wind_speed, double fetch) {
  WindSea waves = campaign.wind_sea;
  waves.wind_speed_10m = wind_speed;
  waves.fetch = fetch;
  return {.waves = waves, .corrected_above = campaign.corrected_above};
}

}  // namespace albtpu
