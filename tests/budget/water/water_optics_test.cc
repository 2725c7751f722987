#include "budget/water/water_optics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace albtpu {
namespace {

using ::testing::HasSubstr;

std::string ProblemOf(const OpticsInput& given) { return std::string(OpticsOf(given).status().message()); }

TEST(OpticsOf, TakesTheAttenuationAsOfItsKind) {
  const auto attenuation = [](const OpticsInput& given) { return OpticsOf(given)->attenuation; };
  EXPECT_NEAR(attenuation({.kd = 0.12, .kd_kind = KdKind::kDiffuse532}), 0.12 * 0.85, 1e-12);
  // Austin and Petzold's points: 0.05 becomes 0.072, 0.1 0.106, 0.2 0.175.
  EXPECT_NEAR(attenuation({.kd = 0.1, .kd_kind = KdKind::kSatellite490}), 0.1064 * 0.85, 5e-5);
  EXPECT_NEAR(attenuation({.kd = 0.2, .kd_kind = KdKind::kSatellite490}), 0.1746 * 0.85, 5e-5);
  EXPECT_NEAR(attenuation({.kd = 0.12, .kd_kind = KdKind::kSystem}), 0.12 / 1.05, 1e-12);
  EXPECT_NEAR(attenuation({.secchi = 4.0}), 0.94 / 4 * 0.85, 1e-12);
  // In clear water 532 nm is not the clearest part of the spectrum.
  EXPECT_GT(attenuation({.secchi = 25.0}), 0.94 / 25 * 0.85);
  EXPECT_NEAR(attenuation({.jerlov = "III"}), 0.1171, 1e-12);
  EXPECT_NEAR(attenuation({.jerlov = "9C"}), 0.738 * 0.85, 1e-12);
  const double a = 0.108717, b = 0.279559;
  EXPECT_NEAR(attenuation({.absorption = a, .scattering = b, .backscatter_fraction = 0.02}),
              std::sqrt(a * a + 0.12 * a * b), 1e-12);
}

TEST(TextOf, HasTheNumbersThatWereComputedWith) {
  const OpticsText secchi = TextOf({.secchi = 5.0});
  EXPECT_EQ(secchi.way, "the Secchi depth");
  EXPECT_EQ(secchi.entered, "Secchi depth Z = 5 m");
  EXPECT_THAT(secchi.formula, HasSubstr("Kd = 0.94 / Z (Lee et al. 2015; 1.7 / Z by Poole and Atkins 1929 would be "
                                        "1.8 times as much)"));
  EXPECT_THAT(secchi.formula, HasSubstr("K = 0.85 Kd"));
  const OpticsText satellite = TextOf({.kd = 0.1, .kd_kind = KdKind::kSatellite490});
  EXPECT_EQ(satellite.entered, "Kd = 0.1 1/m of kind satellite490");
  EXPECT_THAT(satellite.formula, HasSubstr("Kd(532) = 0.0536 + 0.681 (Kd - 0.0224) (Austin and Petzold 1986)"));
  EXPECT_THAT(TextOf({.kd = 0.1, .kd_kind = KdKind::kSystem}).formula, HasSubstr("K = Kd / 1.05"));
  EXPECT_EQ(TextOf({.jerlov = "1C"}).entered, "Jerlov type 1C");
  EXPECT_EQ(TextOf({.absorption = 0.1, .scattering = 0.2}).entered, "absorption a = 0.1 1/m, scattering b = 0.2 1/m");
}

TEST(OpticsOf, SpreadsTheAlbedoByItsLogit) {
  const absl::StatusOr<WaterOptics> optics =
      OpticsOf({.kd = 0.2, .kd_kind = KdKind::kDiffuse532, .omega0 = 0.8, .omega0_sigma = 0.1});
  EXPECT_NEAR(optics->scattering_over_absorption, 4, 1e-12);
  EXPECT_NEAR(optics->ratio_log_sigma, 0.1 / 0.16, 1e-12);
  EXPECT_NEAR(OpticsOf({.kd = 0.2, .kd_kind = KdKind::kDiffuse532, .kd_sigma = 0.03})->attenuation_log_sigma, 0.15,
              1e-12);
  EXPECT_NEAR(OpticsOf({.kd = 0.2, .kd_kind = KdKind::kSatellite490, .kd_sigma = 0.03})->attenuation_log_sigma,
              0.681 * 0.03 / (0.0536 + 0.681 * 0.1776), 1e-12);
}

TEST(OpticsOf, LeavesNoLessAbsorptionThanPureWaterHas) {
  // The clearest ocean: an albedo of 0.8 would leave an absorption of 0.041 1/m.
  const absl::StatusOr<WaterOptics> clear = OpticsOf({.jerlov = "I", .backscatter_fraction = 0.0183});
  ASSERT_TRUE(clear.ok()) << clear.status();
  EXPECT_NEAR(clear->scattering_over_absorption, 4, 1e-12);
  const double ratio = clear->typical_albedo() / (1 - clear->typical_albedo());
  EXPECT_LT(ratio, 4);
  EXPECT_NEAR(clear->attenuation / std::sqrt(1 + 6 * 0.0183 * ratio), kPureWaterAbsorption, 1e-9);
  EXPECT_THAT(ProblemOf({.jerlov = "I", .omega0 = 0.8}), HasSubstr("give at most"));
}

TEST(OpticsOf, RefusesWhatIsNoWater) {
  EXPECT_THAT(ProblemOf({}), HasSubstr("nothing says"));
  EXPECT_THAT(ProblemOf({.kd = 0.1}), HasSubstr("kd_kind"));
  EXPECT_THAT(ProblemOf({.kd = 0.1, .kd_kind = KdKind::kDiffuse532, .secchi = 5.0}), HasSubstr("several ways"));
  EXPECT_THAT(ProblemOf({.absorption = 0.1}), HasSubstr("give both"));
  EXPECT_THAT(ProblemOf({.absorption = 0.1, .scattering = 0.2, .omega0 = 0.5}), HasSubstr("omega0"));
  EXPECT_THAT(ProblemOf({.kd = 0.05, .kd_kind = KdKind::kDiffuse532}), HasSubstr("clearer than pure water"));
  EXPECT_THAT(ProblemOf({.absorption = 0.04, .scattering = 0.2}), HasSubstr("clearer than pure water"));
}

}  // namespace
}  // namespace albtpu
