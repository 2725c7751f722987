#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "generator/campaign/campaign_axes.h"
#include "generator/campaign/table_maker.h"
#include "generator/monte_carlo/monte_carlo.h"
#include "sea/angle.h"
#include "sea/response/sea_response.h"
#include "tables/query/interpolation.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

// Waves from the south-west with a crossing swell, twice; the second time half as high.
constexpr char kTwoTimes[] = R"(time,f,E,r2,alpha2
2020-06-08T03:50Z,0.1,0.2,0.9,290
2020-06-08T03:50Z,0.15,0.05,0.6,240
2020-06-08T03:50Z,0.25,0.3,0.8,225
2020-06-08T03:50Z,0.35,0.1,0.6,225
2020-06-08T03:50Z,0.45,0.03,0.5,225
2020-06-08T04:50Z,0.1,0.05,0.9,290
2020-06-08T04:50Z,0.15,0.0125,0.6,240
2020-06-08T04:50Z,0.25,0.075,0.8,225
2020-06-08T04:50Z,0.35,0.025,0.6,225
2020-06-08T04:50Z,0.45,0.0075,0.5,225
)";

class TracedSeaTest : public testing::Test {
 protected:
  TracedSeaTest() : path_(std::filesystem::path(testing::TempDir()) / "traced_sea.csv") { Write(kTwoTimes); }
  ~TracedSeaTest() override { std::filesystem::remove(path_); }

  void Write(const std::string& text) { std::ofstream(path_) << text; }
  SeaOfFile Told() const {
    SeaOfFile told;
    told.file = path_;
    told.time = "2020-06-08T03:50Z";
    told.wind_speed = 6;
    told.wind_from = 225;
    return told;
  }
  std::string Problem(const SeaOfFile& told) { return std::string(ReadTracedSea(told).status().message()); }

  std::filesystem::path path_;
};

TEST_F(TracedSeaTest, IsTheSeaThatIsDescribed) {
  const absl::StatusOr<TracedSea> sea = ReadTracedSea(Told());
  EXPECT_NEAR(DegreesOfRadians(sea->described.x_azimuth), 45, 1e-9);
  EXPECT_EQ(sea->described.wind_speed_10m, 6);
  const HarmonicSpectrum& samples = sea->described.spectrum;
  for (std::size_t i = 0; i < samples.size(); i += 11)
    EXPECT_NEAR((*sea->waves.spectrum)(samples.k[i]), samples.s[i], 1e-9 * samples.s[i]);
  EXPECT_EQ(std::get<std::string>(sea->attributes.at("sea_file")), "traced_sea.csv");
  EXPECT_EQ(std::get<std::string>(sea->attributes.at("sea_time")), "2020-06-08T03:50Z");
  EXPECT_EQ(std::get<std::string>(sea->attributes.at("tail")), "relax");
}

TEST_F(TracedSeaTest, HasAnotherDigestWithOtherWaves) {
  SeaOfFile later = Told();
  later.time = "2020-06-08T04:50Z";
  EXPECT_EQ(ReadTracedSea(Told())->digest, ReadTracedSea(Told())->digest);
  EXPECT_NE(ReadTracedSea(Told())->digest, ReadTracedSea(later)->digest);
}

TEST_F(TracedSeaTest, NeedsATimeThatTheFileHas) {
  SeaOfFile told = Told();
  told.time.reset();
  EXPECT_THAT(Problem(told), HasSubstr("has 2 states of the sea"));
  told.time = "2020-06-08T04:00Z";
  EXPECT_THAT(Problem(told), HasSubstr("the nearest is that of 2020-06-08T03:50Z"));
  told.time = "yesterday";
  EXPECT_THAT(Problem(told), HasSubstr("'yesterday' is not a time of a sea"));
  Write("f,E,r2,alpha2\n0.1,0.2,0.9,290\n0.2,0.1,0.9,290\n");
  told.time = "2020-06-08T04:00Z";
  EXPECT_THAT(Problem(told), HasSubstr("does not say when its sea was"));
}

TEST_F(TracedSeaTest, NeedsAFileOfASea) {
  Write("this is no sea\n");
  EXPECT_THAT(Problem(Told()), testing::StartsWith(path_.string()));
  SeaOfFile told = Told();
  told.file = path_.string() + ".absent";
  EXPECT_EQ(ReadTracedSea(told).status().code(), absl::StatusCode::kNotFound);
}

// Tracing against the response theory, which knows the harmonics only. Half a per cent of the variance is a quarter of
// a per cent of the value (discretization.h); TVU has what the grid leaves to closed forms.
TEST_F(TracedSeaTest, RefractsAsTheResponseTheorySays) {
  const TracedSea sea = *ReadTracedSea(Told());
  const SeaResponse theory(sea.described.spectrum, 1.33);
  SeaCase sea_case;
  sea_case.sea.waves = sea.waves;
  sea_case.depths = {10};
  for (const double azimuth : {0.0, 50.0, 130.0}) {
    sea_case.beams.push_back(
        {.incidence = RadiansOfDegrees(15), .azimuth = RadiansOfDegrees(azimuth), .footprint = 0.6});
  }
  const SeaCaseResult traced = Simulate(sea_case, {.realizations = 200, .most_realizations = 200}, 1, 0);
  for (std::size_t b = 0; b < sea_case.beams.size(); ++b) {
    const BeamResponse ours = theory(sea_case.beams[b]);
    const auto expect_near = [&](double value, const Estimate& estimate, double allowed) {
      EXPECT_NEAR(estimate.value / value, 1, allowed + 4 * estimate.standard_error / value) << b;
    };
    expect_near(ours.refraction_along_wind(), traced.beams[b].refraction_along_wind, 0.0025);
    expect_near(ours.refraction_cross_wind(), traced.beams[b].refraction_cross_wind, 0.0025);
    expect_near(ours.Thu(10), traced.beams[b].thu[0], 0.0025);
    expect_near(ours.Tvu(10), traced.beams[b].tvu[0], 0.01);
  }
}

TEST_F(TracedSeaTest, MakesATableOfOneSea) {
  const auto text = [&](const std::string& azimuth, const std::string& sea) {
    return absl::StrCat("id = \"one\"\nversion = \"1\"\ntitle = \"One sea\"\n[axes]\nincidence = [0, 20]\nazimuth = ",
                        azimuth, "\nfootprint = [1]\ndepth = [0, 10]\n[sea]\n", sea,
                        "[effort]\nrealizations = 40\n[interpolation]\nchecked_pulses = 2\n");
  };
  const std::string file = absl::StrCat("file = \"", path_.string(), "\"\ntime = \"2020-06-08T03:50Z\"\n");
  const absl::StatusOr<Campaign> campaign = ParseCampaign(text("[0, 60, 120, 180]", file));
  const absl::StatusOr<UncertaintyTable> table = MakeTable(*campaign, [](std::size_t) {});
  EXPECT_TRUE(table->is_of_one_sea());
  const auto at = [&](float azimuth) {
    return Interpolate(*table, {.incidence = 20, .azimuth = azimuth, .footprint = 1, .depth = 10});
  };
  ASSERT_EQ(at(0).outcome, Outcome::kInterpolated);
  EXPECT_GT(at(0)[Quantity::kThu], 0);
  EXPECT_EQ(at(0)[Quantity::kTvu], at(180)[Quantity::kTvu]);
  EXPECT_NE(at(60)[Quantity::kTvu], at(120)[Quantity::kTvu]);  // the swell crosses: there is no mirror
  EXPECT_TRUE(table->provenance().attributes.contains("x_azimuth"));

  const auto problem = [&](const std::string& campaign_text) {
    return std::string(ParseCampaign(campaign_text).status().message());
  };
  EXPECT_THAT(problem(text("[0, 90]", file)), HasSubstr("must begin at 0 and end at 180"));
  EXPECT_THAT(problem(text("[0, 180]", file + "spectrum = \"apel\"\n")), HasSubstr("has no effect"));
  EXPECT_THAT(problem(text("[0, 90]\nwind_speed = [3]", file)), HasSubstr("has no place beside 'sea.file'"));
  EXPECT_THAT(problem(text("[0, 90]\nwind_speed = [3]\nfetch = [inf]", "tail = \"wind\"\n")),
              HasSubstr("goes with 'sea.file' only"));
}

}  // namespace
}  // namespace albtpu
