// The waters that requests carry, compiled from the table of the water column.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "albtpu/v1/water.pb.h"
#include "budget/water/known_water.h"
#include "service/server/calls/compile_queue.h"
#include "service/server/ground/limits.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metric_collectors.h"
#include "service/server/tables/table_catalog.h"
#include "tables/digest.h"

namespace albtpu::server {

// A water that a request needs.
struct WantedWater {
  Sha256Digest key;  // Of the water and of the table.
  KnownWater water;
  std::shared_ptr<const TableCatalog::Water> table;  // Null if the server has none.
};

// A water that answers.
struct ServedWater {
  CompiledWater water;
  v1::WaterSummary summary;
};

// Compiles waters and keeps those that were used last, as CompileQueue does. Thread-safe.
class WaterShares {
 public:
  using Queue = CompileQueue<WantedWater, ServedWater>;
  using Result = Queue::Result;
  using Listener = Queue::Listener;

  struct Limits {
    std::size_t waters = kMaxWaters;
    std::size_t bytes = kMaxWaterBytes;
    std::size_t waiting = kMaxWaitingWaters;
  };

  // `metrics` and `log` must outlive this object. The log gets a line for each water that is compiled.
  WaterShares(WaterMetrics& metrics, CallLog& log) : WaterShares(metrics, log, Limits()) {}
  WaterShares(WaterMetrics& metrics, CallLog& log, const Limits& limits);

  // The water with this key, if it is kept; else null.
  std::shared_ptr<const ServedWater> Find(const Sha256Digest& key) { return queue_.Find(key); }

  // As CompileQueue. A water with a bias needs a table. INVALID_ARGUMENT, for the field `water`: the table does not
  // cover it.
  void Compile(const WantedWater& wanted, Listener done) { queue_.Compile(wanted, std::move(done)); }

 private:
  Result Make(const WantedWater& wanted);

  WaterMetrics& metrics_;
  CallLog& log_;
  Queue queue_;  // Last, because its threads use all other members.
};

}  // namespace albtpu::server
