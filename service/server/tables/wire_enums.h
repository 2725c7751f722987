// Converts between the enums of the wire and those of tables/.
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "albtpu/v1/budget.pb.h"
#include "albtpu/v1/pulse.pb.h"
#include "albtpu/v1/table.pb.h"
#include "albtpu/v1/uncertainty.pb.h"
#include "budget/air/air_errors.h"
#include "budget/query/budget_query.h"
#include "tables/coverage.h"
#include "tables/query/interpolation.h"
#include "tables/s44.h"
#include "tables/schema.h"

namespace albtpu::server {

v1::Axis ToWire(AxisId axis);
v1::Axis ToWire(std::optional<AxisId> axis);  // Unspecified if none.
v1::Quantity ToWire(Quantity quantity);
v1::Scale ToWire(Scale scale);
v1::Outcome ToWire(Outcome outcome);
v1::Coverage ToWire(Coverage coverage);
v1::BudgetQuantity ToWire(BudgetQuantity quantity);
v1::S44Order ToWire(std::optional<S44Order> order);  // Unspecified if none.

// A number that is not a value of the enum is an InvalidArgument error that names the field.
absl::StatusOr<Coverage> FromWire(v1::Coverage coverage);                // Unspecified is 2 sigma.
absl::StatusOr<std::optional<S44Order>> FromWire(v1::S44Order order);    // Unspecified is none.
absl::StatusOr<Quantity> FromWire(v1::Quantity quantity);                // Unspecified is an error.
absl::StatusOr<BudgetQuantity> FromWire(v1::BudgetQuantity quantity);    // Unspecified is an error.
absl::StatusOr<SurfaceLocation> FromWire(v1::SurfaceLocation location);  // Unspecified is an error.

}  // namespace albtpu::server
