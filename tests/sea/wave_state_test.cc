#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "sea/response/closed_form.h"
#include "sea/sea_state.h"

namespace albtpu {
namespace {

// A made-up sea with the same curvature k^3 S = c at all wavenumbers from k1 to k2 and the same waves in all
// directions. Its mean square slope is c ln(k2 / k1), its variance of elevation c (1 / k1^2 - 1 / k2^2) / 2.
class BandSpectrum final : public WaveSpectrum {
 public:
  static constexpr double kLevel = 0.01, kLowest = 1, kHighest = 100;

  double operator()(double k) const override { return kLevel / (k * k * k); }
  double Spreading(double, double) const override { return 1 / (2 * std::numbers::pi); }
  bool spreading_varies_with_wavenumber() const override { return false; }
  double peak_wavenumber() const override { return kLowest; }
  WavenumberRange energetic_range() const override { return {kLowest, kHighest}; }
  std::string name() const override { return "a band"; }
  std::string reference() const override { return "this test"; }
  std::string departures() const override { return "it is no sea"; }
};

constexpr SpectrumModel kBandModel = {
    .key = "band",
    .author = "Band",
    .takes_spreading = false,
    .fully_developed_fetch = [](double) { return 1.0; },
    .make = [](double, double, const Cosine2sSpreading&) -> std::shared_ptr<const WaveSpectrum> {
      return std::make_shared<BandSpectrum>();
    }};

TEST(SpectrumModels, AreFoundByTheirKeys) {
  for (const SpectrumModel* model : kSpectrumModels) EXPECT_EQ(FindSpectrumModel(model->key), model);
  EXPECT_EQ(FindSpectrumModel("apel"), &kApelModel);
  EXPECT_EQ(FindSpectrumModel("elfouhaily"), &kElfouhailyModel);
  EXPECT_EQ(FindSpectrumModel("phillips"), nullptr);
  EXPECT_EQ(FindSpectrumModel(""), nullptr);
}

TEST(SpectrumModels, HaveDistinctKeys) {
  const std::set<std::string_view> keys(kSpectrumKeys.begin(), kSpectrumKeys.end());
  EXPECT_EQ(keys.size(), kSpectrumModels.size());
}

TEST(SpectrumModels, DescribeTheSpectraThatTheyMake) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const auto spectrum = MakeSpectrum(WindSea{.wind_speed_10m = 7, .model = model});
    EXPECT_NE(spectrum->name().find(model->author), std::string::npos) << model->key;
    EXPECT_NE(spectrum->reference().find("doi:"), std::string::npos) << model->key;
    EXPECT_FALSE(spectrum->departures().empty()) << model->key;
  }
}

// Elfouhaily's Omega is within 1 % of its limit there, so that waves near the peak still change by some per cent.
TEST(SpectrumModels, HaveFullyDevelopedSeasFromTheirFetchOn) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const double fetch = model->fully_developed_fetch(8);
    const auto developed = MakeSpectrum(WindSea{.wind_speed_10m = 8, .model = model});
    const auto at_fetch = MakeSpectrum(WindSea{.wind_speed_10m = 8, .fetch = fetch, .model = model});
    EXPECT_NEAR(at_fetch->peak_wavenumber() / developed->peak_wavenumber(), 1, 0.0202) << model->key;
  }
}

TEST(WindSea, IsThatOfApelUnlessAnotherModelIsNamed) {
  const auto spectrum = MakeSpectrum(WindSea{.wind_speed_10m = 6, .fetch = 2000});
  const ApelSpectrum apel(6, 2000);
  for (const double k : {0.5, 10.0, 300.0}) {
    EXPECT_EQ((*spectrum)(k), apel(k));
    EXPECT_EQ(spectrum->Spreading(k, 0.4), apel.Spreading(k, 0.4));
  }
}

TEST(WindSea, PassesItsSpreadingToModelsThatTakeOne) {
  const auto at = [](const SpectrumModel& model, double s) {
    return MakeSpectrum(WindSea{.wind_speed_10m = 6, .model = &model, .spreading = s})->Spreading(10, 0);
  };
  EXPECT_EQ(at(kApelModel, 5), Cosine2sSpreading(5)(0));
  EXPECT_EQ(at(kElfouhailyModel, 5), at(kElfouhailyModel, 2));
}

TEST(WindSea, WithoutWindHasNoWaves) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const SeaState calm({.waves = WindSea{.wind_speed_10m = 0, .fetch = 5000, .model = model}});
    EXPECT_EQ(ElevationVariance(calm), 0);
    EXPECT_EQ(SlopeCovariance(calm).trace(), 0);
    EXPECT_EQ(ClosedForm(calm, {.incidence = 0.2, .footprint = 0.5}, kRefractiveIndex).thu_per_depth, 0);
  }
}

TEST(WindSea, CanBeOfASpectrumThatNoListNames) {
  const SeaState sea({.waves = WindSea{.wind_speed_10m = 5, .model = &kBandModel}});
  EXPECT_EQ(sea.spectrum().name(), "a band");
  const double mean_square_slope = BandSpectrum::kLevel * std::log(BandSpectrum::kHighest / BandSpectrum::kLowest);
  const Eigen::Matrix2d slopes = SlopeCovariance(sea);
  EXPECT_NEAR(slopes(0, 0) / (0.5 * mean_square_slope), 1, 1e-9);
  EXPECT_NEAR(slopes(1, 1) / (0.5 * mean_square_slope), 1, 1e-9);
  // The trapezoids of sea_state.h, 0.01 apart in ln k, add (2 * 0.01)^2 / 12 of the integral of k^-2.
  EXPECT_NEAR(ElevationVariance(sea) / (0.5 * BandSpectrum::kLevel * (1 - 1e-4)), 1, 3.5e-5);
  // Under a vanishing footprint the closed form is the gain times the slope.
  const double g = 1 - 1 / kRefractiveIndex;
  EXPECT_NEAR(ClosedForm(sea, {.footprint = 1e-7}, kRefractiveIndex).thu_per_depth,
              2 * g * std::sqrt(mean_square_slope), 1e-9);
}

}  // namespace
}  // namespace albtpu
