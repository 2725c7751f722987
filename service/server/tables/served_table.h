// A table that answers queries.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "service/seas/sea_summary.h"
#include "tables/query/column_query.h"
#include "tables/uncertainty_table.h"

namespace albtpu::server {

struct ServedTable {
  ServedTable(std::string table_name, UncertaintyTable contents)
      : name(std::move(table_name)),
        table(std::move(contents)),
        interpolator(table),
        sea(SummaryOfSea(table)) {}

  std::string name;  // NAME or NAME/VERSION; empty for the table of a request's sea.
  UncertaintyTable table;
  ColumnInterpolator interpolator;  // Of the table.
  std::optional<SeaSummary> sea;    // If it is the table of one sea.
};

}  // namespace albtpu::server
