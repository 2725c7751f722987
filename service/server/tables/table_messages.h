// Tables as messages: their names, contents and provenance.
#pragma once

#include "albtpu/v1/table.pb.h"
#include "service/server/tables/served_table.h"

namespace albtpu::server {

v1::SeaSummary WriteSea(const SeaSummary& sea);
v1::TableReference WriteReference(const ServedTable& served);
v1::TableSummary WriteSummary(const ServedTable& served);
v1::Table WriteTableMessage(const ServedTable& served);

}  // namespace albtpu::server
