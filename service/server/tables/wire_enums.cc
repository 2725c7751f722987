#include "service/server/tables/wire_enums.h"

#include <string_view>
#include <variant>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "service/server/ground/errors.h"

namespace albtpu::server {
namespace {

v1::TableAxis WriteAxis(const Axis& axis) {
  const AxisSchema& schema = Describe(axis.id());
  v1::TableAxis message;
  message.set_axis(ToWire(axis.id()));
  message.set_name(std::string(schema.name));
  message.set_units(std::string(schema.units));
  message.set_long_name(std::string(schema.long_name));
  message.set_scale(ToWire(axis.scale()));
  // Exact: the nodes of an Axis are single precision numbers.
  for (double node : axis.nodes()) message.add_nodes(static_cast<float>(node));
  return message;
}

v1::TableQuantity WriteQuantity(Quantity quantity, const Variable& variable) {
  const QuantitySchema& schema = Describe(quantity);
  v1::TableQuantity message;
  message.set_quantity(ToWire(quantity));
  message.set_name(std::string(schema.name));
  message.set_units(std::string(schema.units));
  message.set_long_name(std::string(schema.long_name));
  message.set_scale(ToWire(variable.scale));
  message.set_has_standard_error(!variable.standard_errors.empty());
  return message;
}

struct AttributeWriter {
  v1::AttributeValue& message;

  void operator()(const std::string& text) const { message.set_text(text); }
  void operator()(std::int64_t integer) const { message.set_integer(integer); }
  void operator()(double number) const { message.set_number(number); }
  void operator()(const std::vector<double>& numbers) const {
    message.mutable_numbers()->mutable_values()->Add(numbers.begin(), numbers.end());
  }
};

}  // namespace

v1::SeaSummary WriteSea(const SeaSummary& sea) {
  v1::SeaSummary message;
  message.set_x_azimuth(sea.x_azimuth);
  message.set_significant_wave_height(sea.significant_wave_height);
  message.set_wind_speed(sea.wind_speed_10m);
  message.set_water_depth(sea.water_depth);
  message.set_tail_from(sea.tail_from);
  message.set_share_measured(sea.share_measured);
  message.mutable_assumptions()->Assign(sea.assumptions.begin(), sea.assumptions.end());
  return message;
}

v1::TableReference WriteReference(const ServedTable& served) {
  v1::TableReference message;
  message.set_name(served.name);
  message.set_id(served.table.provenance().id);
  message.set_version(served.table.provenance().version);
  message.set_digest(served.table.digest());
  return message;
}

v1::TableSummary WriteSummary(const ServedTable& served) {
  v1::TableSummary message;
  *message.mutable_reference() = WriteReference(served);
  message.set_title(served.table.provenance().title);
  return message;
}

v1::Table WriteTableMessage(const ServedTable& served) {
  const UncertaintyTable& table = served.table;
  v1::Table message;
  *message.mutable_reference() = WriteReference(served);
  message.set_title(table.provenance().title);
  for (const Axis& axis : table.axes()) *message.add_axes() = WriteAxis(axis);
  for (Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    if (variable != nullptr) *message.add_quantities() = WriteQuantity(quantity, *variable);
  }
  message.set_campaign(table.provenance().campaign);
  if (served.sea) *message.mutable_sea() = WriteSea(*served.sea);
  for (const auto& [name, value] : table.provenance().attributes)
    std::visit(AttributeWriter{(*message.mutable_attributes())[name]}, value);
  return message;
}

namespace {

absl::Status NotAValue(std::string_view field, int number, std::string_view enum_name) {
  return FieldViolation(field,
                        absl::StrCat(std::string(field), " is ", number, ": not a value of ", std::string(enum_name)));
}

}  // namespace

absl::StatusOr<Coverage> FromWire(v1::Coverage coverage) {
  if (!v1::Coverage_IsValid(coverage)) return NotAValue("options.coverage", coverage, "Coverage");
  if (coverage == v1::COVERAGE_ONE_SIGMA) return Coverage::kOneSigma;
  return coverage == v1::COVERAGE_P95 ? Coverage::kP95 : Coverage::kTwoSigma;
}

absl::StatusOr<std::optional<S44Order>> FromWire(v1::S44Order order) {
  if (!v1::S44Order_IsValid(order)) return NotAValue("options.s44_order", order, "S44Order");
  if (order == v1::S44_ORDER_UNSPECIFIED) return std::nullopt;
  return static_cast<S44Order>(order - 1);
}

absl::StatusOr<Quantity> FromWire(v1::Quantity quantity) {
  if (!v1::Quantity_IsValid(quantity)) return NotAValue("quantities", quantity, "Quantity");
  if (quantity == v1::QUANTITY_UNSPECIFIED)
    return FieldViolation("quantities", "quantities contains QUANTITY_UNSPECIFIED: leave it empty to ask for all");
  return static_cast<Quantity>(quantity - 1);
}

absl::StatusOr<BudgetQuantity> FromWire(v1::BudgetQuantity quantity) {
  if (!v1::BudgetQuantity_IsValid(quantity)) return NotAValue("quantities", quantity, "BudgetQuantity");
  if (quantity == v1::BUDGET_QUANTITY_UNSPECIFIED) {
    return FieldViolation("quantities",
                          "quantities contains BUDGET_QUANTITY_UNSPECIFIED: leave it empty to ask for THU and TVU");
  }
  return static_cast<BudgetQuantity>(quantity - 1);
}

absl::StatusOr<SurfaceLocation> FromWire(v1::SurfaceLocation location) {
  if (!v1::SurfaceLocation_IsValid(location)) return NotAValue("options.located", location, "SurfaceLocation");
  if (location == v1::SURFACE_LOCATION_UNSPECIFIED) {
    return FieldViolation("options.located",
                          "options.located is missing: say how the surface was located (pulse, local or level)");
  }
  return static_cast<SurfaceLocation>(location - 1);
}

}  // namespace albtpu::server
