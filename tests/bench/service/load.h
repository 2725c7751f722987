// The load on a server and its record: the callers of the service benchmark, one function for each kind of message.
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "tests/bench/service/flight_line.h"

namespace albtpu::bench {

using Clock = std::chrono::steady_clock;

inline double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

double OwnProcessorTime();        // s
double ProcessorTimeOf(int pid);  // s

// Collects the pulses and latencies of all callers, and tells them when to stop.
class Record {
 public:
  explicit Record(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  bool going_on() const { return Clock::now() < end_; }
  void Add(std::size_t pulses, const std::vector<double>& latencies);

  std::size_t pulses() const { return pulses_; }
  std::size_t calls() const { return latencies_.size(); }
  double Latency(double quantile);

 private:
  const Clock::time_point end_;
  std::mutex mutex_;
  std::size_t pulses_ = 0;
  std::vector<double> latencies_;
};

// Each caller queries until the record's time is over, every pulse of the line at least once, and leaves the answers in
// `answers`.
struct Load {
  const std::string& address;
  const FlightLine& line;
  AnswerMemory& answers;
  std::size_t batch;        // Pulses in one message.
  std::size_t in_flight;    // Messages in flight of one caller.
  std::size_t connections;  // Used by its calls in turn; streams and plain connections have one.
};

// Many pulses per message. Over a plain TCP connection there is one message in flight; two callers keep two cores busy.
void AskRaw(const Load& load, Record& record);
void AskRawBudget(const Load& load, Record& record);
void AskColumns(const Load& load, Record& record);  // QueryColumns
void AskRows(const Load& load, Record& record);     // QueryPulses
void AskStream(const Load& load, Record& record);   // StreamColumns: a stream for each line, 65 536 pulses per message.
void AskBudget(const Load& load, Record& record);   // QueryBudget, as the client asks for a whole line.

// One pulse per message, on one connection.
void AskRawSingle(const Load& load, Record& record);
void AskStreamSingle(const Load& load, Record& record);  // StreamColumns

}  // namespace albtpu::bench
