#include "service/server/tables/wire_enums.h"

#include <string>
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

// For enums of the wire that list the values of ours in the same order, after "unspecified".
template <typename WireEnum, typename Enum>
constexpr WireEnum AfterUnspecified(Enum value) {
  return static_cast<WireEnum>(static_cast<int>(value) + 1);
}

static_assert(AfterUnspecified<v1::Axis>(AxisId::kWindSpeed) == v1::AXIS_WIND_SPEED);
static_assert(AfterUnspecified<v1::Axis>(AxisId::kFetch) == v1::AXIS_FETCH);
static_assert(AfterUnspecified<v1::Axis>(AxisId::kIncidence) == v1::AXIS_INCIDENCE);
static_assert(AfterUnspecified<v1::Axis>(AxisId::kAzimuth) == v1::AXIS_AZIMUTH);
static_assert(AfterUnspecified<v1::Axis>(AxisId::kFootprint) == v1::AXIS_FOOTPRINT);
static_assert(AfterUnspecified<v1::Axis>(AxisId::kDepth) == v1::AXIS_DEPTH);

static_assert(AfterUnspecified<v1::Quantity>(Quantity::kRefractionAlongWind) == v1::QUANTITY_REFRACTION_ALONG_WIND);
static_assert(AfterUnspecified<v1::Quantity>(Quantity::kRefractionCrossWind) == v1::QUANTITY_REFRACTION_CROSS_WIND);
static_assert(AfterUnspecified<v1::Quantity>(Quantity::kThu) == v1::QUANTITY_THU);
static_assert(AfterUnspecified<v1::Quantity>(Quantity::kTvu) == v1::QUANTITY_TVU);
static_assert(AfterUnspecified<v1::Quantity>(Quantity::kBiasAlongBeam) == v1::QUANTITY_BIAS_ALONG_BEAM);
static_assert(AfterUnspecified<v1::Quantity>(Quantity::kBiasVertical) == v1::QUANTITY_BIAS_VERTICAL);

static_assert(AfterUnspecified<v1::Outcome>(Outcome::kInterpolated) == v1::OUTCOME_INTERPOLATED);
static_assert(AfterUnspecified<v1::Outcome>(Outcome::kOutOfDomain) == v1::OUTCOME_OUT_OF_DOMAIN);
static_assert(AfterUnspecified<v1::Outcome>(Outcome::kInvalid) == v1::OUTCOME_INVALID);

static_assert(AfterUnspecified<v1::S44Order>(S44Order::kExclusive) == v1::S44_ORDER_EXCLUSIVE);
static_assert(AfterUnspecified<v1::S44Order>(S44Order::kSpecial) == v1::S44_ORDER_SPECIAL);
static_assert(AfterUnspecified<v1::S44Order>(S44Order::k1a) == v1::S44_ORDER_1A);
static_assert(AfterUnspecified<v1::S44Order>(S44Order::k1b) == v1::S44_ORDER_1B);
static_assert(AfterUnspecified<v1::S44Order>(S44Order::k2) == v1::S44_ORDER_2);

static_assert(AfterUnspecified<v1::SurfaceLocation>(SurfaceLocation::kPulse) == v1::SURFACE_LOCATION_PULSE);
static_assert(AfterUnspecified<v1::SurfaceLocation>(SurfaceLocation::kLocal) == v1::SURFACE_LOCATION_LOCAL);
static_assert(AfterUnspecified<v1::SurfaceLocation>(SurfaceLocation::kLevel) == v1::SURFACE_LOCATION_LEVEL);

static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kTotalThu) == v1::BUDGET_QUANTITY_TOTAL_THU);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kTvuSea) == v1::BUDGET_QUANTITY_TVU_SEA);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kBiasVertical) == v1::BUDGET_QUANTITY_BIAS_VERTICAL);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kCovarianceTotal) ==
              v1::BUDGET_QUANTITY_COVARIANCE_TOTAL);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kCovarianceSurvey) ==
              v1::BUDGET_QUANTITY_COVARIANCE_SURVEY);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kBestS44Order) ==
              v1::BUDGET_QUANTITY_BEST_S44_ORDER);
static_assert(AfterUnspecified<v1::BudgetQuantity>(BudgetQuantity::kTvuWater) == v1::BUDGET_QUANTITY_TVU_WATER);

absl::Status NotAValue(std::string_view field, int number, std::string_view enum_name) {
  return FieldViolation(field,
                        absl::StrCat(std::string(field), " is ", number, ": not a value of ", std::string(enum_name)));
}

}  // namespace

v1::Axis ToWire(AxisId axis) { return AfterUnspecified<v1::Axis>(axis); }

v1::Axis ToWire(std::optional<AxisId> axis) { return axis.has_value() ? ToWire(*axis) : v1::AXIS_UNSPECIFIED; }

v1::Quantity ToWire(Quantity quantity) { return AfterUnspecified<v1::Quantity>(quantity); }

v1::Scale ToWire(Scale scale) { return scale == Scale::kLog ? v1::SCALE_LOG : v1::SCALE_LINEAR; }

v1::Outcome ToWire(Outcome outcome) { return AfterUnspecified<v1::Outcome>(outcome); }

v1::Coverage ToWire(Coverage coverage) {
  switch (coverage) {
    case Coverage::kTwoSigma:
      break;
    case Coverage::kOneSigma:
      return v1::COVERAGE_ONE_SIGMA;
    case Coverage::kP95:
      return v1::COVERAGE_P95;
  }
  return v1::COVERAGE_TWO_SIGMA;
}

v1::BudgetQuantity ToWire(BudgetQuantity quantity) { return AfterUnspecified<v1::BudgetQuantity>(quantity); }

v1::S44Order ToWire(std::optional<S44Order> order) {
  return order.has_value() ? AfterUnspecified<v1::S44Order>(*order) : v1::S44_ORDER_UNSPECIFIED;
}

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
