#include "generator/campaign/table_maker.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "generator/campaign/provenance.h"
#include "generator/campaign/water_cases.h"
#include "generator/math/statistics.h"
#include "status/status_macros.h"

namespace albtpu {
namespace {

// The nodes in the scale of their axis.
std::vector<double> Scaled(const Axis& axis) {
  std::vector<double> x = axis.nodes();
  if (axis.scale() == Scale::kLog)
    for (double& node : x) node = std::log(node);
  return x;
}

// The amount by which to lower each of the values at `x`: none at the last node and those before `first`.
std::vector<double> Lowering(const std::vector<double>& x, const std::vector<double>& values, std::size_t first) {
  const std::size_t last = x.size() - 1;
  std::vector<double> lowering(x.size());
  for (std::size_t i = first; i < last; ++i) {
    const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
    const double curvature =
        2 * ((values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before) / (before + after);
    lowering[i] = curvature * (std::pow(before, 3) + std::pow(after, 3)) / (12 * (before + after));
  }
  return lowering;
}

}  // namespace

void BalanceNodes(const UncertaintyTable::Axes& axes, Quantity quantity, std::vector<float>& values) {
  assert(values.size() == ValueCount(axes, quantity));
  const std::vector<float> exact = values;
  std::size_t stride = values.size();  // from one node of the axis to the next
  for (const AxisId id : kAxes) {
    if (id == AxisId::kDepth) break;  // the last axis
    const Axis& axis = axes[Index(id)];
    const std::size_t nodes = axis.size();
    stride /= nodes;
    if (nodes < 3) continue;
    const std::vector<double> x = Scaled(axis);
    const std::size_t first_lowered = id == AxisId::kWindSpeed && x.front() == 0 ? 2 : 1;
    std::vector<double> line(nodes);
    for (std::size_t first = 0; first < values.size(); ++first) {
      if (first / stride % nodes != 0) continue;
      for (std::size_t i = 0; i < nodes; ++i) line[i] = values[first + i * stride];
      const std::vector<double> lowering = Lowering(x, line, first_lowered);
      for (std::size_t i = 0; i < nodes; ++i) {
        const std::size_t at = first + i * stride;
        const double lowered = line[i] - lowering[i];
        const double least = Describe(quantity).is_bias ? lowered : 0.5 * exact[at];
        values[at] = static_cast<float>(std::max(lowered, least));
      }
    }
  }
}

// The variables of a table, filled in beam by beam.
class VariableGrid {
 public:
  explicit VariableGrid(const Campaign& campaign) : campaign_(campaign) {
    for (const Quantity quantity : kQuantities) {
      Variable& variable = variables_[Index(quantity)].emplace();
      variable.values.resize(ValueCount(campaign.axes, quantity));
      variable.standard_errors.resize(variable.values.size());
    }
  }

  // `beam` counts the beams of the sea case, `depth` the nodes of the depth axis. It is 0 for quantities without depth.
  void Set(Quantity quantity, std::size_t sea_case, std::size_t beam, std::size_t depth, const Estimate& estimate) {
    Variable& variable = *variables_[Index(quantity)];
    const std::size_t footprints = campaign_.nodes(AxisId::kFootprint).size();
    const std::size_t beams = campaign_.nodes(AxisId::kIncidence).size() * campaign_.nodes(AxisId::kAzimuth).size();
    const std::size_t depths = Describe(quantity).over_last_axis ? campaign_.nodes(AxisId::kDepth).size() : 1;
    const std::size_t sea = sea_case / footprints, footprint = sea_case % footprints;
    const std::size_t at = ((sea * beams + beam) * footprints + footprint) * depths + depth;
    variable.values[at] = static_cast<float>(estimate.value);
    variable.standard_errors[at] = static_cast<float>(estimate.standard_error);
  }

  UncertaintyTable::Variables Take() { return std::move(variables_); }

 private:
  const Campaign& campaign_;
  UncertaintyTable::Variables variables_;
};

namespace {

void Round(Variable& variable) {
  for (std::size_t i = 0; i < variable.values.size(); ++i) {
    const auto [value, standard_error] = Rounded({variable.values[i], variable.standard_errors[i]});
    variable.values[i] = static_cast<float>(value);
    variable.standard_errors[i] = static_cast<float>(standard_error);
  }
}

void Store(const BeamUncertainty& result, std::size_t sea_case, std::size_t beam, VariableGrid& grid) {
  grid.Set(Quantity::kRefractionAlongWind, sea_case, beam, 0, InDegrees(result.refraction_along_wind));
  grid.Set(Quantity::kRefractionCrossWind, sea_case, beam, 0, InDegrees(result.refraction_cross_wind));
  for (std::size_t d = 0; d < result.thu.size(); ++d) {
    grid.Set(Quantity::kThu, sea_case, beam, d, result.thu[d]);
    grid.Set(Quantity::kTvu, sea_case, beam, d, result.tvu[d]);
    grid.Set(Quantity::kBiasAlongBeam, sea_case, beam, d, result.bias_along_beam[d]);
    grid.Set(Quantity::kBiasVertical, sea_case, beam, d, result.bias_vertical[d]);
  }
}

bool HasShapeOf(const Campaign& campaign, const SeaCaseResult& result) {
  const std::size_t beams = campaign.nodes(AxisId::kIncidence).size() * campaign.nodes(AxisId::kAzimuth).size();
  const std::size_t depths = campaign.nodes(AxisId::kDepth).size();
  return result.beams.size() == beams &&
         std::all_of(result.beams.begin(), result.beams.end(), [&](const BeamUncertainty& beam) {
           return beam.thu.size() == depths && beam.tvu.size() == depths && beam.bias_along_beam.size() == depths &&
                  beam.bias_vertical.size() == depths;
         });
}

absl::Status NotFinite() {
  return absl::FailedPreconditionError(
      "has values that are not finite (rays met waves from behind); give smaller incidences or weaker winds");
}

absl::Status WrongShape() {
  return absl::DataLossError("does not have the beams and depths of its campaign; delete it");
}

}  // namespace

struct TableBuilder::Parts {
  explicit Parts(const Campaign& of) : campaign(of), origin(OriginOf(of)), direct(of.checked_pulses) {
    if (campaign.water) {
      water.resize(WaterCaseCount(campaign));
    } else {
      grid.emplace(campaign);
      results.resize(SeaCaseCount(campaign));
    }
  }

  const Campaign& campaign;
  UnitOrigin origin;
  std::vector<std::vector<Estimate>> direct;  // values at the checked pulses
  // Of a sea.
  std::optional<VariableGrid> grid;
  std::vector<SeaCaseResult> results;  // without their beams, which are in the grid
  // Of the water column, by case.
  std::vector<std::vector<Estimate>> water;
};

TableBuilder::TableBuilder(const Campaign& campaign) : parts_(new Parts(campaign)) {}

TableBuilder::~TableBuilder() = default;

absl::Status TableBuilder::Add(UnitId unit, std::string_view bytes) {
  ASSIGN_OR_RETURN(const std::string_view content, OpenUnit(unit, parts_->origin, bytes));
  if (unit.kind != UnitKind::kSeaCase) {
    ASSIGN_OR_RETURN(std::vector<Estimate> estimates, DecodeEstimates(content));
    const bool checks = unit.kind == UnitKind::kPulse;
    if (checks && estimates.size() != (parts_->campaign.water ? kCheckedEstimates : kChecked.size()))
      return WrongShape();
    const auto is_finite = [](const Estimate& estimate) { return std::isfinite(estimate.value); };
    if (checks && !std::all_of(estimates.begin(), estimates.end(), is_finite)) return NotFinite();
    (checks ? parts_->direct : parts_->water)[unit.index] = std::move(estimates);
    return absl::OkStatus();
  }
  ASSIGN_OR_RETURN(SeaCaseResult result, DecodeResult(content));
  if (!HasShapeOf(parts_->campaign, result)) return WrongShape();
  if (!std::all_of(result.beams.begin(), result.beams.end(), IsFinite)) return NotFinite();
  for (std::size_t beam = 0; beam < result.beams.size(); ++beam)
    Store(result.beams[beam], unit.index, beam, *parts_->grid);
  result.beams.clear();
  parts_->results[unit.index] = std::move(result);
  return absl::OkStatus();
}

absl::StatusOr<Table> TableBuilder::Build() {
  const Campaign& campaign = parts_->campaign;
  if (campaign.water) return BuildWaterTable(campaign, parts_->water, parts_->direct);
  UncertaintyTable::Variables variables = parts_->grid->Take();
  for (const Quantity quantity : kQuantities) {
    Variable& variable = *variables[Index(quantity)];
    if (campaign.balanced_nodes) BalanceNodes(campaign.axes, quantity, variable.values);
    Round(variable);
  }
  Provenance provenance = MakeProvenance(campaign, parts_->results);
  ASSIGN_OR_RETURN(const UncertaintyTable table,
                   UncertaintyTable::Create(campaign.kind(), campaign.axes, variables, provenance));
  std::vector<InterpolationError> errors;
  for (std::size_t q = 0; q < kChecked.size(); ++q)
    errors.push_back(CompareWithTable(campaign, table, parts_->direct, q));
  DescribeInterpolationErrors(errors, provenance);
  ASSIGN_OR_RETURN(const UncertaintyTable described,
                   UncertaintyTable::Create(campaign.kind(), campaign.axes, variables, std::move(provenance)));
  return described.table();
}

}  // namespace albtpu
