// Interpolated pulses per second. Names are WHO/MEGABYTES/ORDER/BATCH, the size of the table in megabytes and the
// number of pulses in a batch. WHO is one of
//   columns            THU, TVU and both biases by ColumnInterpolator
//   columns_all        all six quantities and outcomes
//   columns_errors     all six quantities, their standard errors and outcomes
//   columns_p95        all six quantities at 95 %, and outcomes
//   columns_absent     THU, TVU and both biases, without azimuth
//   columns_threads    as columns, by InterpolateOnAllCores
//   rows               Interpolate, one pulse after the other: all six quantities and their standard errors
//   plain              PlainInterpolator, one array for each quantity: THU, TVU and both biases
//   plain_side_by_side the same, with the quantities side by side
#include <absl/strings/str_cat.h>
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tables/query/column_query.h"
#include "tests/bench/interpolation/interpolation_case.h"
#include "tests/bench/interpolation/plain_interpolator.h"

namespace albtpu::bench {
namespace {

constexpr std::size_t kMany = std::size_t{1} << 17;

struct Tables {
  explicit Tables(int megabytes) : table(TableOf(megabytes)), columns(table), plain(table), side_by_side(table) {}
  UncertaintyTable table;
  ColumnInterpolator columns;
  PlainInterpolator<Quantities::kApart> plain;
  PlainInterpolator<Quantities::kSideBySide> side_by_side;
};

const Tables& TablesOf(int megabytes) {
  static std::map<int, std::unique_ptr<Tables>> tables;
  std::unique_ptr<Tables>& of_size = tables[megabytes];
  if (!of_size) of_size = std::make_unique<Tables>(megabytes);
  return *of_size;
}

struct Wanted {
  bool refraction = false;
  bool standard_errors = false;
  bool outcomes = false;
};

// Memory for the columns of answers.
class Answers {
 public:
  Answers(std::size_t count, const Wanted& wanted) : numbers_(2 * kQuantityCount * count), bytes_(2 * count) {
    for (std::size_t q = wanted.refraction ? 0 : 2; q < kQuantityCount; ++q) {
      columns_.values[q] = numbers_.data() + q * count;
      if (wanted.standard_errors) columns_.standard_errors[q] = numbers_.data() + (kQuantityCount + q) * count;
    }
    if (!wanted.outcomes) return;
    columns_.outcomes = bytes_.data();
    columns_.outcome_axes = bytes_.data() + count;
  }
  const AnswerColumns& columns() const { return columns_; }

 private:
  std::vector<float> numbers_;
  std::vector<std::uint8_t> bytes_;
  AnswerColumns columns_;
};

struct Case {
  int megabytes;
  Order order;
  std::size_t batch;
};

template <typename Run>
void Measure(benchmark::State& state, const Case& of, bool azimuth_absent, const Run& run) {
  const Tables& tables = TablesOf(of.megabytes);
  const PulseBatch pulses(tables.table, of.order, kMany, azimuth_absent);
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < kMany; begin += of.batch)
      run(tables, pulses.columns(), begin, std::min(kMany, begin + of.batch));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * kMany);
}

void Columns(benchmark::State& state, const Case& of, const Query& query, const Wanted& wanted, bool azimuth_absent) {
  const Answers answers(kMany, wanted);
  Measure(state, of, azimuth_absent,
          [&](const Tables& tables, const PulseColumns& pulses, std::size_t begin, std::size_t end) {
            tables.columns.Interpolate(query, pulses, begin, end, answers.columns());
          });
}

void OnAllCores(benchmark::State& state, const Case& of) {
  const Answers answers(kMany, {});
  Measure(state, of, false, [&](const Tables& tables, const PulseColumns& pulses, std::size_t, std::size_t) {
    InterpolateOnAllCores(tables.columns, {}, pulses, answers.columns());
  });
}

void Rows(benchmark::State& state, const Case& of) {
  Measure(state, of, false, [&](const Tables& tables, const PulseColumns& pulses, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) benchmark::DoNotOptimize(Interpolate(tables.table, PulseAt(pulses, i)));
  });
}

template <typename Interpolator>
void Plain(benchmark::State& state, const Case& of, Interpolator Tables::*interpolator) {
  const Answers answers(kMany, {});
  const auto& values = answers.columns().values;
  Measure(state, of, false, [&](const Tables& tables, const PulseColumns& pulses, std::size_t begin, std::size_t end) {
    (tables.*interpolator).Answer(pulses, begin, end, {values[2], values[3], values[4], values[5]});
  });
}

void Register(int megabytes, Order order, std::size_t batch) {
  const Case of{megabytes, order, batch};
  const auto add = [&](const std::string& who, auto run) {
    const std::string name =
        absl::StrCat(who, "/", megabytes, "/", order == Order::kScan ? "scan" : "random", "/", batch);
    return benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { run(state, of); })
        ->Unit(benchmark::kMillisecond);
  };
  const auto columns = [&](const std::string& who, const Query& query, const Wanted& wanted, bool absent) {
    add(who, [=](benchmark::State& state, const Case& c) { Columns(state, c, query, wanted, absent); });
  };
  const Wanted all{.refraction = true, .outcomes = true};
  columns("columns", {}, {}, false);
  add("plain", [](auto& state, const Case& c) { Plain(state, c, &Tables::plain); });
  if (batch < kMany) return add("rows", Rows), void();
  add("plain_side_by_side", [](auto& state, const Case& c) { Plain(state, c, &Tables::side_by_side); });
  columns("columns_all", {}, all, false);
  columns("columns_errors", {}, {.refraction = true, .standard_errors = true, .outcomes = true}, false);
  columns("columns_p95", {.coverage = Coverage::kP95, .s44_order = {}}, all, false);
  columns("columns_absent", {}, {}, true);
  add("columns_threads", OnAllCores)->UseRealTime();
  add("rows", Rows);
}

}  // namespace
}  // namespace albtpu::bench

int main(int argc, char** argv) {
  using albtpu::bench::Order;
  for (const int megabytes : {5, 15, 200})
    for (const Order order : {Order::kScan, Order::kRandom})
      albtpu::bench::Register(megabytes, order, albtpu::bench::kMany);
  for (const std::size_t batch : {1, 16, 256}) albtpu::bench::Register(15, Order::kScan, batch);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
