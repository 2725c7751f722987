// Tables on the wire: a table that answers, its message, and the enums of requests.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "sea/table/table_at_index.h"
#include "sea/water_index.h"
#include "service/seas/sea_summary.h"
#include "service/wire_values.h"
#include "tables/query/column_query.h"
#include "tables/uncertainty_table.h"

namespace albtpu::server {

// A table that answers queries.

struct ServedTable : std::enable_shared_from_this<ServedTable> {
  ServedTable(std::string table_name, UncertaintyTable contents, double index = kSeaWaterIndex)
      : name(std::move(table_name)),
        table(std::move(contents)),
        refractive_index(index),
        interpolator(AtIndex(table, index)),
        sea(SummaryOfSea(table)) {}

  std::string name;  // NAME or NAME/VERSION; empty for the table of a request's sea.
  UncertaintyTable table;
  double refractive_index;          // Of the water that it answers for.
  ColumnInterpolator interpolator;  // Of the table in that water.
  std::optional<SeaSummary> sea;    // If it is the table of one sea.
};

// Tables as messages: their names, contents and provenance.

v1::SeaSummary WriteSea(const SeaSummary& sea);
v1::TableReference WriteReference(const ServedTable& served);
v1::TableSummary WriteSummary(const ServedTable& served);
v1::Table WriteTableMessage(const ServedTable& served);

// A number that is not a value of the enum is an InvalidArgument error that names the field.
absl::StatusOr<Coverage> FromWire(v1::Coverage coverage);                // Unspecified is 2 sigma.
absl::StatusOr<std::optional<S44Order>> FromWire(v1::S44Order order);    // Unspecified is none.
absl::StatusOr<Quantity> FromWire(v1::Quantity quantity);                // Unspecified is an error.
absl::StatusOr<BudgetQuantity> FromWire(v1::BudgetQuantity quantity);    // Unspecified is an error.
absl::StatusOr<SurfaceLocation> FromWire(v1::SurfaceLocation location);  // Unspecified is an error.

}  // namespace albtpu::server
