// The client queries the real server, in the same process.
#include "service/client/server_source.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>
#include <thread>

#include "service/client/local_source.h"
#include "tables/query/interpolation.h"
#include "tests/service/client/column_memory.h"
#include "tests/service/client/running_server.h"
#include "tests/tables/synthetic_table.h"

namespace albtpu::client {
namespace {

using albtpu::testing::SyntheticOptions;
using albtpu::testing::SyntheticTable;
using ::testing::HasSubstr;

// Pulses inside and outside the table; some depths are not a number.
PulseMemory MixedPulses(std::size_t count) {
  PulseMemory pulses =
      RandomPulses(count, {{{2.5f, 10.5f}, {900, 200000}, {-1, 27}, {-400, 400}, {0.2f, 2.1f}, {-1, 21}}});
  for (std::size_t i = 7; i < count; i += 50) pulses.axis(AxisId::kDepth)[i] = std::numeric_limits<float>::quiet_NaN();
  return pulses;
}

const Query kP95Of1b = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b};

TEST(ServerSource, GivesTheSameBitsAsATableInThisProcess) {
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

TEST(ServerSource, AnswersSeveralThreadsAtOnce) {
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

TEST(ServerSource, AnswersPulsesThatAreAllTheSame) {
  const RunningServer server;
  const auto source = OpenServer(server.address(), "quick").value();
  PulseMemory pulse;
  pulse.Add({5, 5000, 12, 30, 1, 3});
  PulseColumns pulses = pulse.columns();
  pulses.size = 65537;  // The second message has one pulse.
  AnswerMemory answers(pulses.size);
  ASSERT_TRUE(source->Answer({}, pulses, answers.columns()).ok());
  const float thu = Interpolate(SyntheticTable(), PulseAt(pulses, 0))[Quantity::kThu];
  for (const std::size_t i : {std::size_t{0}, std::size_t{65535}, std::size_t{65536}})
    EXPECT_FLOAT_EQ(answers.columns().values[Index(Quantity::kThu)][i], thu) << i;
}

TEST(ServerSource, SendsNothingWithoutPulses) {
  RunningServer server;
  const auto source = OpenServer(server.address(), "").value();
  server.Stop();
  EXPECT_TRUE(source->Answer({}, {}, {}).ok());
}

TEST(ServerSource, RejectsColumnsOfWrongLengthAsATableDoes) {
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

TEST(ServerSource, DescribesItsTableAsALocalSourceDoes) {
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

TEST(ServerSource, ReportsTheProblemWithTheServer) {
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

// A channel that nobody waits on looks for its server only every five seconds, which is longer than this source waits.
TEST(ServerSource, NoticesWhileWaitingThatItsServerIsBack) {
  auto server = std::make_unique<RunningServer>();
  const std::string address = server->address();
  const auto source = OpenServer(address, "", {.retries = 2, .first_pause = std::chrono::milliseconds(1500)}).value();
  server->Stop();
  server.reset();
  const PulseMemory pulses = MixedPulses(1000);
  AnswerMemory answers(pulses.size());
  absl::Status status;
  std::thread querier([&] { status = source->Answer({}, pulses.columns(), answers.columns()); });
  server = std::make_unique<RunningServer>(SyntheticOptions(), address);
  querier.join();
  EXPECT_TRUE(status.ok()) << status;
}

// Repeats a query until `enough` returns true or something fails; returns the number of correct answers.
int QueryUntil(UncertaintySource& source, const std::function<bool(int answered)>& enough) {
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

TEST(ServerSource, AlternatesBetweenTheServersOfAnAddress) {
  const RunningServer first, second;
  const auto source = OpenServer(AllOf({first.address(), second.address()}), "").value();
  QueryUntil(*source, [&](int) { return first.answers() > 0 && second.answers() > 0; });
  const int before = first.answers(), others_before = second.answers();
  QueryUntil(*source, [](int answered) { return answered == 10; });
  EXPECT_EQ(first.answers() - before, 5);
  EXPECT_EQ(second.answers() - others_before, 5);
}

TEST(ServerSource, UsesAServerAgainWhenItIsBack) {
  auto first = std::make_unique<RunningServer>();
  const RunningServer second;
  const std::string address = first->address();
  const auto source = OpenServer(AllOf({address, second.address()}), "").value();
  first->Stop();
  first.reset();
  QueryUntil(*source, [](int answered) { return answered == 2; });
  first = std::make_unique<RunningServer>(SyntheticOptions(), address);
  QueryUntil(*source, [&](int) { return first->answers() > 0; });
}

}  // namespace
}  // namespace albtpu::client
