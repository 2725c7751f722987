// Answers from a service.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// What is done about a server that goes away while it is asked: the same again, so many times, after pauses
// that double each time. The defaults wait 12.7 s. Every answer that comes starts the count anew.
struct Patience {
  int retries = 7;
  std::chrono::milliseconds first_pause{100};
};

// Asks in columns, so many pulses at a time as a message may hold, several messages ahead of the answers. The
// table is fixed when the source is opened: every answer must come from its content.
class ServerSource : public UncertaintySource {
 public:
  // `address` is HOST:PORT, `table` what to ask for, empty for the server's default. A server that is not
  // there from the beginning is not waited for.
  static absl::StatusOr<std::unique_ptr<ServerSource>> Open(const std::string& address,
                                                            const std::string& table,
                                                            const Patience& patience = {});

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;

 private:
  ServerSource(std::string address, const std::shared_ptr<grpc::Channel>& channel, TableSummary summary,
               Patience patience);

  std::string address_;
  grpc::GenericStub stub_;
  TableSummary summary_;
  Patience patience_;
};

// All tables of a server.
absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address);

}  // namespace albtpu::client
