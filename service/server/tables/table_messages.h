// Tables as messages: their names, contents and provenance.
#pragma once

#include "albtpu/v1/table.pb.h"
#include "service/server/tables/table_catalog.h"

namespace albtpu::server {

v1::TableReference WriteReference(const TableCatalog::Entry& entry);
v1::TableSummary WriteSummary(const TableCatalog::Entry& entry);
v1::Table WriteTableMessage(const TableCatalog::Entry& entry);

}  // namespace albtpu::server
