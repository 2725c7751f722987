#include "service/server/calls/query_budget.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "absl/strings/str_cat.h"
#include "budget/query/query_check.h"
#include "service/error_message.h"
#include "service/seas/sea_summary.h"
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

}  // namespace

absl::Status QueryBudget(AnswerSources& sources, const v1::QueryBudgetRequest& request, ColumnMessage& response,
                         OutcomeTally& tally) {
  v1::QueryOptions query;
  query.set_table(request.options().table());
  if (request.options().has_refractive_index()) query.set_refractive_index(request.options().refractive_index());
  ASSIGN_OR_RETURN(const QueryPlan plan, PlanQuery(query, request.has_sea() ? &request.sea() : nullptr, sources));
  ASSIGN_OR_RETURN(const BudgetOptions options, ReadBudgetOptions(request.options()));
  ASSIGN_OR_RETURN(const BudgetSelection selection, ReadBudgetQuantities(request));
  const ServedTable& source = *plan.source;
  ASSIGN_OR_RETURN(BudgetPulses pulses, ReadPulses(request, source.table.schema()));
  const std::size_t count = pulses.pulses.size;
  RETURN_IF_ERROR(CheckAnswerSize(selection, count));
  v1::QueryBudgetResponse head;
  *head.mutable_table() = WriteReference(source);
  head.set_coverage(ToWire(options.coverage));
  head.set_pulse_count(static_cast<int>(count));
  head.set_azimuth_absent(pulses.pulses[AxisId::kAzimuth].empty());
  if (source.sea) *head.mutable_sea() = WriteSea(*source.sea);
  head.set_refractive_index(source.refractive_index);
  response.Add(head);
  if (source.sea) pulses.pulses = OnOneSea(pulses.pulses);
  if (source.sea)
    pulses.sea_axis = source.sea->x_azimuth;
  else if (request.options().has_sea_axis())
    pulses.sea_axis = request.options().sea_axis();
  const BudgetAnswers answers = AddColumns(selection, count, response);
  QueryBudgetOnAllCores(source.interpolator, pulses, options, answers);
  tally.Add({answers.outcomes, count}, {answers.outcome_axes, count});
  return absl::OkStatus();
}

}  // namespace albtpu::server
