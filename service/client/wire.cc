#include "service/client/wire.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "service/client/little_endian.h"
#include "tables/coverage.h"

namespace albtpu::client {
namespace {

namespace v1 = albtpu::v1;

// A column of single precision numbers, `value` of each pulse.
template <typename Value>
std::string Column(std::span<const Pulse> pulses, Value value) {
  std::string bytes(pulses.size() * sizeof(float), '\0');
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const float number = value(pulses[i]);
    Store(number, bytes.data() + i * sizeof number);
  }
  return bytes;
}

// One value for all, if all are alike bit by bit.
std::string Shortened(std::string column) {
  const bool alike = std::equal(column.begin() + sizeof(float), column.end(), column.begin());
  if (alike) column.resize(sizeof(float));
  return column;
}

using QuantityColumns = std::array<const std::string*, kQuantityCount>;

QuantityColumns ColumnsOf(const v1::SeaSurfaceColumns& columns) {
  return {&columns.refraction_along_wind(), &columns.refraction_cross_wind(), &columns.thu(), &columns.tvu(),
          &columns.bias_along_beam(),       &columns.bias_vertical()};
}

absl::Status CheckLengths(const QuantityColumns& columns, std::size_t pulse_count) {
  for (const Quantity quantity : kQuantities) {
    const std::size_t size = columns[Index(quantity)]->size();
    if (size != pulse_count * sizeof(float)) {
      return absl::InternalError(absl::StrCat("answered ", size, " bytes of ",
                                              std::string(Describe(quantity).name), " for ", pulse_count,
                                              " pulses: 4 bytes for each are right"));
    }
  }
  return absl::OkStatus();
}

std::array<float, kQuantityCount> ValuesAt(const QuantityColumns& columns, std::size_t i) {
  std::array<float, kQuantityCount> values;
  for (std::size_t quantity = 0; quantity < kQuantityCount; ++quantity) {
    values[quantity] = Load<float>(*columns[quantity], i * sizeof(float));
  }
  return values;
}

std::optional<Outcome> OutcomeOf(std::uint8_t number) {
  switch (number) {
    case v1::OUTCOME_INTERPOLATED:
      return Outcome::kInterpolated;
    case v1::OUTCOME_OUT_OF_DOMAIN:
      return Outcome::kOutOfDomain;
    case v1::OUTCOME_INVALID:
      return Outcome::kInvalid;
    default:
      return std::nullopt;
  }
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

void ToWire(std::span<const Pulse> pulses, v1::PulseColumns& columns) {
  if (pulses.empty()) return;
  const auto column = [&](auto value) { return Shortened(Column(pulses, value)); };
  columns.set_wind_speed(column([](const Pulse& pulse) { return pulse.wind_speed; }));
  columns.set_fetch(column([](const Pulse& pulse) { return pulse.fetch; }));
  columns.set_incidence(column([](const Pulse& pulse) { return pulse.incidence; }));
  columns.set_azimuth(column([](const Pulse& pulse) { return *pulse.azimuth; }));
  columns.set_footprint(column([](const Pulse& pulse) { return pulse.footprint; }));
  // The longest column tells the number of pulses, so this one is never shortened.
  columns.set_depth(Column(pulses, [](const Pulse& pulse) { return pulse.depth; }));
}

absl::Status FromWire(const v1::QueryColumnsResponse& response, bool standard_errors,
                      std::span<PulseUncertainty> answers) {
  const std::size_t count = answers.size();
  if (response.coverage() != v1::COVERAGE_TWO_SIGMA) {
    return absl::InternalError(
        absl::StrCat("answered coverage ", response.coverage(), ": 2 sigma was asked for"));
  }
  if (response.outcomes().size() != count || response.outcome_axes().size() != count) {
    return absl::InternalError(absl::StrCat("answered ", response.outcomes().size(), " outcomes for ", count,
                                            " pulses: one for each is right"));
  }
  const QuantityColumns values = ColumnsOf(response.sea_surface());
  const QuantityColumns errors = ColumnsOf(response.sea_surface_standard_error());
  if (absl::Status status = CheckLengths(values, count); !status.ok()) return status;
  if (standard_errors) {
    if (absl::Status status = CheckLengths(errors, count); !status.ok()) return status;
  }
  for (std::size_t i = 0; i < count; ++i) {
    PulseUncertainty& answer = answers[i];
    const auto number = Load<std::uint8_t>(response.outcomes(), i);
    const std::optional<Outcome> outcome = OutcomeOf(number);
    if (!outcome.has_value()) {
      return absl::InternalError(
          absl::StrCat("answered outcome ", number, ", which this program does not know"));
    }
    answer.outcome = *outcome;
    answer.axis = AxisOf(Load<std::uint8_t>(response.outcome_axes(), i));
    answer.azimuth_absent = response.azimuth_absent();
    answer.values = ValuesAt(values, i);
    answer.radius_over_thu = RadiusOverThu(answer.values);
    if (standard_errors) {
      answer.standard_errors = ValuesAt(errors, i);
    } else {
      answer.standard_errors.fill(std::numeric_limits<float>::quiet_NaN());
    }
  }
  return absl::OkStatus();
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
