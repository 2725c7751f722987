#include "service/client/sea_sources.h"

#include <gmock/gmock.h>

#include <thread>

#include "sea/table/sea_table.h"
#include "service/client/wire.h"
#include "service/seas/sea_summary.h"
#include "service/server/calls/sea_request.h"
#include "tests/service/client/column_memory.h"
#include "tests/service/client/running_server.h"
#include "tests/service/known_seas.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::client {
namespace {

using albtpu::testing::SeasOfAllForms;
using ::testing::HasSubstr;

constexpr std::array<std::array<float, 2>, kAxisCount> kRanges = {
    {{-5, 20}, {-1, 1e5}, {-1, 32}, {-400, 400}, {0.05f, 7}, {-1, 65}}};  // Inside and outside the table.

TEST(SeaSources, SayTheSameAndGiveTheSameBitsInProcessAndOnAServer) {
  const RunningServer server;
  const auto local = LocalSeas();
  const auto remote = ServerSeas(server.address()).value();
  PulseMemory pulses = RandomPulses(70000, kRanges);  // More than one message.
  const Query query = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b};
  for (const KnownSea& sea : SeasOfAllForms()) {
    const auto here = local->Open(sea).value(), there = remote->Open(sea).value();
    EXPECT_EQ(here->table().digest, there->table().digest);
    EXPECT_EQ(here->table().attributes, there->table().attributes);
    const SeaSummary said = here->table().sea.value(), heard = there->table().sea.value();
    EXPECT_EQ(said.x_azimuth, heard.x_azimuth);
    EXPECT_EQ(said.significant_wave_height, heard.significant_wave_height);
    EXPECT_EQ(said.wind_speed_10m, heard.wind_speed_10m);
    EXPECT_EQ(said.water_depth, heard.water_depth);
    EXPECT_EQ(said.tail_from, heard.tail_from);
    EXPECT_EQ(said.share_measured, heard.share_measured);
    EXPECT_EQ(said.assumptions, heard.assumptions);
    AnswerMemory ours(pulses.size()), theirs(pulses.size());
    ASSERT_TRUE(here->Answer(query, pulses.columns(), ours.columns()).ok());
    ASSERT_TRUE(there->Answer(query, pulses.columns(), theirs.columns()).ok());
    EXPECT_TRUE(ours == theirs);
  }
}

TEST(SeaSources, IgnoreWindAndFetchOfPulses) {
  const auto source = LocalSeas()->Open(albtpu::testing::DescribedWaves()).value();
  PulseMemory pulses = RandomPulses(3000, kRanges);
  AnswerMemory with(pulses.size()), without(pulses.size());
  ASSERT_TRUE(source->Answer({}, pulses.columns(), with.columns()).ok());
  pulses.axis(AxisId::kWindSpeed).clear();
  pulses.axis(AxisId::kFetch).clear();
  ASSERT_TRUE(source->Answer({}, pulses.columns(), without.columns()).ok());
  EXPECT_TRUE(with == without);
}

TEST(SeaSources, SayWhichNumberOfASeaIsWrong) {
  const RunningServer server;
  const auto seas = ServerSeas(server.address()).value();
  const auto source = seas->Open({.wind_speed_10m = 200});
  EXPECT_EQ(source.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(source.status().message()), HasSubstr("wind_speed is 200 m/s (expected 0 to 150)"));
}

TEST(SeaSources, OpenSeasFromSeveralThreads) {
  const RunningServer server;
  const auto seas = ServerSeas(server.address()).value();
  std::vector<std::string> digests(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < digests.size(); ++i) {
    threads.emplace_back([&, i] {
      const auto source = seas->Open(albtpu::testing::WindSea(5.0 + static_cast<double>(i % 2)));
      if (source.ok()) digests[i] = (*source)->table().digest;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_NE(digests[0], digests[1]);
  for (std::size_t i = 2; i < digests.size(); ++i) EXPECT_EQ(digests[i], digests[i % 2]);
}

// As netCDF-4 writes them.
TEST(SeaSummary, TakesNumbersInListsOfOne) {
  albtpu::testing::TableParts parts = albtpu::testing::PartsOf(albtpu::testing::SyntheticSea());
  parts.provenance.attributes["x_azimuth"] = std::vector{30.0};
  EXPECT_EQ(SummaryOfSea(*UncertaintyTable::Create(kOneSea, parts.axes, parts.variables, parts.provenance))->x_azimuth,
            30);
}

TEST(SeaWire, KeepsEveryBit) {
  const SeaCompiler compiler;
  for (const KnownSea& sea : SeasOfAllForms()) {
    const auto read = server::ReadSea(ToWire(sea));
    EXPECT_EQ(CompileSea(compiler, *read).value().digest(), CompileSea(compiler, sea).value().digest());
    EXPECT_EQ(ToWire(*read).SerializeAsString(), ToWire(sea).SerializeAsString());
  }
}

}  // namespace
}  // namespace albtpu::client
