// The tables that requests need beside those of the server: of the seas that they carry, and of the server's tables in
// water of another index.
#pragma once

#include <cstddef>
#include <memory>
#include <variant>

#include "sea/table/sea_table.h"
#include "service/seas/known_sea.h"
#include "service/server/calls/compile_queue.h"
#include "service/server/ground/limits.h"
#include "service/server/observe/log.h"
#include "service/server/observe/metric_collectors.h"
#include "service/server/tables/wire_enums.h"
#include "tables/digest.h"

namespace albtpu::server {

// A table that a request needs.
struct WantedTable {
  Sha256Digest key;
  // A sea, or a table of the server's.
  std::variant<KnownSea, std::shared_ptr<const ServedTable>> of;
  double refractive_index = kSeaWaterIndex;  // of the water
};

// Compiles seas and keeps the tables that were used last, as CompileQueue does. Thread-safe.
class SeaTables {
 public:
  using Queue = CompileQueue<WantedTable, ServedTable>;
  using Result = Queue::Result;
  using Listener = Queue::Listener;

  struct Limits {
    std::size_t tables = kMaxSeaTables;
    std::size_t bytes = kMaxSeaTableBytes;
    std::size_t waiting = kMaxWaitingSeas;
  };

  // `metrics` and `log` must outlive this object. The log gets a line for each sea that is compiled.
  SeaTables(SeaMetrics& metrics, CallLog& log) : SeaTables(metrics, log, Limits()) {}
  SeaTables(SeaMetrics& metrics, CallLog& log, const Limits& limits);

  // The table of the sea with this key, if it is kept; else null.
  std::shared_ptr<const ServedTable> Find(const Sha256Digest& key) { return queue_.Find(key); }

  // As CompileQueue. INVALID_ARGUMENT, for the field `sea`: a table cannot hold the numbers of the sea.
  void Compile(const WantedTable& wanted, Listener done) { queue_.Compile(wanted, std::move(done)); }

 private:
  Result Make(const WantedTable& wanted);
  Result CompileNow(const KnownSea& sea, double index);

  const SeaCompiler compiler_;
  SeaMetrics& metrics_;
  CallLog& log_;
  Queue queue_;  // Last, because its threads use all other members.
};

}  // namespace albtpu::server
