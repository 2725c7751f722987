// Arbitrary text as a campaign is rejected with a reason, or all its sea cases (of the water column: its water cases)
// can be simulated and its table can be written.
#include <cmath>
#include <string_view>
#include <variant>

#include "generator/campaign/campaign.h"
#include "generator/campaign/water_cases.h"
#include "tables/format.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

using namespace albtpu;

void CheckSeaCase(const SeaCase& sea_case) {
  if (const auto* const waves = std::get_if<WindSea>(&sea_case.sea.waves)) {
    ALBTPU_MUST(std::isfinite(waves->wind_speed_10m) && waves->wind_speed_10m >= 0);
    ALBTPU_MUST(waves->fetch > 0);
  }
  ALBTPU_MUST(sea_case.refractive_index > 1 && std::isfinite(sea_case.refractive_index));
  ALBTPU_MUST(!sea_case.depths.empty() && sea_case.depths.front() >= 0);
  for (const BeamOptions& beam : sea_case.beams) {
    ALBTPU_MUST(beam.incidence >= 0 && std::cos(beam.incidence) > 0.49);
    ALBTPU_MUST(beam.footprint > 0 && std::isfinite(beam.footprint));
    ALBTPU_MUST(beam.source_height > 0);
  }
}

void CheckWater(const Campaign& campaign) {
  ALBTPU_MUST(WaterCaseCount(campaign) > 0);
  ALBTPU_MUST(campaign.refractive_index > 1 && campaign.water->group_index > 1);
  ALBTPU_MUST(campaign.water->photons >= 1000 && campaign.water->pairs_per_photon >= 1);
  const auto within = [&](WaterAxis axis, double x) {
    const std::vector<double>& nodes = campaign.axes[Index(axis)].nodes();
    return x >= nodes.front() * (1 - 1e-9) && x <= nodes.back() * (1 + 1e-9);
  };
  const CheckedBeam checked = CheckedBeamOf(campaign, 0);
  ALBTPU_MUST(within(WaterAxis::kBackscatterFraction, checked.backscatter_fraction));
  ALBTPU_MUST(within(WaterAxis::kScatteringOverAbsorption, checked.scattering_over_absorption));
  ALBTPU_MUST(within(WaterAxis::kIncidence, checked.beam.incidence));
  ALBTPU_MUST(within(WaterAxis::kOpticalDepth, checked.beam.optical_depth));
  ALBTPU_MUST(within(WaterAxis::kFieldOfView, checked.beam.field_of_view));
  ALBTPU_MUST(within(WaterAxis::kPulseLength, checked.beam.pulse_length));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const absl::StatusOr<Campaign> campaign = ParseCampaign(text);
  if (!campaign.ok()) {
    ALBTPU_MUST(!campaign.status().message().empty());
    ALBTPU_MUST(campaign.status().message().find('\n') == std::string_view::npos);
    return 0;
  }
  ALBTPU_MUST(campaign->text == text);
  std::size_t count = 1;
  for (const Axis& axis : campaign->axes) {
    ALBTPU_MUST(axis.size() <= format::kMaxNodeCount && axis.size() <= format::kMaxValueCount / count);
    count *= axis.size();
  }
  if (campaign->water) {
    CheckWater(*campaign);
    return 0;
  }
  ALBTPU_MUST(campaign->effort.realizations >= 2);
  ALBTPU_MUST(campaign->effort.most_realizations >= campaign->effort.realizations);
  CheckSeaCase(SeaCaseOf(*campaign, 0));
  CheckSeaCase(SeaCaseOf(*campaign, SeaCaseCount(*campaign) - 1));
  return 0;
}
