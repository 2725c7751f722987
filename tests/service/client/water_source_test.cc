// Waters that a server compiles: the client queries the real server, in the same process.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "albtpu/v1/uncertainty_service.grpc.pb.h"
#include "budget/water/water_columns.h"
#include "service/client/local_source.h"
#include "service/client/sea_sources.h"
#include "service/client/server_source.h"
#include "tests/budget/query/budget_memory.h"
#include "tests/budget/water/known_waters.h"
#include "tests/every_case.h"
#include "tests/service/client/running_server.h"
#include "tests/service/known_seas.h"
#include "tests/tables/water/shipped_water.h"

namespace albtpu::client {
namespace {

using albtpu::testing::BudgetMemory;
using albtpu::testing::BudgetPulseMemory;
using albtpu::testing::CoastalWater;
using albtpu::testing::RandomBudgetPulses;
using albtpu::testing::ShippedWaterTable;
using albtpu::testing::SyntheticTable;
using albtpu::testing::UsualOptions;
using ::testing::HasSubstr;

// Fills the columns of the water in this process, as a client without such a server does.
WaterBatch GiveColumns(const CompiledWater& compiled, BudgetOptions& options, BudgetPulseMemory& pulses) {
  WaterBatch batch;
  ComputeWater(compiled, options.index,
               {.size = pulses.size,
                .incidence = pulses.axes[Index(AxisId::kIncidence)],
                .depth = pulses.axes[Index(AxisId::kDepth)],
                .footprint = pulses.axes[Index(AxisId::kFootprint)]},
               batch);
  pulses[BudgetInput::kWaterSigmaAlong] = batch.sigma_along;
  pulses[BudgetInput::kWaterSigmaVertical] = batch.sigma_vertical;
  pulses[BudgetInput::kWaterCorrelation] = batch.correlation;
  pulses[BudgetInput::kWaterNoise] = batch.noise;
  pulses[BudgetInput::kWaterBiasAlong] = batch.bias_along;
  pulses[BudgetInput::kWaterBiasVertical] = batch.bias_vertical;
  if (compiled.surface.has_value()) AddGreenSpread(*compiled.surface, options.located, options.errors);
  return batch;
}

CompiledWater Compiled(const KnownWater& water) { return CompileWater(ShippedWaterTable().get(), water).value(); }

// Whether all numbers have the same bits, and outcomes differ by nothing but the name of what is beyond the water.
void ExpectSame(const BudgetMemory& in_words, const BudgetMemory& in_columns, const WaterBatch& batch) {
  for (std::size_t i = 0; i < kBudgetColumnCount; ++i) {
    const std::vector<float>&a = in_words.numbers[i], &b = in_columns.numbers[i];
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0) << i;
  }
  EXPECT_EQ(in_words.best_s44_orders, in_columns.best_s44_orders);
  for (std::size_t i = 0; i < in_words.outcomes.size(); ++i) {
    if (in_columns.outcomes[i] == 3 && in_columns.outcome_axes[i] == 0 && batch.is_beyond(i)) {
      EXPECT_EQ(in_words.outcomes[i], 2);
      EXPECT_GT(in_words.outcome_axes[i], 0);
    } else {
      EXPECT_EQ(in_words.outcomes[i], in_columns.outcomes[i]);
      EXPECT_EQ(in_words.outcome_axes[i], in_columns.outcome_axes[i]);
    }
  }
}

TEST(WaterSource, GivesTheBitsOfTheColumnsThatAClientComputes) {
  const RunningServer server({}, "127.0.0.1:0", SHIPPED_WATER_TABLE);
  const auto remote = OpenServer(server.address(), "").value();
  LocalSource local("", SyntheticTable());
  std::size_t beyond = 0, answered = 0;
  // Each water is compiled twice, for half a second. WaterRequest's tests send all kinds, too.
  const std::vector<KnownWater> waters = albtpu::testing::WatersOfAllKinds();
  const std::size_t step = albtpu::testing::EveryCase() ? 1 : 5;
  for (std::size_t k = 0; k < waters.size(); k += step) {
    const KnownWater& water = waters[k];
    const CompiledWater compiled = Compiled(water);
    for (const SurfaceLocation located : {SurfaceLocation::kPulse, SurfaceLocation::kLocal}) {
      BudgetPulseMemory pulses = RandomBudgetPulses(500);
      pulses[BudgetInput::kAltitude][77] = -1;
      pulses.axes[Index(AxisId::kDepth)][99] = 30;
      BudgetOptions options = UsualOptions();
      options.located = located;
      BudgetMemory in_words(pulses.size), in_columns(pulses.size), here(pulses.size);
      WaterSummary summary;
      const absl::Status status =
          remote->AnswerBudgetInWater(options, water, pulses.columns(), in_words.columns(), &summary);
      ASSERT_TRUE(status.ok()) << status;
      const WaterBatch batch = GiveColumns(compiled, options, pulses);
      ASSERT_TRUE(remote->AnswerBudget(options, pulses.columns(), in_columns.columns()).ok());
      ASSERT_TRUE(local.AnswerBudget(options, pulses.columns(), here.columns()).ok());
      ExpectSame(in_words, in_columns, batch);
      ExpectSame(in_words, here, batch);
      EXPECT_EQ(in_words.outcomes[77], water.bias.has_value() && batch.is_beyond(77) ? 2 : 3);
      for (std::size_t i = 0; i < pulses.size; ++i) {
        beyond += in_words.outcomes[i] == 2;
        answered += in_words.outcomes[i] == 1;
      }
      EXPECT_EQ(summary.table_digest, water.bias.has_value() ? ShippedWaterTable()->table().digest() : "");
    }
  }
  EXPECT_GT(answered, 3000u);  // The comparison is of numbers, and of pulses beyond.
  EXPECT_GT(beyond, 100u);
}

TEST(WaterSource, TakesASeaAndAWaterTogether) {
  const RunningServer server({}, "127.0.0.1:0", SHIPPED_WATER_TABLE);
  BudgetPulseMemory pulses = RandomBudgetPulses(300);
  const KnownSea sea = albtpu::testing::DescribedWaves();
  const auto remote = ServerSeas(server.address()).value()->Open(sea).value();
  const auto local = LocalSeas()->Open(sea).value();
  BudgetOptions options = UsualOptions();
  BudgetMemory in_words(pulses.size), in_columns(pulses.size);
  const absl::Status status =
      remote->AnswerBudgetInWater(options, CoastalWater(), pulses.columns(), in_words.columns());
  ASSERT_TRUE(status.ok()) << status;
  const WaterBatch batch = GiveColumns(Compiled(CoastalWater()), options, pulses);
  ASSERT_TRUE(local->AnswerBudget(options, pulses.columns(), in_columns.columns()).ok());
  ExpectSame(in_words, in_columns, batch);
}

TEST(WaterSource, SaysWhatWasAssumed) {
  const RunningServer server({}, "127.0.0.1:0", SHIPPED_WATER_TABLE);
  const auto remote = OpenServer(server.address(), "").value();
  const BudgetPulseMemory pulses = RandomBudgetPulses(3);
  BudgetMemory answers(pulses.size);
  WaterSummary summary;
  const KnownWater water = CoastalWater({.secchi = 5});
  ASSERT_TRUE(remote->AnswerBudgetInWater(UsualOptions(), water, pulses.columns(), answers.columns(), &summary).ok());
  EXPECT_NEAR(summary.attenuation, 0.85 * 0.94 / 5, 1e-9);
  EXPECT_THAT(summary.derivation, HasSubstr("Secchi depth Z = 5 m; Kd = 0.94 / Z"));
  const CompiledWater compiled = CompileWater(ShippedWaterTable().get(), water).value();
  EXPECT_EQ(summary.greatest_depth, compiled.share->greatest_depth());
  std::vector<std::string> assumptions = AssumptionsOf(water, compiled);
  assumptions.emplace_back("The returns that located the surface lie on it, as those of an infrared laser.");
  EXPECT_EQ(summary.assumptions, assumptions);
  EXPECT_EQ(summary.assumptions.size(), 8u);
}

TEST(WaterSource, RefusesWhatTheServerCannotCompile) {
  const RunningServer with({}, "127.0.0.1:0", SHIPPED_WATER_TABLE);
  const RunningServer without;
  const BudgetPulseMemory pulses = RandomBudgetPulses(3);
  BudgetMemory answers(pulses.size);
  const auto status_of = [&](const RunningServer& server, const KnownWater& water) {
    return OpenServer(server.address(), "")
        .value()
        ->AnswerBudgetInWater(UsualOptions(), water, pulses.columns(), answers.columns());
  };
  const absl::Status no_table = status_of(without, CoastalWater());
  EXPECT_TRUE(absl::IsFailedPrecondition(no_table)) << no_table;
  EXPECT_THAT(no_table.message(), HasSubstr("no table of the water column"));
  const absl::Status clear = status_of(with, CoastalWater({.secchi = 60}));
  EXPECT_TRUE(absl::IsInvalidArgument(clear)) << clear;
  EXPECT_THAT(clear.message(), HasSubstr("clearer than pure water"));
  const absl::Status of_photons = status_of(without, {.photons = 100});
  EXPECT_TRUE(absl::IsInvalidArgument(of_photons)) << of_photons;
  EXPECT_THAT(of_photons.message(), HasSubstr("photons have no effect without a bias treatment"));
  const absl::Status local =
      LocalSource("", SyntheticTable())
          .AnswerBudgetInWater(UsualOptions(), CoastalWater(), pulses.columns(), answers.columns());
  EXPECT_TRUE(absl::IsUnimplemented(local));
}

// A server that knows no waters, as those of version 0.1: it answers as if there were none.
class EarlierServer final : public albtpu::v1::UncertaintyService::Service {
  grpc::Status GetTable(grpc::ServerContext* /*context*/, const albtpu::v1::GetTableRequest* /*request*/,
                        albtpu::v1::GetTableResponse* /*response*/) override {
    return grpc::Status::OK;
  }
  grpc::Status QueryBudget(grpc::ServerContext* /*context*/, const albtpu::v1::QueryBudgetRequest* /*request*/,
                           albtpu::v1::QueryBudgetResponse* response) override {
    response->set_coverage(albtpu::v1::COVERAGE_P95);
    return grpc::Status::OK;
  }
};

TEST(WaterSource, TakesNoTotalsWithoutTheWaterFromAServerOfAnEarlierVersion) {
  EarlierServer service;
  int port = 0;
  const std::unique_ptr<grpc::Server> server =
      grpc::ServerBuilder()
          .AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port)
          .RegisterService(&service)
          .BuildAndStart();
  const auto remote = OpenServer(absl::StrCat("127.0.0.1:", port), "").value();
  const BudgetPulseMemory pulses = RandomBudgetPulses(3);
  BudgetMemory answers(pulses.size);
  const absl::Status status =
      remote->AnswerBudgetInWater(UsualOptions(), CoastalWater(), pulses.columns(), answers.columns());
  EXPECT_TRUE(absl::IsFailedPrecondition(status)) << status;
  EXPECT_THAT(status.message(), HasSubstr("of an earlier version"));
}

}  // namespace
}  // namespace albtpu::client
