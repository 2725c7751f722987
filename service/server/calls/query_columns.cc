#include "service/server/calls/query_columns.h"

#include <array>
#include <cstdint>

#include "absl/status/statusor.h"
#include "service/seas/sea_pulses.h"
#include "service/server/calls/query_plan.h"
#include "service/server/calls/request_columns.h"
#include "service/server/tables/table_messages.h"
#include "service/server/tables/wire_enums.h"

namespace albtpu::server {
namespace {

using QuantitySelection = std::array<bool, kQuantityCount>;

// The quantities that the request names, or all if it names none.
absl::StatusOr<QuantitySelection> ReadQuantities(const v1::QueryColumnsRequest& request) {
  QuantitySelection selection;
  selection.fill(request.quantities_size() == 0);
  for (int number : request.quantities()) {
    const absl::StatusOr<Quantity> quantity = FromWire(static_cast<v1::Quantity>(number));
    if (!quantity.ok()) return quantity.status();
    selection[Index(*quantity)] = true;
  }
  return selection;
}

std::uint8_t* AddBytes(int field, std::size_t count, ColumnMessage& message) {
  return reinterpret_cast<std::uint8_t*>(message.AddColumn(field, count));
}

float* AddFloats(int field, std::size_t count, ColumnMessage& message) {
  return reinterpret_cast<float*>(message.AddColumn(field, count * sizeof(float)));
}

std::array<float*, kQuantityCount> AddSeaSurface(int field, const QuantitySelection& selection,
                                                 std::size_t count, ColumnMessage& message) {
  using Fields = v1::SeaSurfaceColumns;
  constexpr std::array<int, kQuantityCount> kFields = {Fields::kRefractionAlongWindFieldNumber,
                                                       Fields::kRefractionCrossWindFieldNumber,
                                                       Fields::kThuFieldNumber,
                                                       Fields::kTvuFieldNumber,
                                                       Fields::kBiasAlongBeamFieldNumber,
                                                       Fields::kBiasVerticalFieldNumber};
  const std::size_t mark = message.Mark();
  std::array<float*, kQuantityCount> columns{};
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (selection[i]) columns[i] = AddFloats(kFields[i], count, message);
  }
  message.Nest(field, mark);
  return columns;
}

// Adds only the columns that were requested.
AnswerColumns AddColumns(const QueryPlan& plan, const QuantitySelection& selection, std::size_t count,
                         ColumnMessage& message) {
  using Fields = v1::QueryColumnsResponse;
  AnswerColumns columns;
  columns.outcomes = AddBytes(Fields::kOutcomesFieldNumber, count, message);
  columns.outcome_axes = AddBytes(Fields::kOutcomeAxesFieldNumber, count, message);
  columns.values = AddSeaSurface(Fields::kSeaSurfaceFieldNumber, selection, count, message);
  if (plan.standard_errors) {
    columns.standard_errors =
        AddSeaSurface(Fields::kSeaSurfaceStandardErrorFieldNumber, selection, count, message);
  }
  if (!plan.asks_s44()) return columns;
  const std::size_t mark = message.Mark();
  if (plan.best_s44_order) {
    columns.best_s44_orders = AddBytes(v1::S44Columns::kBestOrdersFieldNumber, count, message);
  }
  if (plan.query.s44_order.has_value()) {
    columns.remaining_thu = AddFloats(v1::S44Columns::kRemainingThuFieldNumber, count, message);
    columns.remaining_tvu = AddFloats(v1::S44Columns::kRemainingTvuFieldNumber, count, message);
  }
  message.Nest(Fields::kS44FieldNumber, mark);
  return columns;
}

}  // namespace

absl::Status QueryColumns(AnswerSources& sources, const v1::QueryColumnsRequest& request,
                          ColumnMessage& response, OutcomeTally& tally) {
  const absl::StatusOr<QueryPlan> plan = PlanQuery(request, sources);
  if (!plan.ok()) return plan.status();
  const absl::StatusOr<QuantitySelection> selection = ReadQuantities(request);
  if (!selection.ok()) return selection.status();
  const absl::StatusOr<PulseColumns> pulses =
      ReadPulseColumns(request.pulses(), plan->source->table.schema());
  if (!pulses.ok()) return pulses.status();
  v1::QueryColumnsResponse head;
  *head.mutable_table() = WriteReference(*plan->source);
  head.set_coverage(ToWire(plan->query.coverage));
  head.set_pulse_count(static_cast<int>(pulses->size));
  head.set_azimuth_absent((*pulses)[AxisId::kAzimuth].empty());
  if (plan->source->sea) *head.mutable_sea() = WriteSea(*plan->source->sea);
  response.Add(head);
  const AnswerColumns answers = AddColumns(*plan, *selection, pulses->size, response);
  InterpolateOnAllCores(plan->source->interpolator, plan->query,
                        plan->source->sea ? OnOneSea(*pulses) : *pulses, answers);
  tally.Add({answers.outcomes, pulses->size}, {answers.outcome_axes, pulses->size});
  return absl::OkStatus();
}

}  // namespace albtpu::server
