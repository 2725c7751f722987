#include "service/server/tables/table_messages.h"

#include <string>
#include <variant>

#include "service/server/tables/wire_enums.h"

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
  for (const auto& [name, value] : table.provenance().attributes) {
    std::visit(AttributeWriter{(*message.mutable_attributes())[name]}, value);
  }
  return message;
}

}  // namespace albtpu::server
