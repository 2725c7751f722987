// Who was turned away before any method was reached, and until when clients will trust the server.
#pragma once

#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/gauge.h>
#include <prometheus/registry.h>

#include <ctime>

namespace albtpu::server {

class AccessMetrics {
 public:
  explicit AccessMetrics(prometheus::Registry& registry);

  // There was no room for it.
  void CountRefusedConnection() { connections_->Increment(); }

  // It had more calls in memory than it may.
  void CountEndedConnection() { ended_->Increment(); }

  // Calls that bring no token, or one that is not accepted.
  void CountNoToken() { no_token_->Increment(); }
  void CountWrongToken() { wrong_token_->Increment(); }

  // Of the certificate that new connections are shown. A server without one has no such metric.
  void SetCertificateExpiry(std::time_t expiry) {
    certificate_expiry_.Add({}).Set(static_cast<double>(expiry));
  }

 private:
  prometheus::Counter* connections_;
  prometheus::Counter* ended_;
  prometheus::Counter* no_token_;
  prometheus::Counter* wrong_token_;
  prometheus::Family<prometheus::Gauge>& certificate_expiry_;
};

}  // namespace albtpu::server
