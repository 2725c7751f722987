// What a caller of the service's benchmark asks, by way of which messages. Each function asks until the record's
// time is over, and leaves the answers, each pulse of the line once at least, in `answers`.
#pragma once

#include <grpcpp/grpcpp.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "tests/bench/service/flight_line.h"
#include "tests/bench/service/load_record.h"

namespace albtpu::bench {

struct Load {
  const std::string& address;
  const FlightLine& line;
  AnswerMemory& answers;
  std::size_t batch;        // Pulses of one message.
  std::size_t in_flight;    // Messages that one caller has under way.
  std::size_t connections;  // Over which its calls go in turn; streams and bare connections have one.
};

// Many pulses a message. Over a bare TCP connection, one message in flight: two callers keep two cores busy.
void AskRaw(const Load& load, Record& record);
void AskColumns(const Load& load, Record& record);  // `QueryColumns`.
void AskRows(const Load& load, Record& record);     // `QueryPulses`.
void AskStream(const Load& load,
               Record& record);  // `StreamColumns`, the whole line a time, 65 536 a message.

// One pulse a message, on one connection.
void AskRawSingle(const Load& load, Record& record);
void AskStreamSingle(const Load& load, Record& record);  // `StreamColumns`.

// A connection of its own, as a bare TCP connection is; channels to one server share one otherwise.
std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address);

// Unary calls of a method of the service, `in_flight` at a time, each for the next `batch` pulses: `request` writes
// a message, `read` takes the answer.
void AskInCalls(const Load& load, Record& record, const std::string& method,
                const std::function<grpc::ByteBuffer(const PulseColumns&)>& request,
                const std::function<void(grpc::ByteBuffer& response, const AnswerColumns&)>& read);

}  // namespace albtpu::bench
