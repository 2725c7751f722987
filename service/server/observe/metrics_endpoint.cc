#include "service/server/observe/metrics_endpoint.h"

#include <exception>

#include "absl/strings/str_cat.h"
#include "service/server/ground/limits.h"
#include "service/server/ground/listening_sockets.h"

namespace albtpu::server {

absl::StatusOr<std::unique_ptr<MetricsEndpoint>> MetricsEndpoint::Start(
    const ListenAddress& address, const std::vector<std::shared_ptr<prometheus::Collectable>>& sources) {
  // Tried first for the reason of a failure, which the library does not give.
  const absl::Status probe = Listen(address).status();
  if (!probe.ok()) return absl::UnavailableError(absl::StrCat("cannot listen on ", probe.message()));
  try {
    auto exposer = std::make_unique<prometheus::Exposer>(
        std::vector<std::string>{"listening_ports", address.ToString(), "num_threads", std::to_string(kMetricsThreads),
                                 "request_timeout_ms", std::to_string(kMetricsTimeout.count())});
    for (const auto& source : sources) exposer->RegisterCollectable(source);
    std::string bound = address.WithPort(exposer->GetListeningPorts().front());
    return std::unique_ptr<MetricsEndpoint>(new MetricsEndpoint(std::move(exposer), std::move(bound)));
  } catch (const std::exception& error) {
    return absl::UnavailableError(absl::StrCat("cannot listen on ", address.ToString(), ": ", error.what()));
  }
}

}  // namespace albtpu::server
