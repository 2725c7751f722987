#include "service/server/calls/sea_tables.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <string>

#include "service/client/wire.h"
#include "service/server/calls/sea_request.h"
#include "tests/service/known_seas.h"

namespace albtpu::server {
namespace {

Sha256Digest Key(const KnownSea& sea) { return KeyOf(client::ToWire(sea)); }

class SeaTablesTest : public ::testing::Test {
 protected:
  // Asks for a sea and waits for the answer.
  static SeaTables::Result Compile(SeaTables& tables, const KnownSea& sea) {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<SeaTables::Result> answer;
    tables.Compile({Key(sea), sea, kSeaWaterIndex}, [&](const SeaTables::Result& result) {
      const std::lock_guard lock(mutex);
      answer.emplace(result);
      changed.notify_one();
    });
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return answer.has_value(); });
    return *answer;
  }

  // The value of a metric, over all its labels or with the label value `result`.
  double Value(const std::string& name, const std::string& result = "") const {
    double sum = 0;
    for (const prometheus::MetricFamily& family : registry_.Collect()) {
      if (family.name != name) continue;
      for (const prometheus::ClientMetric& metric : family.metric)
        if (result.empty() || metric.label.at(0).value == result) sum += metric.counter.value + metric.gauge.value;
    }
    return sum;
  }

  prometheus::Registry registry_;
  SeaMetrics metrics_{registry_};
  CallLog log_;
};

TEST_F(SeaTablesTest, KeepTheTableOfASea) {
  SeaTables tables(metrics_, log_);
  const KnownSea sea = testing::DescribedWaves();
  EXPECT_EQ(tables.Find(Key(sea)), nullptr);
  const SeaTables::Result table = Compile(tables, sea);
  EXPECT_EQ((*table)->table.digest(), CompileSea(SeaCompiler(), sea).value().digest());
  EXPECT_EQ(tables.Find(Key(sea)), *table);
  EXPECT_EQ(*Compile(tables, sea), *table);
  EXPECT_EQ(Value("albtpu_sea_requests_total", "compiled"), 1);
  EXPECT_EQ(Value("albtpu_sea_requests_total", "found"), 2);
}

TEST_F(SeaTablesTest, CompileASeaOnceForAllWhoAskAtOnce) {
  constexpr int kThreads = 8, kSeas = 3;
  SeaTables tables(metrics_, log_);
  std::atomic<int> answered = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int sea = 0; sea < kSeas; ++sea)
        if (Compile(tables, testing::WindSea(5.0 + sea)).ok()) ++answered;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(answered, kThreads * kSeas);
  EXPECT_EQ(Value("albtpu_sea_requests_total", "compiled"), kSeas);
}

TEST_F(SeaTablesTest, DropTheTableThatWasNotUsedLongest) {
  SeaTables tables(metrics_, log_, {.tables = 2});
  const KnownSea a = testing::WindSea(5), b = testing::WindSea(6), c = testing::WindSea(7);
  const SeaTables::Result held = Compile(tables, a);
  ASSERT_TRUE(Compile(tables, b).ok());
  EXPECT_NE(tables.Find(Key(a)), nullptr);
  ASSERT_TRUE(Compile(tables, c).ok());
  EXPECT_EQ(tables.Find(Key(b)), nullptr);
  EXPECT_EQ(tables.Find(Key(a)), *held);
  EXPECT_EQ(Value("albtpu_sea_evictions_total"), 1);
  EXPECT_EQ(Value("albtpu_sea_tables"), 2);
}

TEST_F(SeaTablesTest, StayWithinTheirBytes) {
  SeaTables tables(metrics_, log_, {.bytes = 1});
  ASSERT_TRUE(Compile(tables, testing::WindSea(5)).ok());
  ASSERT_TRUE(Compile(tables, testing::WindSea(6)).ok());
  EXPECT_EQ(Value("albtpu_sea_tables"), 1);  // The last one always stays.
  EXPECT_GT(Value("albtpu_sea_table_bytes"), 1);
}

TEST_F(SeaTablesTest, RefuseSeasForWhichThereIsNoPlaceToWait) {
  constexpr int kSeas = 40;
  std::atomic<int> compiled = 0, refused = 0;
  {
    SeaTables tables(metrics_, log_, {.waiting = 2});
    for (int i = 0; i < kSeas; ++i) {
      const KnownSea sea = testing::WindSea(3 + 0.1 * i);
      tables.Compile({Key(sea), sea, kSeaWaterIndex}, [&](const SeaTables::Result& result) {
        if (result.ok()) ++compiled;
        if (absl::IsResourceExhausted(result.status())) ++refused;
      });
    }
    EXPECT_GT(refused, kSeas / 2);  // Asking takes microseconds, compiling milliseconds.
    while (compiled + refused < kSeas) std::this_thread::yield();
  }
  EXPECT_GT(compiled, 0);
  EXPECT_EQ(Value("albtpu_sea_requests_total", "refused"), refused);
}

TEST_F(SeaTablesTest, AnswerAllWhoWaitWhenTheServerStops) {
  std::atomic<int> answered = 0;
  {
    SeaTables tables(metrics_, log_);
    for (int i = 0; i < 10; ++i) {
      const KnownSea sea = testing::WindSea(4 + i);
      tables.Compile({Key(sea), sea, kSeaWaterIndex}, [&](const SeaTables::Result&) { ++answered; });
    }
  }
  EXPECT_EQ(answered, 10);
}

}  // namespace
}  // namespace albtpu::server
