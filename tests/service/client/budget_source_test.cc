// The whole budget: the client queries the real server, in the same process.
#include <gmock/gmock.h>

#include <cstring>

#include "sea/table/table_at_index.h"
#include "service/client/local_source.h"
#include "service/client/sea_sources.h"
#include "service/client/server_source.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/service/client/running_server.h"
#include "tests/service/known_seas.h"

namespace albtpu::client {
namespace {

using albtpu::testing::BudgetMemory;
using albtpu::testing::BudgetPulseMemory;
using albtpu::testing::SyntheticTable;
using albtpu::testing::UsualOptions;
using ::testing::HasSubstr;

// Whether both have the same bits. NaN is the same NaN everywhere.
void ExpectSame(const BudgetMemory& a, const BudgetMemory& b) {
  EXPECT_TRUE(a.outcomes == b.outcomes && a.outcome_axes == b.outcome_axes);
  EXPECT_TRUE(a.best_s44_orders == b.best_s44_orders);
  for (std::size_t i = 0; i < kBudgetColumnCount; ++i)
    EXPECT_EQ(std::memcmp(a.numbers[i].data(), b.numbers[i].data(), a.numbers[i].size() * sizeof(float)), 0) << i;
}

TEST(BudgetSource, GivesTheSameBitsOnAServerAndInThisProcess) {
  const RunningServer server;
  const auto remote = OpenServer(server.address(), "").value();
  LocalSource local("", SyntheticTable());
  BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(100000);  // More than four messages.
  pulses[BudgetInput::kAltitude][777] = -1;
  pulses.axes[Index(AxisId::kDepth)][99999] = 30;
  for (const Coverage coverage : {Coverage::kTwoSigma, Coverage::kOneSigma, Coverage::kP95}) {
    BudgetOptions options = UsualOptions();
    options.coverage = coverage;
    BudgetMemory from_server(pulses.size), from_table(pulses.size);
    const absl::Status status = remote->AnswerBudget(options, pulses.columns(), from_server.columns());
    ASSERT_TRUE(status.ok()) << status;
    ASSERT_TRUE(local.AnswerBudget(options, pulses.columns(), from_table.columns()).ok());
    ExpectSame(from_server, from_table);
    EXPECT_EQ(from_table.outcomes[777], 3);
    EXPECT_EQ(from_table.outcomes[99999], 2);
  }
}

TEST(BudgetSource, OfASeaTakesTheAxisOfTheSea) {
  const RunningServer server;
  BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(1000);
  pulses.axes[Index(AxisId::kWindSpeed)].clear();
  for (const KnownSea& sea : albtpu::testing::SeasOfAllForms()) {
    const auto remote = ServerSeas(server.address()).value()->Open(sea).value();
    const auto local = LocalSeas()->Open(sea).value();
    BudgetMemory from_server(pulses.size), from_table(pulses.size);
    ASSERT_TRUE(remote->AnswerBudget(UsualOptions(), pulses.columns(), from_server.columns()).ok());
    ASSERT_TRUE(local->AnswerBudget(UsualOptions(), pulses.columns(), from_table.columns()).ok());
    ExpectSame(from_server, from_table);
  }
}

// Of a table that is scaled, and of a sea that is computed anew; also when the table in that water is asked again.
TEST(BudgetSource, AnswersForTheIndexOfItsWater) {
  const RunningServer server;
  BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(1000);
  BudgetOptions options = UsualOptions();
  BudgetMemory usual(pulses.size);
  ASSERT_TRUE(LocalSource("", SyntheticTable()).AnswerBudget(options, pulses.columns(), usual.columns()).ok());
  options.index = 1.36;
  LocalSource scaled("", SyntheticTable(), 1.36);
  const auto remote = OpenServer(server.address(), "", {}, {}, 1.36).value();
  const KnownSea sea = albtpu::testing::SeasOfAllForms().front();
  const auto local_sea = LocalSeas(1.36)->Open(sea).value(),
             remote_sea = ServerSeas(server.address(), {}, {}, 1.36).value()->Open(sea).value();
  for (const auto& [here, there] : {std::pair<UncertaintySource*, UncertaintySource*>(&scaled, remote.get()),
                                    {&scaled, remote.get()},
                                    {local_sea.get(), remote_sea.get()}}) {
    BudgetMemory from_server(pulses.size), from_table(pulses.size);
    const absl::Status status = there->AnswerBudget(options, pulses.columns(), from_server.columns());
    ASSERT_TRUE(status.ok()) << status;
    ASSERT_TRUE(here->AnswerBudget(options, pulses.columns(), from_table.columns()).ok());
    ExpectSame(from_server, from_table);
    for (std::size_t i = 0; here == &scaled && i < pulses.size; ++i)
      EXPECT_GT(from_table.at(BudgetQuantity::kThuSea, i), usual.at(BudgetQuantity::kThuSea, i));
  }
  const absl::Status other = remote->AnswerBudget(UsualOptions(), pulses.columns(), usual.columns());
  EXPECT_TRUE(absl::IsInvalidArgument(other));
  EXPECT_THAT(other.message(), HasSubstr("1.36 in the source of the sea's share"));
}

// The table's own index gives its own numbers; one query after another may have other water.
TEST(BudgetSource, OfATableAtItsOwnIndexHasItsNumbers) {
  const RunningServer server;
  const BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(500);
  const ColumnInterpolator table(SyntheticTable());
  std::vector<float> own(pulses.size), answered(pulses.size);
  AnswerColumns columns;
  columns.values[Index(Quantity::kThu)] = own.data();
  InterpolateOnAllCores(table, {}, pulses.columns().pulses, columns);
  columns.values[Index(Quantity::kThu)] = answered.data();
  for (const double index : {1.34, 1.35, 1.34}) {
    const auto remote = OpenServer(server.address(), "", {}, {}, index).value();
    ASSERT_TRUE(remote->Answer({}, pulses.columns().pulses, columns).ok());
    EXPECT_EQ(answered == own, index == IndexOfTable(SyntheticTable()));
  }
}

TEST(BudgetSource, RefusesTheSameOptionsOnAServerAndInThisProcess) {
  const RunningServer server;
  const auto remote = OpenServer(server.address(), "").value();
  LocalSource local("", SyntheticTable());
  const BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(10);
  BudgetMemory answers(pulses.size);
  BudgetOptions options = UsualOptions();
  options.index = 3;
  for (UncertaintySource* const source : {remote.get(), static_cast<UncertaintySource*>(&local)}) {
    const absl::Status status = source->AnswerBudget(options, pulses.columns(), answers.columns());
    EXPECT_TRUE(absl::IsInvalidArgument(status));
    EXPECT_THAT(status.message(), HasSubstr("refractive_index is 3"));
  }
}

TEST(BudgetSource, ReportsAServerThatStops) {
  RunningServer server;
  const auto source = OpenServer(server.address(), "", {.retries = 0}).value();
  const BudgetPulseMemory pulses = albtpu::testing::RandomBudgetPulses(200000);
  BudgetMemory answers(pulses.size);
  server.Stop();
  const absl::Status status = source->AnswerBudget(UsualOptions(), pulses.columns(), answers.columns());
  EXPECT_TRUE(absl::IsUnavailable(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr("0 of 200000 pulses"));
}

}  // namespace
}  // namespace albtpu::client
