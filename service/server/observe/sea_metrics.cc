#include "service/server/observe/sea_metrics.h"

namespace albtpu::server {
namespace {

// From a sea on an idle machine, some milliseconds, to one on a busy machine.
const prometheus::Histogram::BucketBoundaries kSeconds = {2.5e-3, 5e-3, 10e-3, 25e-3, 50e-3,
                                                          0.1,    0.25, 0.5,   1,     2.5};

}  // namespace

SeaMetrics::SeaMetrics(prometheus::Registry& registry) {
  auto& requests = prometheus::BuildCounter()
                       .Name("albtpu_sea_requests_total")
                       .Help("Requests with a sea, by how they got its table.")
                       .Register(registry);
  found_ = &requests.Add({{"result", "found"}});
  joined_ = &requests.Add({{"result", "joined"}});
  compiled_ = &requests.Add({{"result", "compiled"}});
  failed_ = &requests.Add({{"result", "failed"}});
  refused_ = &requests.Add({{"result", "refused"}});
  evicted_ = &prometheus::BuildCounter()
                  .Name("albtpu_sea_evictions_total")
                  .Help("Tables of seas that were dropped to make room for others.")
                  .Register(registry)
                  .Add({});
  seconds_ = &prometheus::BuildHistogram()
                  .Name("albtpu_sea_compile_seconds")
                  .Help("Time to compute the table of a sea, without waiting.")
                  .Register(registry)
                  .Add({}, kSeconds);
  tables_ = &prometheus::BuildGauge()
                 .Name("albtpu_sea_tables")
                 .Help("Tables of seas that are kept.")
                 .Register(registry)
                 .Add({});
  bytes_ = &prometheus::BuildGauge()
                .Name("albtpu_sea_table_bytes")
                .Help("Memory of the tables of seas that are kept.")
                .Register(registry)
                .Add({});
}

void SeaMetrics::CountCompiled(std::chrono::duration<double> took) {
  compiled_->Increment();
  seconds_->Observe(took.count());
}

void SeaMetrics::SetKept(std::size_t tables, std::size_t bytes) {
  tables_->Set(static_cast<double>(tables));
  bytes_->Set(static_cast<double>(bytes));
}

}  // namespace albtpu::server
