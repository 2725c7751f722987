#include "service/server/calls/query_columns.h"

#include <algorithm>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "service/seas/sea_summary.h"
#include "service/server/ground/errors.h"
#include "service/server/ground/limits.h"
#include "service/server/tables/wire_enums.h"
#include "status/status_macros.h"

namespace albtpu::server {
namespace {

absl::StatusOr<const ServedTable*> FindSource(const v1::QueryOptions& options, const v1::SeaState* sea,
                                              AnswerSources& sources) {
  ASSIGN_OR_RETURN(const double index,
                   ReadIndex(options.has_refractive_index(), options.refractive_index(), "options.refractive_index"));
  if (sea == nullptr) return sources.Find(options.table(), index);
  if (options.table().empty()) return sources.Find(*sea, index);
  return FieldViolation("options.table",
                        absl::StrCat("options.table is '", options.table(),
                                     "' (the request has a sea, whose table is another one); leave out one of "
                                     "the two"));
}

std::string Quoted(const RequestColumn& column) { return absl::StrCat("column '", std::string(column.name), "'"); }

std::string Path(const RequestColumn& column) {
  return absl::StrCat(std::string(column.message), ".", std::string(column.name));
}

absl::Status CheckBytes(std::span<const RequestColumn> columns) {
  FieldViolations violations;
  for (const RequestColumn& column : columns) {
    const std::size_t bytes = column.bytes->size();
    if (bytes % sizeof(float) == 0) continue;
    violations.Add(Path(column), absl::StrCat(Quoted(column), " has ", bytes,
                                              " bytes: expected single precision numbers of 4 bytes each"));
  }
  return violations.ToStatus();
}

// The error in the column, or an empty string if it is valid. `longest` has one number for each pulse.
std::string ColumnError(const RequestColumn& column, const RequestColumn& longest) {
  const std::size_t length = column.numbers().size(), count = longest.numbers().size();
  if (length > kMaxPulses) {
    return absl::StrCat(Quoted(column), " has ", length, " numbers: a message takes ", kMaxPulses,
                        " pulses at most; send several messages");
  }
  if (length == 0 && column.required)
    return absl::StrCat(Quoted(column), " is empty: send one number for each pulse, or one number for all");
  if (length > 1 && length != count) {
    return absl::StrCat(Quoted(column), " has ", length, " numbers, ", Quoted(longest), " has ", count,
                        ": send one number for each pulse, or one number for all");
  }
  return "";
}

}  // namespace

absl::StatusOr<QueryPlan> PlanQuery(const v1::QueryOptions& options, const v1::SeaState* sea, AnswerSources& sources) {
  ASSIGN_OR_RETURN(const ServedTable* source, FindSource(options, sea, sources));
  ASSIGN_OR_RETURN(const Coverage coverage, FromWire(options.coverage()));
  ASSIGN_OR_RETURN(const std::optional<S44Order> s44_order, FromWire(options.s44_order()));
  return QueryPlan{.source = source,
                   .query = {.coverage = coverage, .s44_order = s44_order},
                   .standard_errors = options.standard_errors(),
                   .best_s44_order = options.best_s44_order()};
}

absl::StatusOr<std::size_t> CountPulses(std::span<const RequestColumn> columns) {
  RETURN_IF_ERROR(CheckBytes(columns));
  const RequestColumn& longest = *std::max_element(
      columns.begin(), columns.end(),
      [](const RequestColumn& a, const RequestColumn& b) { return a.bytes->size() < b.bytes->size(); });
  if (longest.bytes->empty()) return FieldViolation("pulses", "there are no pulses: send at least one");
  FieldViolations violations;
  for (const RequestColumn& column : columns) {
    const std::string error = ColumnError(column, longest);
    if (!error.empty()) violations.Add(Path(column), error);
  }
  RETURN_IF_ERROR(violations.ToStatus());
  return longest.numbers().size();
}

std::array<RequestColumn, kAxisCount> ColumnsOf(const v1::PulseColumns& columns, const TableSchema& schema) {
  const std::array<const std::string*, kAxisCount> bytes = {&columns.wind_speed(), &columns.fetch(),
                                                            &columns.incidence(),  &columns.azimuth(),
                                                            &columns.footprint(),  &columns.depth()};
  std::array<RequestColumn, kAxisCount> result;
  for (const AxisId axis : kAxes) {
    const std::size_t i = Index(axis);
    result[i] = {"pulses", Describe(axis).name, bytes[i], schema.axes[i].if_absent == IfAbsent::kRefuse};
  }
  return result;
}

PulseColumns PulsesOf(std::span<const RequestColumn> columns, std::size_t count) {
  PulseColumns pulses;
  pulses.size = count;
  for (std::size_t i = 0; i < columns.size(); ++i) pulses.axis[i] = columns[i].numbers();
  return pulses;
}

absl::StatusOr<PulseColumns> ReadPulseColumns(const v1::PulseColumns& columns, const TableSchema& schema) {
  const std::array<RequestColumn, kAxisCount> read = ColumnsOf(columns, schema);
  ASSIGN_OR_RETURN(const std::size_t count, CountPulses(read));
  return PulsesOf(read, count);
}

namespace {

using QuantitySelection = std::array<bool, kQuantityCount>;

// The quantities that the request names, or all if it names none.
absl::StatusOr<QuantitySelection> ReadQuantities(const v1::QueryColumnsRequest& request) {
  QuantitySelection selection;
  selection.fill(request.quantities_size() == 0);
  for (int number : request.quantities()) {
    ASSIGN_OR_RETURN(const Quantity quantity, FromWire(static_cast<v1::Quantity>(number)));
    selection[Index(quantity)] = true;
  }
  return selection;
}

std::uint8_t* AddBytes(int field, std::size_t count, ColumnMessage& message) {
  return reinterpret_cast<std::uint8_t*>(message.AddColumn(field, count));
}

float* AddFloats(int field, std::size_t count, ColumnMessage& message) {
  return reinterpret_cast<float*>(message.AddColumn(field, count * sizeof(float)));
}

// The number of a field is that of its quantity.
std::array<float*, kQuantityCount> AddSeaSurface(int field, const QuantitySelection& selection, std::size_t count,
                                                 ColumnMessage& message) {
  const std::size_t mark = message.Mark();
  std::array<float*, kQuantityCount> columns{};
  for (std::size_t i = 0; i < kQuantityCount; ++i)
    if (selection[i]) columns[i] = AddFloats(ToWire(kQuantities[i]), count, message);
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
  if (plan.standard_errors)
    columns.standard_errors = AddSeaSurface(Fields::kSeaSurfaceStandardErrorFieldNumber, selection, count, message);
  if (!plan.asks_s44()) return columns;
  const std::size_t mark = message.Mark();
  if (plan.best_s44_order) columns.best_s44_orders = AddBytes(v1::S44Columns::kBestOrdersFieldNumber, count, message);
  if (plan.query.s44_order.has_value()) {
    columns.remaining_thu = AddFloats(v1::S44Columns::kRemainingThuFieldNumber, count, message);
    columns.remaining_tvu = AddFloats(v1::S44Columns::kRemainingTvuFieldNumber, count, message);
  }
  message.Nest(Fields::kS44FieldNumber, mark);
  return columns;
}

}  // namespace

absl::Status QueryColumns(AnswerSources& sources, const v1::QueryColumnsRequest& request, ColumnMessage& response,
                          OutcomeTally& tally) {
  ASSIGN_OR_RETURN(const QueryPlan plan, PlanQuery(request, sources));
  ASSIGN_OR_RETURN(const QuantitySelection selection, ReadQuantities(request));
  ASSIGN_OR_RETURN(const PulseColumns pulses, ReadPulseColumns(request.pulses(), plan.source->table.schema()));
  v1::QueryColumnsResponse head;
  *head.mutable_table() = WriteReference(*plan.source);
  head.set_coverage(ToWire(plan.query.coverage));
  head.set_pulse_count(static_cast<int>(pulses.size));
  head.set_azimuth_absent(pulses[AxisId::kAzimuth].empty());
  if (plan.source->sea) *head.mutable_sea() = WriteSea(*plan.source->sea);
  head.set_refractive_index(plan.source->refractive_index);
  response.Add(head);
  const AnswerColumns answers = AddColumns(plan, selection, pulses.size, response);
  InterpolateOnAllCores(plan.source->interpolator, plan.query, plan.source->sea ? OnOneSea(pulses) : pulses, answers);
  tally.Add({answers.outcomes, pulses.size}, {answers.outcome_axes, pulses.size});
  return absl::OkStatus();
}

}  // namespace albtpu::server
