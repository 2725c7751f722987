// The tables that requests need beside those of the server: of the seas that they carry, and of the server's tables in
// water of another index.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <variant>
#include <vector>

#include "absl/status/statusor.h"
#include "sea/table/sea_table.h"
#include "service/seas/known_sea.h"
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

// Compiles seas on threads of its own, so that neither the threads of gRPC nor the workers ever wait for one, and keeps
// the tables that were used last. A table lives as long as a call uses it. Thread-safe.
class SeaTables {
 public:
  using Result = absl::StatusOr<std::shared_ptr<const ServedTable>>;
  using Listener = std::function<void(const Result&)>;

  struct Limits {
    std::size_t tables = kMaxSeaTables;
    std::size_t bytes = kMaxSeaTableBytes;
    std::size_t waiting = kMaxWaitingSeas;
  };

  // `metrics` and `log` must outlive this object. The log gets a line for each sea that is compiled.
  SeaTables(SeaMetrics& metrics, CallLog& log) : SeaTables(metrics, log, Limits()) {}
  SeaTables(SeaMetrics& metrics, CallLog& log, const Limits& limits);

  // Finishes the seas that are being compiled; the listeners of those that wait get CANCELLED.
  ~SeaTables();

  // The table of the sea with this key, if it is kept; else null.
  std::shared_ptr<const ServedTable> Find(const Sha256Digest& key);

  // Calls `done` with the table: at once if it is kept or cannot wait, else from a thread that made it. One that is
  // waiting or being made is not made again. INVALID_ARGUMENT, for the field `sea`: a table cannot hold the numbers of
  // the sea. RESOURCE_EXHAUSTED: too many wait.
  void Compile(const WantedTable& wanted, Listener done);

 private:
  struct Kept {
    Sha256Digest key;
    std::shared_ptr<const ServedTable> table;
    std::size_t bytes;
  };
  using KeptList = std::list<Kept>;
  // Seas that wait or are being compiled, with those who asked for them.
  using Asked = std::map<Sha256Digest, std::vector<Listener>>;

  void Run();
  Result Make(const WantedTable& wanted);
  Result CompileNow(const KnownSea& sea, double index);
  // With the mutex held.
  std::shared_ptr<const ServedTable> FindKept(const Sha256Digest& key);
  void Keep(const Sha256Digest& key, const std::shared_ptr<const ServedTable>& table);

  const Limits limits_;
  const SeaCompiler compiler_;
  SeaMetrics& metrics_;
  CallLog& log_;

  std::mutex mutex_;  // Guards the members up to the blank line.
  KeptList kept_;     // The one used last first.
  std::map<Sha256Digest, KeptList::iterator> places_;
  std::size_t kept_bytes_ = 0;
  Asked asked_;
  std::deque<WantedTable> waiting_;  // The one that waits longest first.
  bool stopping_ = false;
  std::condition_variable changed_;

  std::vector<std::thread> threads_;  // Last, because they use all other members.
};

}  // namespace albtpu::server
