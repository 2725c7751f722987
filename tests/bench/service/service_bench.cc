// service_bench serve-raw|serve-raw-budget --table TABLE.h5
// service_bench PEER --address A --table TABLE.h5 --server-pid P [--batch N] [--callers N] [--in-flight N]
//               [--connections N] [--seconds S] [--beside N]
//
// Serves a table over plain TCP connections. Or queries a server for some seconds, checks the answers against the
// table, and prints one JSON object: pulses and calls per second, the latency of calls (s), and the processor time of
// client and server per pulse (s).
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "sea/table/table_at_index.h"
#include "sea/water_index.h"
#include "tables/file/table_io.h"
#include "tests/bench/service/flight_line.h"
#include "tests/bench/service/load.h"
#include "tests/bench/service/raw_peer.h"

namespace albtpu::bench {
namespace {

// In a flight line. It takes some megabytes, so that columns come from main memory as they do for a survey.
constexpr std::size_t kBatches = 16;
constexpr std::size_t kStreamBatch = 65536;  // pulses in one message of a stream

struct Options {
  std::string peer, address, table;
  int server_pid = 0;
  std::size_t batch = kStreamBatch, callers = 1, in_flight = 1, connections = 1, beside = 0;
  double seconds = 2;
};

constexpr std::array<std::pair<std::string_view, void (*)(const Load&, Record&)>, 8> kPeers = {{
    {"raw", AskRaw},
    {"columns", AskColumns},
    {"stream", AskStream},
    {"rows", AskRows},
    {"raw-single", AskRawSingle},
    {"stream-single", AskStreamSingle},
    {"budget", AskBudget},
    {"raw-budget", AskRawBudget},
}};

// The answers of the table itself over a plain connection, or in this process.
AnswerRaw AnswersOf(const ColumnInterpolator& table, bool budget) {
  if (!budget) {
    return [&table](const float& wind_speed, const Columns& columns, float* numbers, std::uint8_t* outcomes) {
      const std::size_t count = columns[0].size();
      table.Interpolate({}, PulsesOf(wind_speed, columns), 0, count, AnswersIn(numbers, outcomes, count));
    };
  }
  return [&table](const float& wind_speed, const Columns& columns, float* numbers, std::uint8_t* outcomes) {
    QueryBudgetOnAllCores(table, BudgetPulsesOf(wind_speed, columns), OptionsOfBudget(),
                          BudgetAnswersIn(numbers, outcomes, columns[0].size()));
  };
}

// Ends the program unless all answers equal those of the table itself bit by bit.
void ExpectAnswersOf(const ColumnInterpolator& table, bool budget, const FlightLine& line,
                     const std::vector<AnswerMemory>& answers) {
  AnswerMemory expected(line.size());
  AnswersOf(table, budget)(line.wind_speed(), line.columns(0, line.size()), expected.numbers(), expected.outcomes());
  for (const AnswerMemory& memory : answers) Check(memory == expected, "answers differ from those of the table itself");
}

int Ask(const Options& options, const ColumnInterpolator& table) {
  const auto peer =
      std::find_if(kPeers.begin(), kPeers.end(), [&](const auto& known) { return known.first == options.peer; });
  Check(peer != kPeers.end(), "no peer '" + options.peer + "'");
  const FlightLine line(kBatches * options.batch), bulk_line(options.beside > 0 ? kBatches * kStreamBatch : 0);
  std::vector<AnswerMemory> answers(options.callers, AnswerMemory(line.size()));
  std::vector<AnswerMemory> bulk_answers(options.beside, AnswerMemory(bulk_line.size()));
  const double client_before = OwnProcessorTime(), server_before = ProcessorTimeOf(options.server_pid);
  const Clock::time_point begin = Clock::now();
  Record record(options.seconds), bulk(options.seconds);
  std::vector<std::thread> threads;
  for (AnswerMemory& memory : answers) {
    threads.emplace_back(peer->second,
                         Load{options.address, line, memory, options.batch, options.in_flight, options.connections},
                         std::ref(record));
  }
  for (AnswerMemory& memory : bulk_answers)
    threads.emplace_back(AskStream, Load{options.address, bulk_line, memory, kStreamBatch, 1, 1}, std::ref(bulk));
  for (std::thread& thread : threads) thread.join();
  const double elapsed = Seconds(Clock::now() - begin);
  const auto pulses = static_cast<double>(record.pulses());
  const nlohmann::json report = {
      {"peer", options.peer},
      {"pulses_per_second", pulses / elapsed},
      {"calls_per_second", static_cast<double>(record.calls()) / elapsed},
      {"latency", {{"p50", record.Latency(0.5)}, {"p99", record.Latency(0.99)}, {"max", record.Latency(1)}}},
      {"client_cpu_per_pulse", (OwnProcessorTime() - client_before) / pulses},
      {"server_cpu_per_pulse", (ProcessorTimeOf(options.server_pid) - server_before) / pulses},
      {"bulk_pulses_per_second", static_cast<double>(bulk.pulses()) / elapsed}};
  ExpectAnswersOf(table, options.peer.ends_with("budget"), line, answers);
  if (options.beside > 0) ExpectAnswersOf(table, false, bulk_line, bulk_answers);
  std::cout << report.dump() << "\n";
  return 0;
}

int Main(int argc, char** argv) {
  Options options;
  CLI::App app("Queries an uncertainty server as fast as it answers.", "service_bench");
  app.add_option(
         "peer", options.peer,
         "serve-raw, serve-raw-budget, raw, raw-single, raw-budget, columns, rows, stream, stream-single or budget")
      ->required();
  app.add_option("--table", options.table, "The table to query")->required();
  app.add_option("--address", options.address, "HOST:PORT of albtpu-serve, PORT of serve-raw");
  app.add_option("--server-pid", options.server_pid, "The process whose processor time is counted");
  app.add_option("--batch", options.batch, "Pulses in one message");
  app.add_option("--callers", options.callers, "Threads that query");
  app.add_option("--in-flight", options.in_flight, "Messages in flight of a caller (raw and stream: see load.h)");
  app.add_option("--connections", options.connections, "Connections that a caller uses in turn")
      ->check(CLI::PositiveNumber);
  app.add_option("--beside", options.beside, "Further threads that stream and are not counted");
  app.add_option("--seconds", options.seconds, "Duration of the load");
  CLI11_PARSE(app, argc, argv);
  const auto table = ReadTable(options.table);
  Check(table.ok(), table.status().ToString());
  const ColumnInterpolator interpolator(AtIndex(*table, kSeaWaterIndex));  // As a server answers.
  const bool budget = options.peer.ends_with("budget");
  if (options.peer.starts_with("serve-raw")) ServeRaw(budget ? kBudget : kSeaSurface, AnswersOf(interpolator, budget));
  return Ask(options, interpolator);
}

// Keeps the freed memory of messages, whose page faults would cost more than the messages themselves. In so short a
// run, this does not increase the memory.
void KeepFreedMemory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 16 << 20);
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  albtpu::bench::KeepFreedMemory();
  // As in albtpu-serve and albtpu-query.
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);
  return albtpu::bench::Main(argc, argv);
}
