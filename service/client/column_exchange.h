// One call of `StreamColumns`, from the caller's side.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::client {

// The most pulses of a message, by uncertainty_service.proto.
inline constexpr std::size_t kMostPulses = 65536;

// What is asked and where answers go. Any number of pulses; messages take them kMostPulses at a time.
struct ColumnTask {
  const std::string& table;   // By name.
  const std::string& digest;  // Of the only content that may answer.
  const Query& query;
  const PulseColumns& pulses;
  const AnswerColumns& answers;
};

// Asks for the pulses from `begin` on, a few messages ahead of the answers, until all are answered or
// something fails. `begin` is moved behind the last pulse that was answered: whoever asks again goes on
// there. Statuses are those of the server, and
// * DEADLINE_EXCEEDED: no answer for a minute, which a healthy server needs a thousandth of;
// * UNAVAILABLE: the server ended the call early;
// * ABORTED: the table has another content than `digest`;
// * INTERNAL: an answer breaks its own rules.
absl::Status Exchange(grpc::GenericStub& stub, const ColumnTask& task, std::size_t& begin);

}  // namespace albtpu::client
