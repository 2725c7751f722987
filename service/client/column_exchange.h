// One call of `StreamColumns`, seen from the client.
#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <cstddef>
#include <string>

#include "absl/status/status.h"
#include "albtpu/v1/sea.pb.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"

namespace albtpu::client {

// The largest number of pulses in a message (uncertainty_service.proto).
inline constexpr std::size_t kMostPulses = 65536;

// OK if `answered`, the digest of an answer, is that of the table of this name, or of the sea if `of_sea`; else
// ABORTED.
absl::Status CheckDigest(const std::string& table, bool of_sea, const std::string& digest, const std::string& answered);

// A query about any number of pulses, and the memory for its answers. Messages take kMostPulses pulses at a time.
template <typename Options, typename Pulses, typename Answers>
struct Task {
  const std::string& table;         // Its name; empty for a sea.
  const std::string& digest;        // The digest that every answer must come from.
  const albtpu::v1::SeaState* sea;  // Null for a table of the server's.
  const double refractive_index;
  const Options& query;
  const Pulses& pulses;
  const Answers& answers;
};
using ColumnTask = Task<Query, PulseColumns, AnswerColumns>;

// Queries the pulses from index `begin` on, a few messages ahead of the answers, until all are answered or something
// fails. Sets `begin` to the index after the last pulse answered, from which another call can continue. Returns the
// status of the server, or
// * DEADLINE_EXCEEDED: no answer for a minute; a healthy server needs a thousandth of that;
// * UNAVAILABLE: the server ended the call early;
// * ABORTED: the content of the table no longer has `digest`;
// * INTERNAL: an answer violates the protocol.
absl::Status QueryByStream(grpc::GenericStub& stub, const ColumnTask& task, std::size_t& begin);

}  // namespace albtpu::client
