#include "service/server/observe/access_metrics.h"

namespace albtpu::server {

AccessMetrics::AccessMetrics(prometheus::Registry& registry)
    : certificate_expiry_(prometheus::BuildGauge()
                              .Name("albtpu_certificate_expiry_timestamp_seconds")
                              .Help("When the certificate ends that new connections are shown.")
                              .Register(registry)) {
  connections_ = &prometheus::BuildCounter()
                      .Name("albtpu_refused_connections_total")
                      .Help("Connections that were closed at once: there were as many as can be.")
                      .Register(registry)
                      .Add({});
  ended_ = &prometheus::BuildCounter()
                .Name("albtpu_ended_connections_total")
                .Help("Connections that were ended: they had more calls in memory than they may.")
                .Register(registry)
                .Add({});
  auto& calls = prometheus::BuildCounter()
                    .Name("albtpu_refused_calls_total")
                    .Help("Calls that were refused before they reached a method, by reason.")
                    .Register(registry);
  no_token_ = &calls.Add({{"reason", "no token"}});
  wrong_token_ = &calls.Add({{"reason", "wrong token"}});
}

}  // namespace albtpu::server
