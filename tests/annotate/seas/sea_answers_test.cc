#include "annotate/seas/sea_answers.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "sea/table/sea_attributes.h"
#include "sea/table/sea_table.h"
#include "tables/query/interpolation.h"
#include "tests/annotate/seas/sea_series_text.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::kHour;
using albtpu::testing::kStart;

// Counts how often seas are opened.
class CountedSeas : public client::SeaSources {
 public:
  CountedSeas(std::atomic<int>& opened, absl::Status status) : opened_(opened), status_(std::move(status)) {}
  absl::StatusOr<std::unique_ptr<client::UncertaintySource>> Open(const KnownSea& sea) override {
    ++opened_;
    if (!status_.ok()) return status_;
    return local_->Open(sea);
  }

 private:
  std::unique_ptr<client::SeaSources> local_ = client::LocalSeas();
  std::atomic<int>& opened_;
  absl::Status status_;
};

thread_local bool opens_sea = false;

// Opens seas by tasks on all cores, as tables are put together.
class SeasOfTasks : public client::SeaSources {
 public:
  absl::StatusOr<std::unique_ptr<client::UncertaintySource>> Open(const KnownSea& sea) override {
    opens_sea = true;
    tbb::parallel_for(0, 200, [](int) { std::this_thread::sleep_for(std::chrono::microseconds(100)); });
    opens_sea = false;
    return local_->Open(sea);
  }

 private:
  std::unique_ptr<client::SeaSources> local_ = client::LocalSeas();
};

class SeaAnswersTest : public ::testing::Test {
 protected:
  // Hourly seas whose height and direction change.
  std::shared_ptr<const SeaTimeline> Hourly(int count) {
    std::vector<testing::SeaAtTime> seas;
    for (int i = 0; i < count; ++i)
      seas.push_back({kStart + i * kHour, 0.4 + 0.5 * (i % 3), 200.0 + 25 * i, 0.3 + 0.05 * (i % 4)});
    config::SeaSettings settings;
    settings.file = folder_.Write("sea.csv", testing::SeaCsv(seas)).string();
    settings.wind_speed = 6;
    return std::make_shared<const SeaTimeline>(SeaTimeline::Open(settings).value());
  }

  static PulseBatch RandomPulses(std::size_t count, double hours) {
    std::mt19937_64 random(7);
    const auto number = [&](double least, double greatest) {
      return std::uniform_real_distribution<double>(least, greatest)(random);
    };
    PulseBatch pulses{.size = count, .axis = {}, .azimuths_from_north = true};
    for (std::size_t i = 0; i < count; ++i) {
      pulses[AxisId::kIncidence].push_back(static_cast<float>(number(0, 25)));
      pulses[AxisId::kAzimuth].push_back(static_cast<float>(number(0, 360)));
      pulses[AxisId::kFootprint].push_back(static_cast<float>(number(0.2, 4)));
      pulses[AxisId::kDepth].push_back(static_cast<float>(number(0, 40)));
      pulses.times.push_back(kStart + number(0, hours) * kHour);
    }
    return pulses;
  }

  static AnswerSelection Everything() {
    AnswerSelection all{.quantities = {}, .standard_errors = true, .best_s44_orders = true, .s44_remaining = true};
    all.quantities.fill(true);
    return all;
  }

  std::unique_ptr<SeaAnswers> Open(std::shared_ptr<const SeaTimeline> seas) {
    return SeaAnswers::Open(std::move(seas), client::LocalSeas()).value();
  }

  static AnswerBatch Ask(SeaAnswers& seas, const PulseBatch& pulses, Query query = {}) {
    AnswerBatch answers;
    const absl::Status status = AnswerPulses(seas.source(), query, pulses, Everything(), answers);
    EXPECT_TRUE(status.ok()) << status;
    return answers;
  }

  albtpu::testing::TemporaryFolder folder_;
};

// The pulse `i` over the table of a sea, by the slow interpolation.
PulseUncertainty Slowly(const UncertaintyTable& table, const PulseBatch& pulses, std::size_t i) {
  const double x_azimuth = SummaryOfSea(table)->x_azimuth;
  return Interpolate(table,
                     {.incidence = pulses.coordinate(AxisId::kIncidence, i),
                      .azimuth = static_cast<float>(BeamAzimuth(pulses.coordinate(AxisId::kAzimuth, i), x_azimuth)),
                      .footprint = pulses.coordinate(AxisId::kFootprint, i),
                      .depth = pulses.coordinate(AxisId::kDepth, i)});
}

// Each pulse by itself: two tables, the slow interpolation, the mean of the squares.
TEST_F(SeaAnswersTest, AreTheMeansOfSquaresOfTheTwoSeas) {
  const std::shared_ptr<const SeaTimeline> seas = Hourly(5);
  const std::unique_ptr<SeaAnswers> fast = Open(seas);
  const PulseBatch pulses = RandomPulses(3000, 4);
  const SeaCompiler compiler;
  std::vector<UncertaintyTable> tables;
  for (std::size_t i = 0; i < seas->size(); ++i) tables.push_back(CompileSea(compiler, seas->sea(i)).value());
  for (const Coverage coverage : {Coverage::kTwoSigma, Coverage::kP95}) {
    const AnswerBatch answers = Ask(*fast, pulses, {.coverage = coverage, .s44_order = S44Order::k1a});
    for (std::size_t i = 0; i < pulses.size; ++i) {
      const double hours = (pulses.times[i] - kStart) / kHour;
      const auto record = static_cast<std::size_t>(hours);
      const double weight = hours - static_cast<double>(record);
      const PulseUncertainty a = Slowly(tables[record], pulses, i), b = Slowly(tables[record + 1], pulses, i);
      const PulseUncertainty at[] = {WithCoverage(a, coverage), WithCoverage(b, coverage)};
      ASSERT_TRUE(answers.interpolated(i));
      for (const Quantity quantity : kQuantities) {
        const double first = at[0][quantity], second = at[1][quantity];
        const double expected = Describe(quantity).is_bias
                                    ? (1 - weight) * first + weight * second
                                    : std::sqrt((1 - weight) * first * first + weight * second * second);
        // Biases cancel between nodes: an error of 4e-7 of the largest corner, some ten times the bias.
        const double tolerance = Describe(quantity).is_bias ? 1e-4 : 2e-5;
        EXPECT_NEAR(answers[quantity][i], expected, tolerance * std::abs(expected) + 1e-7)
            << Describe(quantity).name << " " << i;
      }
      const auto p95 = [&](Quantity quantity) {
        const double first = WithCoverage(a, Coverage::kP95)[quantity],
                     second = WithCoverage(b, Coverage::kP95)[quantity];
        return std::sqrt((1 - weight) * first * first + weight * second * second);
      };
      const double limit = ThuLimit(S44Order::k1a, pulses.coordinate(AxisId::kDepth, i));
      EXPECT_NEAR(answers.remaining_thu[i], RemainingBudget(limit, p95(Quantity::kThu)).value_or(NAN), 1e-4);
      EXPECT_GT(answers.best_s44_orders[i], 0);
    }
  }
}

TEST_F(SeaAnswersTest, OfAPulseDoNotDependOnItsNeighbours) {
  const std::unique_ptr<SeaAnswers> seas = Open(Hourly(5));
  const PulseBatch pulses = RandomPulses(300, 4);
  const AnswerBatch together = Ask(*seas, pulses);
  for (std::size_t i = 0; i < pulses.size; ++i) {
    PulseBatch one{.size = 1, .axis = {}, .times = {pulses.times[i]}, .azimuths_from_north = true};
    for (const AxisId axis : {AxisId::kIncidence, AxisId::kAzimuth, AxisId::kFootprint, AxisId::kDepth})
      one[axis] = {pulses.coordinate(axis, i)};
    const AnswerBatch alone = Ask(*seas, one);
    for (const Quantity quantity : kQuantities) EXPECT_EQ(alone[quantity][0], together[quantity][i]);
    EXPECT_EQ(alone.best_s44_orders[0], together.best_s44_orders[i]);
  }
}

TEST_F(SeaAnswersTest, AreTheSameFromManyThreadsWithFewSeasOpen) {
  const std::shared_ptr<const SeaTimeline> timeline = Hourly(7);
  const PulseBatch pulses = RandomPulses(2000, 6);
  const std::unique_ptr<SeaAnswers> seas = Open(timeline);
  const AnswerBatch expected = Ask(*seas, pulses);
  std::vector<AnswerBatch> answers(4);
  std::vector<std::thread> threads;
  for (AnswerBatch& each : answers) threads.emplace_back([&] { each = Ask(*seas, pulses); });
  for (std::thread& thread : threads) thread.join();
  for (const AnswerBatch& each : answers) EXPECT_EQ(each.values, expected.values);
}

TEST_F(SeaAnswersTest, AtARecordAreThoseOfItsTable) {
  const std::shared_ptr<const SeaTimeline> timeline = Hourly(3);
  const std::unique_ptr<SeaAnswers> seas = Open(timeline);
  PulseBatch pulses = RandomPulses(100, 2);
  pulses.times.assign(pulses.size, kStart + kHour);
  const AnswerBatch answers = Ask(*seas, pulses);
  const UncertaintyTable table = CompileSea(SeaCompiler(), timeline->sea(1)).value();
  for (std::size_t i = 0; i < pulses.size; ++i) {
    const double thu = Slowly(table, pulses, i)[Quantity::kThu];
    EXPECT_NEAR(answers[Quantity::kThu][i], thu, 1e-5 * thu);
  }
}

// The same instant for all, and by the time of each.
TEST_F(SeaAnswersTest, AtAnInstantThatIsToldAreThoseOfTheSeries) {
  const std::shared_ptr<const SeaTimeline> timeline = Hourly(3);
  config::SeaSettings settings = timeline->settings();
  settings.time = "2020-06-08T05:15Z";
  const auto instant = std::make_shared<const SeaTimeline>(SeaTimeline::Open(settings).value());
  PulseBatch pulses = RandomPulses(100, 2);
  const AnswerBatch fixed = Ask(*Open(instant), pulses);
  pulses.times.assign(pulses.size, kStart + 1.25 * kHour);
  EXPECT_EQ(Ask(*Open(timeline), pulses).values, fixed.values);
}

TEST_F(SeaAnswersTest, OpenEachSeaOnceAndKeepTheLast) {
  const std::shared_ptr<const SeaTimeline> timeline = Hourly(6);
  std::atomic<int> opened = 0;
  OpenSeas seas(*timeline, std::make_unique<CountedSeas>(opened, absl::OkStatus()), 3);
  for (int repeat = 0; repeat < 3; ++repeat)
    for (const std::size_t i : {0, 1, 2}) ASSERT_TRUE(seas.Get(i).ok());
  EXPECT_EQ(opened, 3);
  ASSERT_TRUE(seas.Get(0).ok() && seas.Get(3).ok());  // 1 was used longest ago.
  EXPECT_EQ(opened, 4);
  ASSERT_TRUE(seas.Get(0).ok() && seas.Get(2).ok() && seas.Get(3).ok());
  EXPECT_EQ(opened, 4);
  ASSERT_TRUE(seas.Get(1).ok());
  EXPECT_EQ(opened, 5);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([&] { EXPECT_TRUE(seas.Get(5).ok()); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(opened, 6);
}

// It would wait for itself.
TEST_F(SeaAnswersTest, AreNotAskedByAThreadThatOpensASea) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 4);
  const std::shared_ptr<const SeaTimeline> timeline = Hourly(2);
  for (int repeat = 0; repeat < 10; ++repeat) {
    OpenSeas seas(*timeline, std::make_unique<SeasOfTasks>());
    std::atomic<int> asked = 0;
    int left = 100;
    const auto next = [&](tbb::flow_control& flow) {
      if (left-- == 0) flow.stop();
      return left % 2;
    };
    const auto ask = [&](int record) {
      if (opens_sea)
        ++asked;
      else
        EXPECT_TRUE(seas.Get(static_cast<std::size_t>(record)).ok());
    };
    tbb::task_arena(4).execute([&] {
      tbb::parallel_pipeline(16, tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, next) &
                                     tbb::make_filter<int, void>(tbb::filter_mode::parallel, ask));
    });
    EXPECT_EQ(asked, 0);
  }
}

TEST_F(SeaAnswersTest, FailWhenNoSeaCanBeOpened) {
  std::atomic<int> opened = 0;
  const auto answers =
      SeaAnswers::Open(Hourly(2), std::make_unique<CountedSeas>(opened, absl::UnavailableError("the server is away")));
  EXPECT_EQ(answers.status().message(), "the server is away");
}

// THU at 95 % between two seas whose axes differ: never less than that of the mean covariance, and little more.
TEST(RadiusBetweenTwoSeas, IsThatOfTheWiderShape) {
  for (double ratio = 0.65; ratio <= 1; ratio += 0.05) {  // Of the smaller to the larger slope of a sea.
    const double larger = 1, smaller = ratio * ratio;     // Variances.
    for (double weight = 0; weight <= 1; weight += 0.1) {
      for (double turn = 0; turn <= 1.6; turn += 0.1) {
        const double mean = (larger + smaller) / 2, half = (larger - smaller) / 2;
        const double along = half * (1 - weight + weight * std::cos(2 * turn)),
                     across = half * weight * std::sin(2 * turn);
        const double spread = std::hypot(along, across);
        const double exact = RadiusFactor95(std::sqrt((mean - spread) / (mean + spread)));
        const double ours = RadiusFactor95(ratio);
        EXPECT_GE(ours, exact * (1 - 1e-6));
        EXPECT_LE(ours, exact * 1.03);
      }
    }
  }
}

}  // namespace
}  // namespace albtpu::annotate
