#include "generator/campaign/campaign.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "sea/angle.h"
#include "sea/spectra/apel_spectrum.h"
#include "sea/spectra/elfouhaily_spectrum.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kSmall[] = R"(id = "small"
version = "1"
title = "Two seas"
seed = 7
[axes]
wind_speed = [3, 6]
fetch = [1000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.1, 1]
depth = [0, 10]
[effort]
realizations = 50
)";

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string ErrorOf(const std::string& text) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(text);
  EXPECT_FALSE(campaign.ok()) << text;
  EXPECT_TRUE(absl::IsInvalidArgument(campaign.status()));
  return std::string(campaign.status().message());
}

WindSea WindSeaOf(const Campaign& campaign, std::size_t sea_case) {
  return std::get<WindSea>(SeaCaseOf(campaign, sea_case).sea.waves);
}

TEST(Campaign, HasTheValuesOfItsFile) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(kSmall);
  EXPECT_EQ(campaign->text, kSmall);
  EXPECT_EQ(campaign->id, "small");
  EXPECT_EQ(campaign->seed, 7u);
  EXPECT_EQ(campaign->effort.realizations, 50);
  EXPECT_EQ(campaign->effort.most_realizations, 50);
  EXPECT_FALSE(campaign->rays.has_value());
  EXPECT_EQ(campaign->nodes(AxisId::kFootprint).front(), static_cast<double>(0.1f));
}

TEST(Campaign, ResolvesInfiniteFetchToFullDevelopmentOfTheStrongestWind) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(kSmall);
  const double last = campaign->nodes(AxisId::kFetch).back();
  EXPECT_GE(last, ApelSpectrum::FullyDevelopedFetch(6));
  EXPECT_NEAR(last / ApelSpectrum::FullyDevelopedFetch(6), 1, 1e-6);  // the next float
  for (const double wind : {3.0, 6.0}) EXPECT_EQ(ApelSpectrum::InverseWaveAge(wind, last), 0.84);
}

TEST(Campaign, UsesTheSpectrumOfItsFile) {
  const absl::StatusOr<Campaign> apel = ParseCampaign(kSmall);
  EXPECT_EQ(WindSeaOf(*apel, 0).model, &kApelModel);
  EXPECT_TRUE(std::isinf(SeaCaseOf(*apel, 0).sea.corrected_above));

  const absl::StatusOr<Campaign> other =
      ParseCampaign(std::string(kSmall) + "[sea]\nspectrum = \"elfouhaily\"\ncorrected_above = 30\n");
  EXPECT_EQ(WindSeaOf(*other, 0).model, &kElfouhailyModel);
  EXPECT_EQ(SeaCaseOf(*other, 0).sea.corrected_above, 30);
  // Elfouhaily's sea needs a longer fetch for full development; the last node is at that fetch.
  EXPECT_NEAR(other->nodes(AxisId::kFetch).back() / ElfouhailySpectrum::FullyDevelopedFetch(6), 1, 1e-6);
  EXPECT_TRUE(std::isinf(WindSeaOf(*other, 7).fetch));
}

TEST(Campaign, CanAskForRayTracingAlone) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(std::string(kSmall) + "estimator = \"plain\"\n");
  EXPECT_EQ(campaign->effort.estimator, Estimator::kPlain);
  EXPECT_EQ(ParseCampaign(kSmall)->effort.estimator, Estimator::kControlVariate);
}

TEST(Campaign, OrdersSeaCasesByWindFetchAndFootprint) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(kSmall);
  ASSERT_EQ(SeaCaseCount(*campaign), 8u);
  const SeaCase sea_case = SeaCaseOf(*campaign, 5);  // wind 1, fetch 0, footprint 1
  EXPECT_EQ(WindSeaOf(*campaign, 5).wind_speed_10m, 6);
  EXPECT_EQ(WindSeaOf(*campaign, 5).fetch, 1000);
  ASSERT_EQ(sea_case.beams.size(), 4u);
  EXPECT_EQ(sea_case.beams[3].footprint, 1);
  EXPECT_EQ(sea_case.beams[3].incidence, RadiansOfDegrees(20));
  EXPECT_EQ(sea_case.beams[3].azimuth, RadiansOfDegrees(90));
}

TEST(Campaign, StatesTheLineThatIsNotToml) {
  EXPECT_THAT(ErrorOf("id = \"x\"\nversion = = 2\n"), StartsWith("line 2: is not TOML"));
}

TEST(Campaign, NamesLineAndKeyOfWhatIsWrong) {
  struct Case {
    const char *from, *to, *error;
  };
  for (const Case& c : {
           Case{"id = \"small\"\n", "", "'id' is missing"},
           {"depth = [0, 10]\n", "", "'axes.depth' is missing"},
           {"realizations", "realisations",
            "line 13: 'effort.realisations' is no key of a campaign file; did you mean realizations?"},
           {"[effort]", "[effort]\ncolor = 2", "'effort.color' is no key of a campaign file; there are estimator, "},
           // A misspelt key rather than the one that is missing.
           {"depth", "deph", "line 11: 'axes.deph' is no key of a campaign file; did you mean depth?"},
           {"depth", "colors", "'axes.colors' is no key"},
           {"[3, 6]", "\"strong\"", "line 6: 'axes.wind_speed' is 'strong' (expected a list of numbers"},
           {"realizations = 50", "realizations = 1",
            "line 13: 'effort.realizations' is 1 (expected a whole number from 2"},
           {"[effort]", "[effort]\nestimator = \"none\"",
            "'effort.estimator' is 'none' (expected control_variate, plain)"},
           {"[0, 20]", "[20, 0]", "nodes must increase"},
           {"[3, 6]", "[3, nan]", "wind_speed"},
           {"depth = [0, 10]", "depth = [-1, 10]", "depth"},
           {"depth = [0, 10]", "depth = []", "depth"},
           {"[3, 6]", "[-1, 6]", "'axes.wind_speed' must be at least 0"},
           {"[0.1, 1]", "[0, 1]", "'axes.footprint' must be at least 0.001"},
           {"[1000, inf]", "[1000, 5000]", "must be inf"},
           {"[1000, inf]", "[1e7, inf]", "beyond full development"},
           {"[axes]", "[sea]\nspectrum = \"phillips\"\n[axes]",
            "'sea.spectrum' is 'phillips' (expected apel, elfouhaily)"},
           {"[axes]", "[sea]\nspectrum = 3\n[axes]", "line 6: 'sea.spectrum' is 3"},
           {"[axes]", "[sea]\ncorrected_above = 0\n[axes]",
            "line 6: 'sea.corrected_above' is 0 (expected 0.1 to inf m)"},
           {"[axes]", "[sea]\nspectrum = \"elfouhaily\"\nspreading = 2\n[axes]",
            "'sea.spreading' is not taken by \"elfouhaily\""},
           // The table of a measured sea is made by another command.
           {"[axes]", "[sea]\nfile = \"buoy.csv\"\n[axes]",
            "'sea.file' is no key of a campaign file; make the table of a measured sea by albtpu-query sea FILE "
            "--output "
            "TABLE.h5"},
       })
    EXPECT_THAT(ErrorOf(Replaced(kSmall, c.from, c.to)), HasSubstr(c.error));
}

TEST(Campaign, RefusesMoreCellsThanATableHolds) {
  std::string nodes = "1";
  for (int i = 2; i <= 512; ++i) nodes += ", " + std::to_string(i);
  std::string text = kSmall;
  for (const char* list : {"0, 10", "3, 6", "0.1, 1"}) text = Replaced(text, list, nodes);
  text = Replaced(text, "1000, inf", nodes + ", inf");
  EXPECT_THAT(ErrorOf(text), HasSubstr("more cells than a table holds"));
}

TEST(Campaign, StopsAtItsRealizationsWithoutARelativeError) {
  const absl::StatusOr<Campaign> campaign = ParseCampaign(std::string(kSmall) + "most_realizations = 5000\n");
  EXPECT_EQ(campaign->effort.most_realizations, 50);
}

TEST(Campaign, RefusesBeamsThatItsStrongestWindCannotBeTracedWith) {
  const std::string slanted = Replaced(kSmall, "[0, 20]", "[0, 60]"), windy = Replaced(slanted, "[3, 6]", "[3, 15]");
  EXPECT_TRUE(ParseCampaign(Replaced(slanted, "[3, 6]", "[1, 3]")).ok());
  EXPECT_THAT(ErrorOf(windy), StartsWith("the sea of the strongest wind, 15 m/s: waves hide behind each other at an "
                                         "incidence of 60 degrees"));
  EXPECT_THAT(ErrorOf(windy), HasSubstr("give at most 43.4 degrees"));
  EXPECT_THAT(ErrorOf(std::string(kSmall) + "[beam]\nsource_height = 1\n"),
              HasSubstr("a point source at a height of 1 m stands below crests"));
}

TEST(Campaign, RefusesATextThatCouldNestTooDeeply) {
  std::string key = "a";
  while (key.size() < 32000) key += ".a";
  EXPECT_THAT(ErrorOf(key + " = 1\n"), HasSubstr("'a' is no key of a campaign file"));
  for (int i = 0; i < 500; ++i) key += std::string(1000, 'a');
  EXPECT_THAT(ErrorOf(key + " = 1\n"), HasSubstr("a campaign file has at most 32768"));
}

TEST(Campaign, BeginsErrorsOfAFileWithItsPath) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "bad.toml";
  std::ofstream(path) << "id = 3\n";
  EXPECT_THAT(std::string(ReadCampaign(path).status().message()), StartsWith(path.string() + ": line 1: 'id' is 3"));
  EXPECT_TRUE(absl::IsNotFound(ReadCampaign(folder.path() / "absent.toml").status()));
}

}  // namespace
}  // namespace albtpu
