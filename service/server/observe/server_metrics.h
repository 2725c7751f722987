// All metrics of a server but those that look at its tables.
#pragma once

#include <prometheus/registry.h>

#include <memory>

#include "service/server/observe/access_metrics.h"
#include "service/server/observe/call_metrics.h"
#include "service/server/observe/process_metrics.h"
#include "service/server/observe/reload_metrics.h"
#include "tables/version.h"

namespace albtpu::server {

struct ServerMetrics {
  ServerMetrics() {
    prometheus::BuildGauge()
        .Name("albtpu_build_info")
        .Help("1; which program this is.")
        .Register(*registry)
        .Add({{"version", std::string(Version())}, {"commit", std::string(Commit())}}, 1);
  }

  std::shared_ptr<ProcessMetrics> process = std::make_shared<ProcessMetrics>();
  std::shared_ptr<prometheus::Registry> registry = std::make_shared<prometheus::Registry>();
  CallMetrics calls{*registry};
  AccessMetrics access{*registry};
  ReloadMetrics reloads{*registry};
};

}  // namespace albtpu::server
