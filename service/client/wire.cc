#include "service/client/wire.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "tables/coverage.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// Into the memory that the message has from the last time.
void Assign(std::span<const float> column, std::string& bytes) {
  bytes.assign(reinterpret_cast<const char*>(column.data()), column.size_bytes());
}

v1::Coverage ToWire(Coverage coverage) {
  return coverage == Coverage::kP95 ? v1::COVERAGE_P95 : v1::COVERAGE_TWO_SIGMA;
}

absl::Status CheckNumbers(const std::string& column, const char* name, int first, int last) {
  const auto known = [&](char number) { return number >= first && number <= last; };
  const auto unknown = std::find_if_not(column.begin(), column.end(), known);
  if (unknown == column.end()) return absl::OkStatus();
  return absl::InternalError(absl::StrCat("answered ", static_cast<unsigned char>(*unknown), " among the ",
                                          name, ", which this program does not know"));
}

template <typename Element>
absl::Status Copy(const std::string& bytes, const char* name, std::size_t count, Element* column) {
  if (column == nullptr) return absl::OkStatus();
  if (bytes.size() != count * sizeof(Element)) {
    return absl::InternalError(absl::StrCat("answered ", bytes.size(), " bytes of ", name, " for ", count,
                                            " pulses: ", sizeof(Element), " for each are right"));
  }
  std::memcpy(column, bytes.data(), bytes.size());
  return absl::OkStatus();
}

absl::Status Copy(const v1::SeaSurfaceColumns& message, std::size_t count,
                  const std::array<float*, kQuantityCount>& columns) {
  const std::array<const std::string*, kQuantityCount> bytes = {
      &message.refraction_along_wind(), &message.refraction_cross_wind(), &message.thu(),
      &message.tvu(),                   &message.bias_along_beam(),       &message.bias_vertical()};
  absl::Status status;
  for (const Quantity quantity : kQuantities) {
    const std::size_t i = Index(quantity);
    status.Update(Copy(*bytes[i], Describe(quantity).name.data(), count, columns[i]));
  }
  return status;
}

void FillWithNaN(std::size_t count, float* column) {
  if (column != nullptr) std::fill_n(column, count, std::numeric_limits<float>::quiet_NaN());
}

// Axes count from 1 on the wire, where 0 is none.
std::optional<AxisId> AxisOf(int number) {
  if (number < 1 || number > static_cast<int>(kAxisCount)) return std::nullopt;
  return kAxes[number - 1];
}

std::string Text(const v1::AttributeValue& value) {
  switch (value.value_case()) {
    case v1::AttributeValue::kText:
      return value.text();
    case v1::AttributeValue::kInteger:
      return absl::StrCat(value.integer());
    case v1::AttributeValue::kNumber:
      return absl::StrCat(value.number());
    case v1::AttributeValue::kNumbers:
      return absl::StrJoin(value.numbers().values(), ", ");
    case v1::AttributeValue::VALUE_NOT_SET:
      break;
  }
  return "";
}

}  // namespace

void ToWire(const Query& query, const AnswerColumns& wanted, v1::QueryColumnsRequest& request) {
  v1::QueryOptions& options = *request.mutable_options();
  options.set_coverage(ToWire(query.coverage));
  options.set_best_s44_order(wanted.best_s44_orders != nullptr);
  if (query.s44_order.has_value()) {
    options.set_s44_order(static_cast<v1::S44Order>(static_cast<int>(*query.s44_order) + 1));
  }
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (wanted.standard_errors[i] != nullptr) options.set_standard_errors(true);
    if (wanted.values[i] == nullptr && wanted.standard_errors[i] == nullptr) continue;
    request.add_quantities(static_cast<v1::Quantity>(i + 1));
  }
}

void ToWire(const PulseColumns& pulses, v1::PulseColumns& columns) {
  Assign(pulses[AxisId::kWindSpeed], *columns.mutable_wind_speed());
  Assign(pulses[AxisId::kFetch], *columns.mutable_fetch());
  Assign(pulses[AxisId::kIncidence], *columns.mutable_incidence());
  Assign(pulses[AxisId::kAzimuth], *columns.mutable_azimuth());
  Assign(pulses[AxisId::kFootprint], *columns.mutable_footprint());
  Assign(pulses[AxisId::kDepth], *columns.mutable_depth());
  const auto is_long = [](std::span<const float> column) { return column.size() > 1; };
  if (pulses.size > 1 && std::none_of(pulses.axis.begin(), pulses.axis.end(), is_long)) {
    Assign(std::vector<float>(pulses.size, pulses[AxisId::kDepth][0]), *columns.mutable_depth());
  }
}

absl::Status FromWire(const v1::QueryColumnsResponse& response, const Query& query, std::size_t pulse_count,
                      const AnswerColumns& answers) {
  absl::Status status;
  if (response.coverage() != ToWire(query.coverage)) {
    status = absl::InternalError(absl::StrCat("answered coverage ", response.coverage(), ": ",
                                              ToWire(query.coverage), " was asked for"));
  }
  status.Update(CheckNumbers(response.outcomes(), "outcomes", 1, v1::Outcome_MAX));
  status.Update(CheckNumbers(response.outcome_axes(), "outcome_axes", 0, v1::Axis_MAX));
  status.Update(CheckNumbers(response.s44().best_orders(), "best_orders", 0, v1::S44Order_MAX));
  status.Update(Copy(response.outcomes(), "outcomes", pulse_count, answers.outcomes));
  status.Update(Copy(response.outcome_axes(), "outcome_axes", pulse_count, answers.outcome_axes));
  status.Update(Copy(response.sea_surface(), pulse_count, answers.values));
  status.Update(Copy(response.sea_surface_standard_error(), pulse_count, answers.standard_errors));
  status.Update(Copy(response.s44().best_orders(), "best_orders", pulse_count, answers.best_s44_orders));
  if (query.s44_order.has_value()) {
    status.Update(Copy(response.s44().remaining_thu(), "remaining_thu", pulse_count, answers.remaining_thu));
    status.Update(Copy(response.s44().remaining_tvu(), "remaining_tvu", pulse_count, answers.remaining_tvu));
  } else {  // Not asked for: nothing remains of no order.
    FillWithNaN(pulse_count, answers.remaining_thu);
    FillWithNaN(pulse_count, answers.remaining_tvu);
  }
  return status;
}

TableSummary FromWire(const v1::Table& table) {
  TableSummary summary;
  summary.name = table.reference().name();
  summary.id = table.reference().id();
  summary.version = table.reference().version();
  summary.digest = table.reference().digest();
  summary.title = table.title();
  for (const v1::TableAxis& axis : table.axes()) {
    const std::optional<AxisId> id = AxisOf(axis.axis());
    if (!id.has_value() || axis.nodes().empty()) continue;
    summary.axes[Index(*id)] = {axis.nodes(0), axis.nodes(axis.nodes_size() - 1),
                                static_cast<std::size_t>(axis.nodes_size())};
  }
  for (const auto& [key, value] : table.attributes()) summary.attributes[key] = Text(value);
  return summary;
}

}  // namespace albtpu::client
