#include "service/server/observe/reload_metrics.h"

#include <algorithm>

namespace albtpu::server {
namespace {

bool HasChanges(const std::vector<TableCatalog::Change>& changes) {
  return std::any_of(changes.begin(), changes.end(), [](const TableCatalog::Change& change) {
    return change.kind != TableCatalog::Change::Kind::kKept;
  });
}

}  // namespace

ReloadMetrics::ReloadMetrics(prometheus::Registry& registry) {
  auto& reloads = prometheus::BuildCounter()
                      .Name("albtpu_reloads_total")
                      .Help("Reloads of the tables, by result.")
                      .Register(registry);
  loaded_ = &reloads.Add({{"result", "loaded"}});
  unchanged_ = &reloads.Add({{"result", "unchanged"}});
  refused_ = &reloads.Add({{"result", "refused"}});
  last_succeeded_ = &prometheus::BuildGauge()
                         .Name("albtpu_last_reload_successful")
                         .Help("1 if the last reload, or the start, took the tables as they lay on disk.")
                         .Register(registry)
                         .Add({}, 1);
  last_success_time_ = &prometheus::BuildGauge()
                            .Name("albtpu_last_reload_success_timestamp_seconds")
                            .Help("When the tables were last taken as they lay on disk.")
                            .Register(registry)
                            .Add({});
  last_success_time_->SetToCurrentTime();
}

void ReloadMetrics::Count(const LiveTables::Outcome& outcome) {
  last_succeeded_->Set(outcome.ok() ? 1 : 0);
  if (!outcome.ok()) return refused_->Increment();
  last_success_time_->SetToCurrentTime();
  (HasChanges(*outcome) ? loaded_ : unchanged_)->Increment();
}

}  // namespace albtpu::server
