// How reloads went, in the log.
#pragma once

#include "service/server/tables/live_tables.h"

namespace albtpu::server {

// One line; on failure it names files.
void LogReload(const LiveTables::Outcome& outcome);

}  // namespace albtpu::server
