#include "service/server/calls/water_shares.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <string>

#include "service/client/wire.h"
#include "service/server/calls/water_request.h"
#include "tests/budget/water/known_waters.h"
#include "tests/tables/water/shipped_water.h"

namespace albtpu::server {
namespace {

KnownWater Secchi(double depth) { return testing::CoastalWater({.secchi = depth}); }
Sha256Digest Key(const KnownWater& water) { return KeyOf(client::ToWire(water), ""); }

std::shared_ptr<const TableCatalog::Water> ShippedTable() {
  static const auto table = std::make_shared<const TableCatalog::Water>(
      TableCatalog::Water{SHIPPED_WATER_TABLE, *testing::ShippedWaterTable(), IdentityOf(SHIPPED_WATER_TABLE)});
  return table;
}

class WaterSharesTest : public ::testing::Test {
 protected:
  // Asks for a water and waits for the answer.
  static WaterShares::Result Compile(WaterShares& waters, const KnownWater& water,
                                     const std::shared_ptr<const TableCatalog::Water>& table = ShippedTable()) {
    std::promise<WaterShares::Result> answer;
    waters.Compile({Key(water), water, table}, [&](const WaterShares::Result& result) { answer.set_value(result); });
    return answer.get_future().get();
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
  WaterMetrics metrics_{registry_};
  CallLog log_;
};

TEST_F(WaterSharesTest, KeepAWater) {
  WaterShares waters(metrics_, log_);
  EXPECT_EQ(waters.Find(Key(Secchi(5))), nullptr);
  const WaterShares::Result water = Compile(waters, Secchi(5));
  ASSERT_TRUE(water.ok()) << water.status();
  EXPECT_EQ(waters.Find(Key(Secchi(5))), *water);
  EXPECT_EQ(*Compile(waters, Secchi(5)), *water);
  EXPECT_EQ((*water)->summary.table().digest(), testing::ShippedWaterTable()->table().digest());
  EXPECT_EQ(Value("albtpu_water_requests_total", "compiled"), 1);
  EXPECT_EQ(Value("albtpu_water_requests_total", "found"), 2);
  EXPECT_GT(Value("albtpu_water_bytes"), 10000);
  EXPECT_LT(Value("albtpu_water_bytes"), double{kMaxWaterBytes} / kMaxWaters);
}

TEST_F(WaterSharesTest, DropTheWaterThatWasNotUsedLongest) {
  WaterShares waters(metrics_, log_, {.waters = 2});
  ASSERT_TRUE(Compile(waters, Secchi(4)).ok());
  ASSERT_TRUE(Compile(waters, Secchi(5)).ok());
  EXPECT_NE(waters.Find(Key(Secchi(4))), nullptr);
  ASSERT_TRUE(Compile(waters, Secchi(6)).ok());
  EXPECT_EQ(waters.Find(Key(Secchi(5))), nullptr);
  EXPECT_NE(waters.Find(Key(Secchi(4))), nullptr);
  EXPECT_EQ(Value("albtpu_water_evictions_total"), 1);
  EXPECT_EQ(Value("albtpu_waters"), 2);
}

TEST_F(WaterSharesTest, RefuseWatersForWhichThereIsNoPlaceToWait) {
  constexpr int kWaters = 12;
  std::atomic<int> compiled = 0, refused = 0;
  WaterShares waters(metrics_, log_, {.waiting = 2});
  for (int i = 0; i < kWaters; ++i) {
    const KnownWater water = Secchi(3 + 0.1 * i);
    waters.Compile({Key(water), water, ShippedTable()}, [&](const WaterShares::Result& result) {
      if (result.ok()) ++compiled;
      if (absl::IsResourceExhausted(result.status())) ++refused;
    });
  }
  EXPECT_GT(refused, kWaters / 2);  // Asking takes microseconds, compiling half a second.
  while (compiled + refused < kWaters) std::this_thread::yield();
  EXPECT_GT(compiled, 0);
  EXPECT_EQ(Value("albtpu_water_requests_total", "refused"), refused);
}

TEST_F(WaterSharesTest, SayWhatTheTableDoesNotCover) {
  WaterShares waters(metrics_, log_);
  KnownWater water = Secchi(5);
  water.bias = BiasTreatment{.handling = BiasHandling::kCalibrated, .calibration_depth = 100};
  const absl::Status status = Compile(waters, water).status();
  EXPECT_TRUE(absl::IsInvalidArgument(status)) << status;
  EXPECT_EQ(waters.Find(Key(water)), nullptr);
  EXPECT_EQ(Value("albtpu_water_requests_total", "failed"), 1);
}

TEST_F(WaterSharesTest, NeedNoTableForTheSurfaceAlone) {
  WaterShares waters(metrics_, log_);
  KnownWater water = Secchi(5);
  water.bias.reset();
  water.green_surface = true;
  const WaterShares::Result surface = Compile(waters, water, nullptr);
  ASSERT_TRUE(surface.ok()) << surface.status();
  EXPECT_GT((*surface)->summary.green_surface_range(), 0.02);
}

}  // namespace
}  // namespace albtpu::server
