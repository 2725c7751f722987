#include "service/server/calls/query_budget.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "budget/query/query_check.h"
#include "budget/water/water_columns.h"
#include "service/error_message.h"
#include "service/seas/sea_summary.h"
#include "service/server/calls/water_request.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"
#include "service/server/tables/wire_enums.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

std::array<double, 3> Read(const v1::ForwardRightDown& v) { return {v.forward(), v.right(), v.down()}; }

}  // namespace

absl::StatusOr<BudgetOptions> ReadBudgetOptions(const v1::BudgetOptions& options) {
  ASSIGN_OR_RETURN(const Coverage coverage, FromWire(options.coverage()));
  ASSIGN_OR_RETURN(const SurfaceLocation located, FromWire(options.located()));
  BudgetOptions read{.errors = FromMessage(options.errors()),
                     .located = located,
                     .lever_arm = Read(options.lever_arm()),
                     .datum = options.datum(),
                     .extra_horizontal = options.extra_horizontal(),
                     .extra_vertical = options.extra_vertical(),
                     .coverage = coverage};
  if (options.has_refractive_index()) read.index = options.refractive_index();
  FieldViolations violations;
  for (const OptionError& error : FindErrors(read))
    violations.Add(absl::StrCat("options.", error.field), absl::StrCat("options.", error.problem));
  if (!(std::abs(options.sea_axis()) <= kGreatestBudgetNumber)) {
    violations.Add("options.sea_axis",
                   absl::StrCat("options.sea_axis is ", options.sea_axis(), ": expected degrees, or leave it out"));
  }
  RETURN_IF_ERROR(violations.ToStatus());
  return read;
}

std::array<RequestColumn, kAircraftInputs.size()> ColumnsOf(const v1::AircraftColumns& aircraft) {
  static const std::string* const kScratch = new std::string();
  std::array<RequestColumn, kAircraftInputs.size()> columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {  // Field i + 1 is input i.
    const BudgetInput input = kAircraftInputs[i];
    const std::string& bytes = aircraft.GetReflection()->GetStringReference(
        aircraft, v1::AircraftColumns::descriptor()->FindFieldByNumber(static_cast<int>(i) + 1),
        const_cast<std::string*>(kScratch));
    columns[i] = {"aircraft", kBudgetInputNames[static_cast<std::size_t>(input)], &bytes, IsRequired(input)};
  }
  return columns;
}

namespace {

using BudgetSelection = std::array<bool, kBudgetQuantityCount>;

// The quantities that the request names, or THU and TVU of the total if it names none.
absl::StatusOr<BudgetSelection> ReadBudgetQuantities(const v1::QueryBudgetRequest& request) {
  BudgetSelection selection{};
  for (const int number : request.quantities()) {
    ASSIGN_OR_RETURN(const BudgetQuantity quantity, FromWire(static_cast<v1::BudgetQuantity>(number)));
    selection[static_cast<std::size_t>(quantity)] = true;
  }
  if (request.quantities_size() == 0) {
    selection[static_cast<std::size_t>(BudgetQuantity::kTotalThu)] = true;
    selection[static_cast<std::size_t>(BudgetQuantity::kTotalTvu)] = true;
  }
  return selection;
}

// Refers to the request.
absl::StatusOr<BudgetPulses> ReadPulses(const v1::QueryBudgetRequest& request, const TableSchema& schema) {
  const auto axes = ColumnsOf(request.pulses(), schema);
  const auto aircraft = ColumnsOf(request.aircraft());
  std::vector<RequestColumn> all(axes.begin(), axes.end());
  all.insert(all.end(), aircraft.begin(), aircraft.end());
  ASSIGN_OR_RETURN(const std::size_t count, CountPulses(all));
  BudgetPulses pulses{.pulses = PulsesOf(axes, count)};
  pulses.aircraft.size = count;
  for (std::size_t i = 0; i < aircraft.size(); ++i) pulses.aircraft[kAircraftInputs[i]] = aircraft[i].numbers();
  return pulses;
}

std::size_t AnswerBytes(const BudgetSelection& selection) {
  std::size_t bytes = 2;  // Outcome and axis.
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    const auto quantity = static_cast<BudgetQuantity>(i);
    if (!selection[i]) continue;
    bytes += quantity == BudgetQuantity::kBestS44Order ? 1 : ColumnCount(quantity) * sizeof(float);
  }
  return bytes;
}

absl::Status CheckAnswerSize(const BudgetSelection& selection, std::size_t count) {
  const std::size_t most = kMaxAnswerColumnBytes / AnswerBytes(selection);
  if (count <= most) return absl::OkStatus();
  return FieldViolation("pulses",
                        absl::StrCat("there are ", count, " pulses: with these quantities, a message takes ", most,
                                     " pulses at most; send several messages, or ask for fewer quantities"));
}

// Adds the columns that were requested. The number of a field is that of its quantity.
BudgetAnswers AddColumns(const BudgetSelection& selection, std::size_t count, ColumnMessage& message) {
  using Fields = v1::QueryBudgetResponse;
  const auto add_bytes = [&](int field) { return reinterpret_cast<std::uint8_t*>(message.AddColumn(field, count)); };
  BudgetAnswers answers;
  answers.outcomes = add_bytes(Fields::kOutcomesFieldNumber);
  answers.outcome_axes = add_bytes(Fields::kOutcomeAxesFieldNumber);
  const std::size_t mark = message.Mark();
  for (std::size_t i = 0; i < kBudgetQuantityCount; ++i) {
    if (!selection[i]) continue;
    const auto quantity = static_cast<BudgetQuantity>(i);
    const int field = ToWire(quantity);
    if (quantity == BudgetQuantity::kBestS44Order) {
      answers.best_s44_orders = add_bytes(field);
      continue;
    }
    const std::size_t columns = ColumnCount(quantity);
    auto* const numbers = reinterpret_cast<float*>(message.AddColumn(field, columns * count * sizeof(float)));
    for (std::size_t k = 0; k < columns; ++k) answers.columns[FirstColumn(quantity) + k] = numbers + k * count;
  }
  message.Nest(Fields::kBudgetFieldNumber, mark);
  return answers;
}

// The index of a water, where the options or the state of the water give it.
std::optional<double> IndexOf(const v1::QueryBudgetRequest& request, const std::optional<KnownWater>& water) {
  if (request.options().has_refractive_index()) return request.options().refractive_index();
  const std::optional<WaterIndex> index = water.has_value() ? water->index() : std::nullopt;
  return index.has_value() ? std::optional(index->phase) : std::nullopt;
}

// The columns of a water belong to a request without one, and a level is not found by a laser.
absl::StatusOr<std::optional<KnownWater>> ReadWaterOf(const v1::QueryBudgetRequest& request) {
  if (!request.has_water()) return std::nullopt;
  for (const RequestColumn& column : ColumnsOf(request.aircraft())) {
    if (column.bytes->empty() || !absl::StartsWith(std::string(column.name), "water_")) continue;
    return FieldViolation("water", absl::StrCat("water and aircraft.", std::string(column.name),
                                                " are both given (the server computes all columns of the water); give "
                                                "one of them"));
  }
  if (request.water().green_surface() && request.options().located() == v1::SURFACE_LOCATION_LEVEL)
    return FieldViolation("water.green_surface",
                          "water.green_surface has no effect with SURFACE_LOCATION_LEVEL; leave it out");
  ASSIGN_OR_RETURN(KnownWater water, ReadWater(request.water()));
  return water;
}

// The water of a request, with its columns at the pulses.
struct WaterOfRequest {
  const ServedWater* served = nullptr;
  WaterBatch batch;

  // The first axis on which a pulse is beyond the water; nullopt of others.
  std::optional<AxisId> Beyond(const PulseColumns& pulses, std::size_t i) const {
    if (served == nullptr || !batch.is_beyond(i)) return std::nullopt;
    const WaterContribution& share = *served->water.share;
    const auto at = [&](AxisId axis) { return pulses[axis][pulses[axis].size() == 1 ? 0 : i]; };
    if (at(AxisId::kIncidence) > share.greatest_incidence()) return AxisId::kIncidence;
    return at(AxisId::kFootprint) > share.greatest_footprint() ? AxisId::kFootprint : AxisId::kDepth;
  }
};

// The columns of `pulses` refer to the result.
WaterOfRequest TakeWater(const ServedWater& served, BudgetOptions& options, BudgetPulses& pulses) {
  WaterOfRequest water{.served = &served, .batch = {}};
  ComputeWater(served.water, options.index,
               {.size = pulses.pulses.size,
                .incidence = pulses.pulses[AxisId::kIncidence],
                .depth = pulses.pulses[AxisId::kDepth],
                .footprint = pulses.pulses[AxisId::kFootprint]},
               water.batch);
  pulses.aircraft[BudgetInput::kWaterSigmaAlong] = water.batch.sigma_along;
  pulses.aircraft[BudgetInput::kWaterSigmaVertical] = water.batch.sigma_vertical;
  pulses.aircraft[BudgetInput::kWaterCorrelation] = water.batch.correlation;
  pulses.aircraft[BudgetInput::kWaterNoise] = water.batch.noise;
  pulses.aircraft[BudgetInput::kWaterBiasAlong] = water.batch.bias_along;
  pulses.aircraft[BudgetInput::kWaterBiasVertical] = water.batch.bias_vertical;
  if (served.water.surface.has_value()) AddGreenSpread(*served.water.surface, options.located, options.errors);
  return water;
}

// Pulses beyond the water, whose columns have no number, are not invalid: they are out of its domain.
void StateBeyond(const WaterOfRequest& water, const PulseColumns& pulses, const BudgetAnswers& answers) {
  for (std::size_t i = 0; i < pulses.size; ++i) {
    if (answers.outcomes[i] != v1::OUTCOME_INVALID || answers.outcome_axes[i] != 0) continue;
    const std::optional<AxisId> axis = water.Beyond(pulses, i);
    if (!axis.has_value()) continue;
    answers.outcomes[i] = v1::OUTCOME_OUT_OF_DOMAIN;
    answers.outcome_axes[i] = static_cast<std::uint8_t>(ToWire(*axis));
  }
}

v1::WaterSummary WriteWater(const ServedWater& served, SurfaceLocation located) {
  v1::WaterSummary summary = served.summary;
  if (!served.water.surface.has_value() && located != SurfaceLocation::kLevel)
    summary.add_assumptions("The returns that located the surface lie on it, as those of an infrared laser.");
  return summary;
}

}  // namespace

absl::Status QueryBudget(AnswerSources& sources, const v1::QueryBudgetRequest& request, ColumnMessage& response,
                         OutcomeTally& tally) {
  ASSIGN_OR_RETURN(const std::optional<KnownWater> known_water, ReadWaterOf(request));
  const std::optional<double> index = IndexOf(request, known_water);
  v1::QueryOptions query;
  query.set_table(request.options().table());
  if (index.has_value()) query.set_refractive_index(*index);
  ASSIGN_OR_RETURN(const QueryPlan plan, PlanQuery(query, request.has_sea() ? &request.sea() : nullptr, sources));
  ASSIGN_OR_RETURN(BudgetOptions options, ReadBudgetOptions(request.options()));
  options.index = index.value_or(options.index);
  ASSIGN_OR_RETURN(const BudgetSelection selection, ReadBudgetQuantities(request));
  const ServedTable& source = *plan.source;
  ASSIGN_OR_RETURN(BudgetPulses pulses, ReadPulses(request, source.table.schema()));
  const std::size_t count = pulses.pulses.size;
  RETURN_IF_ERROR(CheckAnswerSize(selection, count));
  WaterOfRequest water;
  if (known_water.has_value()) {
    ASSIGN_OR_RETURN(const ServedWater* const served, sources.Find(request.water(), *known_water));
    water = TakeWater(*served, options, pulses);
  }
  v1::QueryBudgetResponse head;
  *head.mutable_table() = WriteReference(source);
  head.set_coverage(ToWire(options.coverage));
  head.set_pulse_count(static_cast<int>(count));
  head.set_azimuth_absent(pulses.pulses[AxisId::kAzimuth].empty());
  if (source.sea) *head.mutable_sea() = WriteSea(*source.sea);
  head.set_refractive_index(source.refractive_index);
  if (water.served != nullptr) *head.mutable_water() = WriteWater(*water.served, options.located);
  response.Add(head);
  if (source.sea) pulses.pulses = OnOneSea(pulses.pulses);
  if (source.sea)
    pulses.sea_axis = source.sea->x_azimuth;
  else if (request.options().has_sea_axis())
    pulses.sea_axis = request.options().sea_axis();
  const BudgetAnswers answers = AddColumns(selection, count, response);
  QueryBudgetOnAllCores(source.interpolator, pulses, options, answers);
  StateBeyond(water, pulses.pulses, answers);
  tally.Add({answers.outcomes, count}, {answers.outcome_axes, count});
  return absl::OkStatus();
}

}  // namespace albtpu::server
