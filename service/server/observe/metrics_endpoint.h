// The endpoint that Prometheus scrapes: plain HTTP, GET /metrics.
#pragma once

#include <prometheus/exposer.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/ground/listening_sockets.h"

namespace albtpu::server {

class MetricsEndpoint {
 public:
  // Listens until it is destroyed, and serves the metrics of all `sources` that still exist. Unavailable, with the
  // reason, if it cannot listen.
  static absl::StatusOr<std::unique_ptr<MetricsEndpoint>> Start(
      const ListenAddress& address, const std::vector<std::shared_ptr<prometheus::Collectable>>& sources);

  // HOST:PORT with the actual port.
  const std::string& address() const { return address_; }

 private:
  MetricsEndpoint(std::unique_ptr<prometheus::Exposer> exposer, std::string address)
      : exposer_(std::move(exposer)), address_(std::move(address)) {}

  std::unique_ptr<prometheus::Exposer> exposer_;
  std::string address_;
};

}  // namespace albtpu::server
