// The client against the real server, in one process.
#include "service/client/server_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "service/client/local_source.h"
#include "tests/service/client/column_memory.h"
#include "tests/service/client/running_server.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::client {
namespace {

using albtpu::testing::SyntheticOptions;
using albtpu::testing::SyntheticTable;
using ::testing::HasSubstr;

// Pulses within and without the table, now and then not a number.
PulseMemory MixedPulses(std::size_t count) {
  std::mt19937 random(1);
  const auto draw = [&](float from, float to) {
    return from + (to - from) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24);
  };
  PulseMemory pulses;
  for (std::size_t i = 0; i < count; ++i) {
    const float depth = random() % 50 == 0 ? std::numeric_limits<float>::quiet_NaN() : draw(-1, 21);
    pulses.Add(
        {draw(2.5f, 10.5f), draw(900, 200000), draw(-1, 27), draw(-400, 400), draw(0.2f, 2.1f), depth});
  }
  return pulses;
}

const Query kP95Of1b = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b};

TEST(ServerSource, GivesTheBitsThatATableInThisProcessGives) {
  const RunningServer server;
  const auto remote = OpenServer(server.address(), "").value();
  LocalSource local("", SyntheticTable());
  PulseMemory pulses = MixedPulses(150000);  // More than one message.
  for (const bool with_azimuth : {true, false}) {
    if (!with_azimuth) pulses.axis(AxisId::kAzimuth).clear();
    AnswerMemory from_server(pulses.size()), from_table(pulses.size());
    ASSERT_TRUE(remote->Answer(kP95Of1b, pulses.columns(), from_server.columns()).ok());
    ASSERT_TRUE(local.Answer(kP95Of1b, pulses.columns(), from_table.columns()).ok());
    EXPECT_TRUE(from_server == from_table);
  }
}

TEST(ServerSource, AnswersManyThreadsAtATime) {
  const RunningServer server;
  const auto source = OpenServer(server.address(), "").value();
  const PulseMemory pulses = MixedPulses(70000);
  AnswerMemory expected(pulses.size());
  ASSERT_TRUE(LocalSource("", SyntheticTable()).Answer({}, pulses.columns(), expected.columns()).ok());
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      AnswerMemory answers(pulses.size());
      EXPECT_TRUE(source->Answer({}, pulses.columns(), answers.columns()).ok());
      EXPECT_TRUE(answers == expected);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST(ServerSource, AsksForTheColumnsThatAreWantedAlone) {
  const RunningServer server;
  const auto source = OpenServer(server.address(), "").value();
  const PulseMemory pulses = MixedPulses(1000);
  AnswerMemory all(pulses.size()), some(pulses.size());
  ASSERT_TRUE(source->Answer({}, pulses.columns(), all.columns()).ok());
  AnswerColumns wanted;
  wanted.values[Index(Quantity::kTvu)] = some.columns().values[Index(Quantity::kTvu)];
  ASSERT_TRUE(source->Answer({}, pulses.columns(), wanted).ok());
  EXPECT_EQ(std::memcmp(all.columns().values[Index(Quantity::kTvu)],
                        some.columns().values[Index(Quantity::kTvu)], pulses.size() * sizeof(float)),
            0);
  EXPECT_TRUE(source->Answer({}, pulses.columns(), AnswerColumns()).ok());
}

TEST(ServerSource, TakesPulsesThatAreAllAlike) {
  const RunningServer server;
  const auto source = OpenServer(server.address(), "quick").value();
  PulseMemory pulse;
  pulse.Add({5, 5000, 12, 30, 1, 3});
  PulseColumns pulses = pulse.columns();
  pulses.size = 65537;  // The second message has one pulse.
  AnswerMemory answers(pulses.size);
  ASSERT_TRUE(source->Answer({}, pulses, answers.columns()).ok());
  const float thu = Interpolate(SyntheticTable(), PulseAt(pulses, 0))[Quantity::kThu];
  for (const std::size_t i : {std::size_t{0}, std::size_t{65535}, std::size_t{65536}}) {
    EXPECT_FLOAT_EQ(answers.columns().values[Index(Quantity::kThu)][i], thu) << i;
  }
}

TEST(ServerSource, AsksNothingForNoPulses) {
  RunningServer server;
  const auto source = OpenServer(server.address(), "").value();
  server.Stop();
  EXPECT_TRUE(source->Answer({}, {}, {}).ok());
}

TEST(ServerSource, RefusesColumnsOfOtherLengthsAsATableDoes) {
  RunningServer server;
  const auto remote = OpenServer(server.address(), "").value();
  server.Stop();
  PulseMemory memory = MixedPulses(3);
  memory.axis(AxisId::kDepth).pop_back();
  const PulseColumns pulses = memory.columns();
  const absl::Status status = remote->Answer({}, pulses, {});
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_EQ(LocalSource("", SyntheticTable()).Answer({}, pulses, {}), status);
}

TEST(ServerSource, KnowsItsTableAsAFileDoes) {
  const RunningServer server;
  const TableSummary remote = OpenServer(server.address(), "").value()->table();
  const TableSummary local = Summarize("quick", SyntheticTable());
  EXPECT_EQ(remote.name, local.name);
  EXPECT_EQ(remote.id, local.id);
  EXPECT_EQ(remote.version, local.version);
  EXPECT_EQ(remote.title, local.title);
  EXPECT_EQ(remote.digest, local.digest);
  EXPECT_EQ(remote.attributes, local.attributes);
  for (const AxisId axis : kAxes) {
    EXPECT_EQ(remote.axes[Index(axis)].first, local.axes[Index(axis)].first);
    EXPECT_EQ(remote.axes[Index(axis)].last, local.axes[Index(axis)].last);
    EXPECT_EQ(remote.axes[Index(axis)].nodes, local.axes[Index(axis)].nodes);
  }
  const std::vector<TableSummary> listed = ListServerTables(server.address()).value();
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_TRUE(listed[0].is_default);
}

TEST(ServerSource, SaysWhatIsWrongWithTheServer) {
  RunningServer server;
  const absl::Status unknown = OpenServer(server.address(), "no").status();
  EXPECT_EQ(unknown.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(unknown.message()), HasSubstr("'no'"));
  EXPECT_THAT(std::string(unknown.message()), HasSubstr("quick"));
  const std::string address = server.address();
  server.Stop();
  const absl::Status gone = OpenServer(address, "").status();
  EXPECT_EQ(gone.code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(gone.message()), HasSubstr("start albtpu-serve"));
}

TEST(ServerSource, GoesOnWhenItsServerComesBack) {
  auto server = std::make_unique<RunningServer>();
  const std::string address = server->address();
  const auto source = OpenServer(address, "").value();
  server->Stop();
  server.reset();
  const PulseMemory pulses = MixedPulses(1000);
  AnswerMemory answers(pulses.size()), expected(pulses.size());
  absl::Status status;
  std::thread asker([&] { status = source->Answer({}, pulses.columns(), answers.columns()); });
  server = std::make_unique<RunningServer>(SyntheticOptions(), address);
  asker.join();
  EXPECT_TRUE(status.ok()) << status;
  ASSERT_TRUE(LocalSource("", SyntheticTable()).Answer({}, pulses.columns(), expected.columns()).ok());
  EXPECT_TRUE(answers == expected);
}

// A channel that nobody polls looks for its server every five seconds alone: later than this one waits.
TEST(ServerSource, SeesWhileItWaitsThatItsServerIsBack) {
  auto server = std::make_unique<RunningServer>();
  const std::string address = server->address();
  const auto source =
      OpenServer(address, "", {.retries = 2, .first_pause = std::chrono::milliseconds(1500)}).value();
  server->Stop();
  server.reset();
  const PulseMemory pulses = MixedPulses(1000);
  AnswerMemory answers(pulses.size());
  absl::Status status;
  std::thread asker([&] { status = source->Answer({}, pulses.columns(), answers.columns()); });
  server = std::make_unique<RunningServer>(SyntheticOptions(), address);
  asker.join();
  EXPECT_TRUE(status.ok()) << status;
}

// Asks message after message until `enough` says so or something fails; returns how many were answered rightly.
int AskUntil(UncertaintySource& source, const std::function<bool(int answered)>& enough) {
  const PulseMemory pulses = MixedPulses(1000);
  AnswerMemory answers(pulses.size()), expected(pulses.size());
  EXPECT_TRUE(LocalSource("", SyntheticTable()).Answer({}, pulses.columns(), expected.columns()).ok());
  for (int answered = 0;; ++answered) {
    if (enough(answered)) return answered;
    answers = AnswerMemory(pulses.size());
    const absl::Status status = source.Answer({}, pulses.columns(), answers.columns());
    EXPECT_TRUE(status.ok()) << status;
    EXPECT_TRUE(answers == expected);
    if (::testing::Test::HasFailure()) return answered;
  }
}

TEST(ServerSource, TakesTurnsWithTheServersOfAnAddress) {
  const RunningServer first, second;
  const auto source = OpenServer(AllOf({first.address(), second.address()}), "").value();
  AskUntil(*source, [&](int) { return first.answers() > 0 && second.answers() > 0; });
  const int before = first.answers(), others_before = second.answers();
  AskUntil(*source, [](int answered) { return answered == 10; });
  EXPECT_EQ(first.answers() - before, 5);
  EXPECT_EQ(second.answers() - others_before, 5);
}

TEST(ServerSource, AsksTheOtherServersWhenOneGoes) {
  RunningServer first, second;
  const auto source = OpenServer(AllOf({first.address(), second.address()}), "").value();
  AskUntil(*source, [&](int) { return first.answers() > 0 && second.answers() > 0; });
  first.Stop();
  const int before = second.answers();
  AskUntil(*source, [](int answered) { return answered == 10; });
  EXPECT_EQ(second.answers() - before, 10);
}

TEST(ServerSource, AsksAServerAgainThatIsBack) {
  auto first = std::make_unique<RunningServer>();
  const RunningServer second;
  const std::string address = first->address();
  const auto source = OpenServer(AllOf({address, second.address()}), "").value();
  first->Stop();
  first.reset();
  AskUntil(*source, [](int answered) { return answered == 2; });
  first = std::make_unique<RunningServer>(SyntheticOptions(), address);
  AskUntil(*source, [&](int) { return first->answers() > 0; });
}

TEST(ServerSource, NoticesThatItsTableBecameAnother) {
  auto first = std::make_unique<RunningServer>();
  const std::string address = first->address();
  const auto source = OpenServer(address, "").value();
  first->Stop();
  first.reset();
  const RunningServer second({.factor = 2}, address);
  const PulseMemory pulses = MixedPulses(1);
  AnswerMemory answers(1);
  const absl::Status status = source->Answer({}, pulses.columns(), answers.columns());
  EXPECT_EQ(status.code(), absl::StatusCode::kAborted) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("table quick changed from digest"));
}

TEST(ServerSource, GivesUpAServerThatStaysAway) {
  RunningServer server;
  const auto source =
      OpenServer(server.address(), "", {.retries = 2, .first_pause = std::chrono::milliseconds(1)}).value();
  server.Stop();
  const PulseMemory pulses = MixedPulses(10);
  AnswerMemory answers(pulses.size());
  const absl::Status status = source->Answer({}, pulses.columns(), answers.columns());
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("asked again 2 times, after 0 of 10 pulses"));
  EXPECT_THAT(std::string(status.message()), HasSubstr("start albtpu-serve"));
}

}  // namespace
}  // namespace albtpu::client
