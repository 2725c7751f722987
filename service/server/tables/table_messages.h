// Tables as messages: what they are called, what they hold, where they come from.
#pragma once

#include "albtpu/v1/table.pb.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

v1::TableReference WriteReference(const TableCatalog::Entry& entry);
v1::TableSummary WriteSummary(const TableCatalog::Entry& entry);
v1::Table WriteTableMessage(const TableCatalog::Entry& entry);

}  // namespace albtpu::server
