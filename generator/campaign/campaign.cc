#include "generator/campaign/campaign.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "command_line/one_line.h"
#include "generator/campaign/campaign_axes.h"
#include "generator/campaign/campaign_keys.h"
#include "generator/campaign/toml_reader.h"
#include "sea/angle.h"
#include "tables/format.h"
#include "tables/provenance.h"

namespace albtpu {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A campaign of hundreds of nodes has a tenth of this. A longer text could nest keys so deeply ("a.a.a ...") that the
// TOML parser, which recurses into each level, would overflow the stack.
constexpr std::size_t kMostBytes = 32768;

WindSea ReadWindSea(TomlReader& toml) {
  WindSea sea;
  const std::string spectrum = ReadText(toml, campaign_keys::kSpectrum);
  for (const CampaignKey& key : {campaign_keys::kSpectrum, campaign_keys::kSpreading}) {
    if (toml.Has(campaign_keys::kSeaFile.table, campaign_keys::kSeaFile.name) &&
        toml.Has(key.table, key.name)) {
      toml.Fail(absl::StrCat("'", FullName(key), "' has no effect on the sea of 'sea.file': leave it out"));
    }
  }
  if (const SpectrumModel* model = FindSpectrumModel(spectrum)) sea.model = model;
  const std::optional<double> spreading = ReadNumber(toml, campaign_keys::kSpreading);
  if (spreading && !sea.model->takes_spreading) {
    toml.Fail(absl::StrCat("'sea.spreading' is not taken by \"", spectrum,
                           "\", which has a spreading of its own: leave it out"));
  }
  sea.spreading = spreading.value_or(sea.spreading);
  return sea;
}

// Nothing without `sea.file`, which all other keys of that sea need.
std::optional<SeaOfFile> ReadSeaOfFile(TomlReader& toml) {
  using namespace campaign_keys;
  SeaOfFile sea;
  sea.file = ReadText(toml, kSeaFile);
  if (const std::string time = ReadText(toml, kSeaTime); !time.empty()) sea.time = time;
  sea.water_depth = ReadNumber(toml, kSeaDepth);
  sea.wind_speed = ReadNumber(toml, kSeaWindSpeed);
  sea.wind_from = ReadNumber(toml, kSeaWindFrom);
  sea.tail = FindTailRule(ReadText(toml, kSeaTail)).value_or(sea.tail);
  sea.tail_from = ReadNumber(toml, kSeaTailFrom);
  if (!sea.file.empty()) return sea;
  for (const CampaignKey& key : {kSeaTime, kSeaDepth, kSeaWindSpeed, kSeaWindFrom, kSeaTail, kSeaTailFrom}) {
    if (toml.Has(key.table, key.name)) {
      toml.Fail(
          absl::StrCat("'", FullName(key), "' goes with 'sea.file' only: add the file, or leave it out"));
    }
  }
  return std::nullopt;
}

Effort ReadEffort(TomlReader& toml) {
  using namespace campaign_keys;
  Effort effort;
  effort.realizations = static_cast<int>(*ReadWhole(toml, kRealizations));
  effort.relative_error = ReadNumber(toml, kRelativeError).value_or(0);
  effort.estimator = FindEstimator(ReadText(toml, kEstimator)).value_or(effort.estimator);
  const int most = effort.relative_error > 0 ? std::max(effort.realizations, kMaxRealizationsUnlessGiven)
                                             : effort.realizations;
  const auto& range = std::get<WholeRange>(kMaxRealizationsOfBeam.values);
  effort.most_realizations =
      static_cast<int>(toml.Integer(kMaxRealizationsOfBeam.table, kMaxRealizationsOfBeam.name,
                                    std::max<std::int64_t>(effort.realizations, range.least), range.most)
                           .value_or(most));
  return effort;
}

// Checks before the computation the limits that the table would check after it.
absl::Status CheckTable(const Campaign& campaign) {
  std::size_t max_nodes = format::kMaxValueCount;  // divided, since the product of all axes could overflow
  for (const Axis& axis : campaign.axes) max_nodes /= axis.size();
  if (max_nodes == 0) {
    return absl::InvalidArgumentError(absl::StrCat("the axes make more cells than a table holds (",
                                                   format::kMaxValueCount, "): give fewer nodes"));
  }
  Provenance provenance;
  provenance.id = campaign.id;
  provenance.version = campaign.version;
  provenance.title = campaign.title;
  provenance.campaign = campaign.text;
  // It quotes texts of the file, which may have line breaks.
  const absl::Status status = CheckProvenance(provenance);
  return status.ok() ? status : absl::InvalidArgumentError(OneLine(std::string(status.message())));
}

// The keys of all kinds.
struct CampaignHead {
  std::string text, id, version, title;
  std::uint64_t seed;
};

absl::StatusOr<Campaign> ParseWater(TomlReader& toml, const CampaignHead& head) {
  const Nodes nodes = ReadNodesOfWater(toml);
  const std::optional<double> refractive_index = ReadNumber(toml, campaign_keys::kRefractiveIndexOfWater);
  const std::optional<double> group_index = ReadNumber(toml, campaign_keys::kGroupIndex);
  const std::optional<std::int64_t> photons = ReadWhole(toml, campaign_keys::kPhotons);
  const std::optional<std::int64_t> pairs = ReadWhole(toml, campaign_keys::kPairs);
  const std::optional<std::int64_t> checked = ReadWhole(toml, campaign_keys::kCheckedBeams);
  if (const absl::Status status = toml.Finish(); !status.ok()) return status;
  absl::StatusOr<UncertaintyTable::Axes> axes = MakeWaterAxes(nodes);
  if (!axes.ok()) return axes.status();
  Campaign campaign{.text = head.text,
                    .id = head.id,
                    .version = head.version,
                    .title = head.title,
                    .seed = head.seed,
                    .axes = *std::move(axes),
                    .refractive_index = *refractive_index,
                    .wind_sea = {},
                    .sea = std::nullopt,
                    .water = WaterWork{.group_index = *group_index,
                                       .photons = static_cast<std::uint32_t>(*photons),
                                       .pairs_per_photon = static_cast<int>(*pairs)},
                    .effort = {},
                    .rays = std::nullopt,
                    .checked_pulses = static_cast<std::size_t>(*checked)};
  if (const absl::Status status = CheckTable(campaign); !status.ok()) return status;
  return campaign;
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

  const std::string id = ReadText(toml, campaign_keys::kId);
  const std::string version = ReadText(toml, campaign_keys::kVersion);
  const std::string title = ReadText(toml, campaign_keys::kTitle);
  const std::string kind = ReadText(toml, campaign_keys::kKind);
  const std::optional<std::int64_t> seed = ReadWhole(toml, campaign_keys::kSeed);
  if (kind == kWaterColumn.name)
    return ParseWater(toml,
                      {std::string(text), id, version, title, static_cast<std::uint64_t>(seed.value_or(1))});
  const std::optional<SeaOfFile> sea_of_file = ReadSeaOfFile(toml);
  const Nodes nodes = ReadNodesOfSea(toml, sea_of_file.has_value());
  const std::string profile = ReadText(toml, campaign_keys::kProfile);
  const std::optional<double> source_height = ReadNumber(toml, campaign_keys::kSourceHeight);
  const std::optional<double> refractive_index = ReadNumber(toml, campaign_keys::kRefractiveIndexOfWater);
  const WindSea wind_sea = ReadWindSea(toml);
  const std::optional<double> corrected_above = ReadNumber(toml, campaign_keys::kCorrectedAbove);
  const Effort effort = ReadEffort(toml);
  const std::optional<std::int64_t> rays = ReadWhole(toml, campaign_keys::kRays);
  const std::string node_values = ReadText(toml, campaign_keys::kNodes);
  const std::optional<std::int64_t> checked_pulses = ReadWhole(toml, campaign_keys::kCheckedPulses);
  if (const absl::Status status = toml.Finish(); !status.ok()) return status;

  std::optional<TracedSea> sea;
  if (sea_of_file) {
    absl::StatusOr<TracedSea> traced = ReadTracedSea(*sea_of_file);
    if (!traced.ok()) return traced.status();
    sea = *std::move(traced);
  }
  absl::StatusOr<UncertaintyTable::Axes> axes =
      sea ? MakeAxes(*sea, nodes) : MakeAxes(*wind_sea.model, nodes);
  if (!axes.ok()) return axes.status();
  Campaign campaign{.text = std::string(text),
                    .id = id,
                    .version = version,
                    .title = title,
                    .seed = static_cast<std::uint64_t>(*seed),
                    .axes = *std::move(axes),
                    .profile = *FindBeamProfile(profile),
                    .source_height = *source_height,
                    .refractive_index = *refractive_index,
                    .wind_sea = wind_sea,
                    .sea = std::move(sea),
                    .water = std::nullopt,
                    .corrected_above = *corrected_above,
                    .effort = effort,
                    .rays = rays ? std::optional<int>(static_cast<int>(*rays)) : std::nullopt};
  campaign.balanced_nodes = node_values == "balanced";
  campaign.checked_pulses = static_cast<std::size_t>(*checked_pulses);
  if (const absl::Status status = CheckTable(campaign); !status.ok()) return status;
  return campaign;
}

absl::StatusOr<Campaign> ReadCampaign(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return absl::InvalidArgumentError(absl::StrCat(path.string(), ": is a folder; name a campaign file"));
  }
  std::ifstream file(path, std::ios::binary);
  if (!file)
    return absl::NotFoundError(absl::StrCat(path.string(), ": no such campaign file, or it cannot be read"));
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
      // Over the sea of a file, the beam at 180 degrees is that at 0.
      sea_case.beams.push_back({.incidence = RadiansOfDegrees(incidence),
                                .azimuth = RadiansOfDegrees(azimuth == 180 ? 0 : azimuth),
                                .footprint = campaign.nodes(AxisId::kFootprint)[index % footprints],
                                .profile = campaign.profile,
                                .source_height = campaign.source_height});
    }
  }
  return sea_case;
}

SeaOptions SeaOf(const Campaign& campaign, double wind_speed, double fetch) {
  if (campaign.sea) return {.waves = campaign.sea->waves, .corrected_above = campaign.corrected_above};
  WindSea waves = campaign.wind_sea;
  waves.wind_speed_10m = wind_speed;
  waves.fetch = fetch;
  return {.waves = waves, .corrected_above = campaign.corrected_above};
}

}  // namespace albtpu
