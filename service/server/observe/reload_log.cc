#include "service/server/observe/reload_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "service/server/observe/log.h"

namespace albtpu::server {

void LogReload(const LiveTables::Outcome& outcome) {
  if (!outcome.ok()) {
    spdlog::error("tables not reloaded, those from before still answer: {}",
                  std::string(outcome.status().message()));
    return;
  }
  using Kind = TableCatalog::Change::Kind;
  const auto count = [&](Kind kind) {
    return std::count_if(outcome->begin(), outcome->end(),
                         [&](const auto& change) { return change.kind == kind; });
  };
  Log(spdlog::level::info, "tables reloaded",
      {{"loaded", count(Kind::kLoaded)}, {"kept", count(Kind::kKept)}, {"removed", count(Kind::kRemoved)}});
}

}  // namespace albtpu::server
