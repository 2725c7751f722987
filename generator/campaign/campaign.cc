#include "generator/campaign/campaign.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"
#include "generator/campaign/campaign_file.h"
#include "generator/campaign/campaign_keys.h"
#include "sea/angle.h"
#include "status/status_macros.h"
#include "tables/format.h"
#include "tables/provenance.h"

namespace albtpu {
namespace {

WindSea ReadWindSea(CampaignFile& file) {
  WindSea sea;
  const std::string spectrum = ReadText(file, campaign_keys::kSpectrum);
  if (const SpectrumModel* model = FindSpectrumModel(spectrum)) sea.model = model;
  const std::optional<double> spreading = ReadNumber(file, campaign_keys::kSpreading);
  if (spreading && !sea.model->takes_spreading) {
    file["sea"].Fail("spreading", absl::StrCat("is not taken by \"", spectrum,
                                               "\", which has a spreading of its own; leave it out"));
  }
  sea.spreading = spreading.value_or(sea.spreading);
  return sea;
}

Effort ReadEffort(CampaignFile& file) {
  using namespace campaign_keys;
  Effort effort;
  effort.realizations = static_cast<int>(*ReadWhole(file, kRealizations));
  effort.relative_error = ReadNumber(file, kRelativeError).value_or(0);
  effort.estimator = FindEstimator(ReadText(file, kEstimator)).value_or(effort.estimator);
  const int most = std::max(effort.realizations, kMaxRealizationsUnlessGiven);
  const auto& range = std::get<WholeRange>(kMaxRealizationsOfBeam.values);
  effort.most_realizations =
      static_cast<int>(file[kMaxRealizationsOfBeam.table]
                           .WholeNumber(kMaxRealizationsOfBeam.name,
                                        std::max<std::int64_t>(effort.realizations, range.least), range.most)
                           .value_or(most));
  if (effort.relative_error == 0) effort.most_realizations = effort.realizations;
  return effort;
}

// Checks before the computation the limits that the table would check after it.
absl::Status CheckTable(const Campaign& campaign) {
  std::size_t max_nodes = format::kMaxValueCount;  // divided, since the product of all axes could overflow
  for (const Axis& axis : campaign.axes) max_nodes /= axis.size();
  if (max_nodes == 0) {
    return absl::InvalidArgumentError(
        absl::StrCat("the axes make more cells than a table holds (", format::kMaxValueCount, "): give fewer nodes"));
  }
  Provenance provenance;
  provenance.id = campaign.id;
  provenance.version = campaign.version;
  provenance.title = campaign.title;
  provenance.campaign = campaign.text;
  // It quotes texts of the file, which may have line breaks.
  const absl::Status status = CheckProvenance(provenance);
  return status.ok() ? status : absl::InvalidArgumentError(formats::OneLine(std::string(status.message())));
}

// Checks the sea of the strongest wind and the longest fetch, which is the steepest and the highest.
absl::Status CheckSeas(const Campaign& campaign) {
  const absl::Status status = CheckTraceable(SeaCaseOf(campaign, SeaCaseCount(campaign) - 1));
  if (status.ok()) return status;
  return absl::InvalidArgumentError(absl::StrCat("the sea of the strongest wind, ",
                                                 campaign.nodes(AxisId::kWindSpeed).back(),
                                                 " m/s: ", std::string(status.message())));
}

// The keys of all kinds.
struct CampaignHead {
  std::string text, id, version, title;
  std::uint64_t seed;
};

absl::StatusOr<Campaign> ParseWater(CampaignFile& file, const CampaignHead& head) {
  const Nodes nodes = ReadNodesOfWater(file);
  const std::optional<double> refractive_index = ReadNumber(file, campaign_keys::kRefractiveIndexOfWater);
  const std::optional<double> group_index = ReadNumber(file, campaign_keys::kGroupIndex);
  const std::optional<std::int64_t> photons = ReadWhole(file, campaign_keys::kPhotons);
  const std::optional<std::int64_t> pairs = ReadWhole(file, campaign_keys::kPairs);
  const std::optional<std::int64_t> checked = ReadWhole(file, campaign_keys::kCheckedBeams);
  RETURN_IF_ERROR(file.Finish());
  ASSIGN_OR_RETURN(UncertaintyTable::Axes axes, MakeWaterAxes(nodes));
  Campaign campaign{.text = head.text,
                    .id = head.id,
                    .version = head.version,
                    .title = head.title,
                    .seed = head.seed,
                    .axes = std::move(axes),
                    .refractive_index = *refractive_index,
                    .wind_sea = {},
                    .water = WaterWork{.group_index = *group_index,
                                       .photons = static_cast<std::uint32_t>(*photons),
                                       .pairs_per_photon = static_cast<int>(*pairs)},
                    .effort = {},
                    .rays = std::nullopt,
                    .checked_pulses = static_cast<std::size_t>(*checked)};
  RETURN_IF_ERROR(CheckTable(campaign));
  return campaign;
}

}  // namespace

absl::StatusOr<Campaign> ParseCampaign(std::string_view text) {
  ASSIGN_OR_RETURN(const toml::table root, config::ParseToml(text, kCampaignFile));
  CampaignFile file(root);

  const std::string id = ReadText(file, campaign_keys::kId);
  const std::string version = ReadText(file, campaign_keys::kVersion);
  const std::string title = ReadText(file, campaign_keys::kTitle);
  const std::string kind = ReadText(file, campaign_keys::kKind);
  const std::optional<std::int64_t> seed = ReadWhole(file, campaign_keys::kSeed);
  if (kind == kWaterColumn.name)
    return ParseWater(file, {std::string(text), id, version, title, static_cast<std::uint64_t>(seed.value_or(1))});
  if (file["sea"].Has("file")) {
    file["sea"].Fail("file",
                     "is no key of a campaign file; make the table of a measured sea by albtpu-query sea FILE "
                     "--output TABLE.h5");
  }
  const Nodes nodes = ReadNodesOfSea(file);
  const std::string profile = ReadText(file, campaign_keys::kProfile);
  const std::optional<double> source_height = ReadNumber(file, campaign_keys::kSourceHeight);
  const std::optional<double> refractive_index = ReadNumber(file, campaign_keys::kRefractiveIndexOfWater);
  const WindSea wind_sea = ReadWindSea(file);
  const std::optional<double> corrected_above = ReadNumber(file, campaign_keys::kCorrectedAbove);
  const Effort effort = ReadEffort(file);
  const std::optional<std::int64_t> rays = ReadWhole(file, campaign_keys::kRays);
  const std::string node_values = ReadText(file, campaign_keys::kNodes);
  const std::optional<std::int64_t> checked_pulses = ReadWhole(file, campaign_keys::kCheckedPulses);
  RETURN_IF_ERROR(file.Finish());

  ASSIGN_OR_RETURN(UncertaintyTable::Axes axes, MakeAxes(*wind_sea.model, nodes));
  Campaign campaign{.text = std::string(text),
                    .id = id,
                    .version = version,
                    .title = title,
                    .seed = static_cast<std::uint64_t>(*seed),
                    .axes = std::move(axes),
                    .profile = *FindBeamProfile(profile),
                    .source_height = *source_height,
                    .refractive_index = *refractive_index,
                    .wind_sea = wind_sea,
                    .water = std::nullopt,
                    .corrected_above = *corrected_above,
                    .effort = effort,
                    .rays = rays ? std::optional<int>(static_cast<int>(*rays)) : std::nullopt};
  campaign.balanced_nodes = node_values == "balanced";
  campaign.checked_pulses = static_cast<std::size_t>(*checked_pulses);
  RETURN_IF_ERROR(CheckTable(campaign));
  RETURN_IF_ERROR(CheckSeas(campaign));
  return campaign;
}

absl::StatusOr<Campaign> ReadCampaign(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const std::string text, config::ReadTomlText(path, kCampaignFile));
  absl::StatusOr<Campaign> campaign = ParseCampaign(text);
  if (!campaign.ok()) return config::InFile(path, campaign.status());
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
                       fetch + 1 < fetches ? campaign.nodes(AxisId::kFetch)[fetch] : campaign_keys::kInfinity);
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
