#include "sea/files/sea_series.h"

#include <gmock/gmock.h>

#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

SeaRecord Swell() {
  return {.water_depth = 12,
          .wind_speed_10m = 4,
          .wind_from = 1,
          .waves = std::make_shared<const std::vector<JonswapWaves>>(
              1, JonswapWaves{.significant_wave_height = 1.5, .peak_period = 8, .gamma = 7})};
}

TEST(DescriptionOfARecord, TakesWhatTheRecordHas) {
  const SeaDescription description = DescriptionOf(Swell());
  EXPECT_EQ(description.water_depth, 12);
  EXPECT_EQ(description.wind_speed_10m, 4);
  EXPECT_EQ(description.wind_from, 1);
  EXPECT_EQ(description.waves->significant_wave_height(), 1.5);
}

TEST(DescriptionOfARecord, PrefersWhatIsTold) {
  const SeaDescription description =
      DescriptionOf(Swell(), {.wind_speed_10m = 6, .wind_from = 2, .water_depth = 5, .tail = TailRule::kLevel});
  EXPECT_EQ(description.water_depth, 5);
  EXPECT_EQ(description.wind_speed_10m, 6);
  EXPECT_EQ(description.wind_from, 2);
  EXPECT_EQ(description.tail, TailRule::kLevel);
  // The waves are those of that depth.
  EXPECT_EQ((*description.waves)(0.2).energy, JonswapSpectrum(*std::get<WaveComponents>(Swell().waves), 5)(0.2).energy);
}

TEST(DescribedRecord, IsInItsDepth) {
  EXPECT_EQ(Describe(Swell()).water_depth, 12);
  EXPECT_GT(MeanSquareSlope(Describe(Swell(), {.water_depth = 4, .tail = TailRule::kNone}).spectrum),
            MeanSquareSlope(Describe(Swell(), {.water_depth = 40, .tail = TailRule::kNone}).spectrum));
}

TEST(SortByTime, OrdersByPointAndTimeAndKeepsTheFirstOfEqualTimes) {
  SeaSeries series;
  for (const auto& [point, time, height] : {std::tuple(1, 5.0, 1.0), {0, 7.0, 2.0}, {0, 3.0, 3.0}, {0, 7.0, 4.0}}) {
    SeaRecord record{.time = time, .point = static_cast<std::size_t>(point)};
    record.waves = std::make_shared<const std::vector<JonswapWaves>>(
        1, JonswapWaves{.significant_wave_height = height, .peak_period = 5});
    series.records.push_back(record);
  }
  SortByTime(series);
  ASSERT_EQ(series.records.size(), 3u);
  EXPECT_EQ(series.records[0].time, 3);
  EXPECT_EQ(series.records[1].significant_wave_height(), 2);
  EXPECT_EQ(series.records[2].point, 1u);
  EXPECT_THAT(series.assumed, ::testing::ElementsAre(::testing::HasSubstr("1 records repeat")));
}

}  // namespace
}  // namespace albtpu
