#include "generator/campaign/campaign_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "generator/campaign/campaign_keys.h"
#include "status/status_macros.h"
#include "tables/water/water_schema.h"

namespace albtpu {
namespace {

// Nodes are kept in single precision, as in tables: 0.1 in the file becomes the float nearest to it.
std::vector<double> InSinglePrecision(std::vector<double> nodes) {
  for (double& node : nodes) node = static_cast<float>(node);
  return nodes;
}

// The smallest float at or above `x`.
double FloatNotBelow(double x) {
  const float nearest = static_cast<float>(x);
  return nearest >= x ? nearest : std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

// `inf` as the last fetch becomes the shortest fetch at which the sea of the strongest wind is fully developed: there
// the seas of all winds are, and beyond it nothing changes.
absl::Status ResolveFetch(const SpectrumModel& model, std::vector<double>& fetch,
                          const std::vector<double>& wind_speed) {
  if (fetch.empty() || fetch.back() != campaign_keys::kInfinity) {
    return absl::InvalidArgumentError(
        "the last node of 'axes.fetch' must be inf, the fully developed sea: beyond it nothing changes");
  }
  const double strongest = *std::max_element(wind_speed.begin(), wind_speed.end());
  // A calm is the same at any fetch.
  const double developed = strongest > 0 ? FloatNotBelow(model.fully_developed_fetch(strongest)) : 1;
  fetch.back() = developed;
  if (fetch.size() > 1 && !(fetch[fetch.size() - 2] < developed)) {
    return absl::InvalidArgumentError(absl::StrCat("node ", fetch.size() - 2, " of 'axes.fetch', ",
                                                   fetch[fetch.size() - 2],
                                                   " m, is beyond full development of the strongest wind (", developed,
                                                   " m): leave it out, the last node is that sea"));
  }
  return absl::OkStatus();
}

// In the order of AxisId.
constexpr std::array<CampaignKey, kAxisCount> kAxisKeys = {campaign_keys::kWindSpeed, campaign_keys::kFetch,
                                                           campaign_keys::kIncidence, campaign_keys::kAzimuth,
                                                           campaign_keys::kFootprint, campaign_keys::kDepth};

// In the order of WaterAxis.
constexpr std::array kWaterAxisKeys = {campaign_keys::kBackscatterFraction, campaign_keys::kScatteringOverAbsorption,
                                       campaign_keys::kIncidenceOnWater,    campaign_keys::kOpticalDepth,
                                       campaign_keys::kFieldOfView,         campaign_keys::kPulseLength};
static_assert(kWaterAxisKeys.size() == kAxisCount);

}  // namespace

Nodes ReadNodesOfSea(CampaignFile& file) {
  Nodes nodes;
  for (const AxisId axis : kAxes) nodes[Index(axis)] = InSinglePrecision(ReadNodes(file, kAxisKeys[Index(axis)]));
  return nodes;
}

Nodes ReadNodesOfWater(CampaignFile& file) {
  Nodes nodes;
  for (std::size_t axis = 0; axis < kAxisCount; ++axis)
    nodes[axis] = InSinglePrecision(ReadNodes(file, kWaterAxisKeys[axis]));
  return nodes;
}

absl::StatusOr<UncertaintyTable::Axes> AxesOfKind(const TableSchema& kind, const Nodes& nodes) {
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    ASSIGN_OR_RETURN(Axis axis, Axis::Create(kind.axes[i], nodes[i]));
    axes.push_back(std::move(axis));
  }
  return UncertaintyTable::Axes{axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]};
}

absl::StatusOr<UncertaintyTable::Axes> MakeAxes(const SpectrumModel& model, Nodes nodes) {
  for (const AxisId axis : kAxes) {
    const std::string problem = NodesProblem(kAxisKeys[Index(axis)], nodes[Index(axis)]);
    if (!problem.empty()) return absl::InvalidArgumentError(problem);
  }
  RETURN_IF_ERROR(ResolveFetch(model, nodes[Index(AxisId::kFetch)], nodes[Index(AxisId::kWindSpeed)]));

  return AxesOfKind(kSeaSurface, nodes);
}

absl::StatusOr<UncertaintyTable::Axes> MakeWaterAxes(const Nodes& nodes) {
  for (std::size_t axis = 0; axis < kAxisCount; ++axis) {
    const std::string problem = NodesProblem(kWaterAxisKeys[axis], nodes[axis]);
    if (!problem.empty()) return absl::InvalidArgumentError(problem);
  }
  const std::vector<double>& incidence = nodes[Index(WaterAxis::kIncidence)];
  if (incidence.front() != 0) {
    return absl::InvalidArgumentError(absl::StrCat("the first node of 'axes.incidence' is ", incidence.front(),
                                                   " degrees; a table of the water column begins at 0, the vertical"));
  }
  return AxesOfKind(kWaterColumn, nodes);
}

}  // namespace albtpu
