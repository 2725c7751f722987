// The waters that requests carry, compiled from the server's table of the water column.
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
#include "tables/digest.h"
#include "tables/water/water_column_table.h"

namespace albtpu::server {

// A water that a request needs.
struct WantedWater {
  Sha256Digest key;
  KnownWater water;
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

  // `table` is null if the server has none. `metrics` and `log` must outlive this object. The log gets a line for each
  // water that is compiled.
  WaterShares(std::shared_ptr<const WaterColumnTable> table, WaterMetrics& metrics, CallLog& log)
      : WaterShares(std::move(table), metrics, log, Limits()) {}
  WaterShares(std::shared_ptr<const WaterColumnTable> table, WaterMetrics& metrics, CallLog& log, const Limits& limits);

  // FAILED_PRECONDITION if the water needs a table and the server has none.
  absl::Status Check(const KnownWater& water) const;

  // The water with this key, if it is kept; else null.
  std::shared_ptr<const ServedWater> Find(const Sha256Digest& key) { return queue_.Find(key); }

  // As CompileQueue. Check() must be OK. INVALID_ARGUMENT, for the field `water`: the table does not cover it.
  void Compile(const WantedWater& wanted, Listener done) { queue_.Compile(wanted, std::move(done)); }

 private:
  Result Make(const WantedWater& wanted);

  const std::shared_ptr<const WaterColumnTable> table_;
  WaterMetrics& metrics_;
  CallLog& log_;
  Queue queue_;  // Last, because its threads use all other members.
};

}  // namespace albtpu::server
