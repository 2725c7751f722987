#include "service/server/connections/connection_watch.h"

#include <algorithm>
#include <utility>

#include "service/server/ground/limits.h"
#include "service/server/observe/process_metrics.h"

namespace albtpu::server {
namespace {

double ResidentBytes() {
  const std::optional<ProcessMemory> memory = ReadProcessMemory();
  return memory.has_value() ? memory->resident_bytes : 0;
}

}  // namespace

std::vector<Caller> CallersToDisconnect(std::vector<ConnectionCalls> connections) {
  std::sort(connections.begin(), connections.end(),
            [](const ConnectionCalls& a, const ConnectionCalls& b) { return a.calls > b.calls; });
  long total = 0;
  for (const ConnectionCalls& connection : connections) total += connection.calls;
  std::vector<Caller> callers;
  for (const ConnectionCalls& connection : connections) {
    if (connection.calls <= kMaxCallsInMemory && total <= kMaxTotalCallsInMemory) break;
    callers.push_back(connection.caller);
    total -= connection.calls;
  }
  return callers;
}

ConnectionWatch::ConnectionWatch(std::function<void(const std::vector<Caller>&)> disconnect)
    : disconnect_(std::move(disconnect)),
      resident_bytes_(ResidentBytes()),
      checking_(kMemoryCheckInterval, [this] { Check(); }) {}

void ConnectionWatch::Check() {
  const double bytes = ResidentBytes();
  if (bytes > resident_bytes_ + static_cast<double>(kMemoryGrowth)) {
    const std::vector<Caller> callers = CallersToDisconnect(CountConnectionCalls());
    if (!callers.empty()) disconnect_(callers);
    resident_bytes_ = bytes;
  }
  resident_bytes_ = std::min(resident_bytes_, bytes);
}

}  // namespace albtpu::server
