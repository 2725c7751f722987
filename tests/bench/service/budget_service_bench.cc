// budget_service_bench serve-raw TABLE.h5
// budget_service_bench raw TABLE.h5 PORT [SECONDS]
// budget_service_bench budget TABLE.h5 HOST:PORT [SECONDS]
//
// Asks for the whole budget of a flight line, all shares and all columns of attitude, velocity and rates, THU and TVU
// in return: of albtpu-serve by QueryBudget, or of the same sums behind a plain TCP connection. Checks the answers bit
// by bit, and prints pulses per second.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "budget/query/budget_query.h"
#include "service/client/server_source.h"
#include "tables/file/table_io.h"
#include "tests/bench/service/flight_line.h"
#include "tests/bench/service/raw_socket.h"
#include "tests/budget/query/budget_memory.h"

namespace albtpu::bench {
namespace {

constexpr std::size_t kBatch = 65536, kBatches = 16;
constexpr std::array<AxisId, 4> kAxisColumns = {AxisId::kIncidence, AxisId::kAzimuth, AxisId::kFootprint,
                                                AxisId::kDepth};
// The inputs of the aircraft up to the rates are columns; standard deviations are those of the options.
constexpr std::size_t kAircraftColumns = 11, kColumns = kAxisColumns.size() + kAircraftColumns;
constexpr std::size_t kAnswerBytes = 2 + 2 * sizeof(float);  // Of one pulse.
constexpr float kWindSpeed = 6.5f;

BudgetOptions Options() {
  BudgetOptions options = testing::UsualOptions();
  options.coverage = Coverage::kTwoSigma;
  return options;
}

// The columns of `count` pulses that lie one after the other.
BudgetPulses PulsesIn(const float* columns, std::size_t count) {
  BudgetPulses pulses;
  pulses.pulses.size = pulses.aircraft.size = count;
  pulses.pulses.axis[Index(AxisId::kWindSpeed)] = {&kWindSpeed, 1};
  for (const AxisId axis : kAxisColumns) {
    pulses.pulses.axis[Index(axis)] = {columns, count};
    columns += count;
  }
  for (std::size_t i = 0; i < kAircraftColumns; ++i, columns += count)
    pulses.aircraft[kAircraftInputs[i]] = {columns, count};
  pulses.sea_axis = 70;
  return pulses;
}

std::vector<float> Columns(std::size_t count) {
  const FlightLine line(count);
  std::vector<float> columns;
  for (const AxisId axis : kAxisColumns)
    columns.insert(columns.end(), line.pulses()[axis].begin(), line.pulses()[axis].end());
  constexpr std::array<double, kAircraftColumns> kMeans = {400, 90, 1, 4, 30, 58, 31, 0.4, 1.9, -0.8, 0.6};
  for (std::size_t c = 0; c < kAircraftColumns; ++c)
    for (std::size_t i = 0; i < count; ++i)
      columns.push_back(static_cast<float>(kMeans[c] * (1 + 0.1 * std::sin(0.001 * static_cast<double>(i * (c + 1))))));
  return columns;
}

BudgetAnswers AnswersIn(char* bytes, std::size_t count) {
  auto* const numbers = reinterpret_cast<float*>(bytes);
  BudgetAnswers answers{.outcomes = reinterpret_cast<std::uint8_t*>(bytes) + 2 * count * sizeof(float)};
  answers.outcome_axes = answers.outcomes + count;
  answers.columns[FirstColumn(BudgetQuantity::kTotalThu)] = numbers;
  answers.columns[FirstColumn(BudgetQuantity::kTotalTvu)] = numbers + count;
  return answers;
}

void ServeRaw(const ColumnInterpolator& table) {
  ServeConnections([&table](int socket) {
    std::vector<float> request(kColumns * kBatch);
    std::vector<char> answer(kAnswerBytes * kBatch);
    const std::size_t bytes = request.size() * sizeof(float);
    while (ReadAll(socket, reinterpret_cast<char*>(request.data()), bytes)) {
      QueryBudgetOnAllCores(table, PulsesIn(request.data(), kBatch), Options(), AnswersIn(answer.data(), kBatch));
      if (!WriteAll(socket, answer.data(), answer.size())) return;
    }
  });
}

// Two callers, which keep two cores busy.
std::size_t AskRaw(const std::string& port, const std::vector<std::vector<float>>& requests,
                   std::vector<std::vector<char>>& answers, double seconds) {
  std::vector<std::size_t> pulses(2);
  std::vector<std::thread> callers;
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t caller = 0; caller < pulses.size(); ++caller) {
    callers.emplace_back([&, caller] {
      const int socket = ConnectTo(port);
      for (std::size_t i = caller; std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(seconds) ||
                                   pulses[caller] < kBatches / 2 * kBatch;
           i = (i + 2) % kBatches) {
        const std::size_t bytes = requests[i].size() * sizeof(float);
        if (!WriteAll(socket, reinterpret_cast<const char*>(requests[i].data()), bytes) ||
            !ReadAll(socket, answers[i].data(), answers[i].size())) {
          std::cerr << "budget_service_bench: the peer closed the connection\n";
          std::exit(1);
        }
        pulses[caller] += kBatch;
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  return pulses[0] + pulses[1];
}

std::size_t AskService(const std::string& address, const std::vector<float>& line, std::vector<char>& answers,
                       double seconds) {
  const auto source = client::OpenServer(address, "");
  absl::Status status = source.status();
  std::size_t pulses = 0;
  const auto begin = std::chrono::steady_clock::now();
  while (status.ok() && std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(seconds)) {
    status = (*source)->AnswerBudget(Options(), PulsesIn(line.data(), kBatches * kBatch),
                                     AnswersIn(answers.data(), kBatches * kBatch));
    pulses += kBatches * kBatch;
  }
  if (status.ok()) return pulses;
  std::cerr << "budget_service_bench: " << status << "\n";
  std::exit(1);
}

int Main(const std::vector<std::string>& arguments) {
  if (arguments.size() < 2) {
    std::cerr << "budget_service_bench: give serve-raw, raw or budget, the table, and the address\n";
    return 2;
  }
  const auto table = ReadTable(arguments[1]);
  if (!table.ok()) {
    std::cerr << table.status() << "\n";
    return 1;
  }
  const ColumnInterpolator interpolator(*table);
  if (arguments[0] == "serve-raw") ServeRaw(interpolator);
  const double seconds = arguments.size() > 3 ? std::stod(arguments[3]) : 2;
  const std::size_t size = kBatches * kBatch;
  const std::vector<float> line = Columns(size);
  std::vector<char> expected(kAnswerBytes * size), answers(kAnswerBytes * size);
  QueryBudgetOnAllCores(interpolator, PulsesIn(line.data(), size), Options(), AnswersIn(expected.data(), size));
  const bool raw = arguments[0] == "raw";
  std::vector<std::vector<float>> requests(raw ? kBatches : 0);
  std::vector<std::vector<char>> parts(requests.size(), std::vector<char>(kAnswerBytes * kBatch));
  for (std::size_t b = 0; b < requests.size(); ++b) {
    for (std::size_t c = 0; c < kColumns; ++c) {
      const float* const column = line.data() + c * size + b * kBatch;
      requests[b].insert(requests[b].end(), column, column + kBatch);
    }
  }
  const auto begin = std::chrono::steady_clock::now();
  const std::size_t pulses =
      raw ? AskRaw(arguments[2], requests, parts, seconds) : AskService(arguments[2], line, answers, seconds);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  for (std::size_t b = 0; b < parts.size(); ++b) {  // The columns of all batches together.
    for (std::size_t c = 0; c < 2; ++c)
      std::memcpy(answers.data() + (c * size + b * kBatch) * 4, parts[b].data() + c * kBatch * 4, kBatch * 4);
    for (std::size_t c = 0; c < 2; ++c)
      std::memcpy(answers.data() + 8 * size + c * size + b * kBatch, parts[b].data() + 8 * kBatch + c * kBatch, kBatch);
  }
  if (answers != expected) {
    std::cerr << "budget_service_bench: answers differ from those in process\n";
    return 1;
  }
  std::cout << static_cast<double>(pulses) / elapsed.count() << "\n";
  return 0;
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  absl::SetMutexDeadlockDetectionMode(absl::OnDeadlockCycle::kIgnore);  // As in albtpu-serve and albtpu-query.
  return albtpu::bench::Main({argv + 1, argv + argc});
}
