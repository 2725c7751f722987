// The callers of the service benchmark, one function for each kind of message. Each function queries until the record's
// time is over, every pulse of the line at least once, and leaves the answers in `answers`.
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
  std::size_t batch;        // pulses in one message
  std::size_t in_flight;    // messages in flight of one caller
  std::size_t connections;  // used by its calls in turn; streams and plain connections have one
};

// Many pulses per message. Over a plain TCP connection there is one message in flight; two callers keep two cores busy.
void AskRaw(const Load& load, Record& record);
void AskColumns(const Load& load, Record& record);  // QueryColumns
void AskRows(const Load& load, Record& record);     // QueryPulses
void AskStream(const Load& load,
               Record& record);  // StreamColumns: a stream for each line, 65 536 pulses per message

// One pulse per message, on one connection.
void AskRawSingle(const Load& load, Record& record);
void AskStreamSingle(const Load& load, Record& record);  // StreamColumns

// A channel with its own connection, comparable with a plain TCP connection. Channels to one server otherwise share
// one.
std::shared_ptr<grpc::Channel> ChannelTo(const std::string& address);

// Makes unary calls of a method of the service, `in_flight` at a time, each for the next `batch` pulses. `request`
// writes a message; `read` reads the response.
void AskInCalls(const Load& load, Record& record, const std::string& method,
                const std::function<grpc::ByteBuffer(const PulseColumns&)>& request,
                const std::function<void(grpc::ByteBuffer& response, const AnswerColumns&)>& read);

}  // namespace albtpu::bench
