// Answers from a service.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "service/client/uncertainty_source.h"

namespace albtpu::client {

// Asks in columns, so many pulses at a time as a message may hold. The table is fixed when the source is
// opened: every answer must come from its content.
class ServerSource : public UncertaintySource {
 public:
  // `address` is HOST:PORT, `table` what to ask for, empty for the server's default.
  static absl::StatusOr<std::unique_ptr<ServerSource>> Open(const std::string& address,
                                                            const std::string& table);

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;

 private:
  using Stub = albtpu::v1::UncertaintyService::StubInterface;

  ServerSource(std::string address, std::unique_ptr<Stub> stub, TableSummary summary);

  // Pulses of one message.
  absl::Status AnswerBatch(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers);

  std::string address_;
  std::unique_ptr<Stub> stub_;
  TableSummary summary_;
};

// All tables of a server.
absl::StatusOr<std::vector<TableSummary>> ListServerTables(const std::string& address);

}  // namespace albtpu::client
