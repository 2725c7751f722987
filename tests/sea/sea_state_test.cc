#include "sea/sea_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "sea/response/closed_form.h"
#include "sea/spectra/wind_sea.h"

namespace albtpu {
namespace {

// The slow twin of SlopeCovariance: five times as many wavenumbers and four times as many directions, of half a turn:
// the other half is the same.
Eigen::Matrix2d FineSlopeCovariance(const SeaState& sea, const BeamOptions& beam) {
  constexpr double kStep = 0.004;
  constexpr int kDirections = 64;
  const auto [lowest, highest] = sea.energetic_range();
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (double k = lowest; k < highest; k *= std::exp(kStep)) {
    for (int j = 0; j < kDirections; ++j) {
      const double psi = std::numbers::pi * (j + 0.5) / kDirections;
      const Eigen::Vector2d wave(k * std::cos(psi), k * std::sin(psi));
      sum += sea.Psi(k, psi) * FootprintPower(beam, k, psi) * k * k * kStep * (2 * std::numbers::pi / kDirections) *
             wave * wave.transpose();
    }
  }
  return sum;
}

TEST(SeaState, IsSymmetricUnderAHalfTurnAndAboutTheWind) {
  const SeaState sea(7, 1e4);
  for (const double psi : {0.1, 0.8, 1.5}) {
    EXPECT_NEAR(sea.Psi(3, psi) / sea.Psi(3, psi + std::numbers::pi), 1, 1e-12);
    EXPECT_NEAR(sea.Psi(3, psi) / sea.Psi(3, -psi), 1, 1e-12);
  }
}

TEST(SeaState, HasSlopeVariancesInTheRatioSevenToFive) {
  const Eigen::Matrix2d slopes = SlopeCovariance(SeaState(5, kFullyDeveloped));
  EXPECT_NEAR(slopes.trace(), 0.049, 0.0005);  // printed precision
  EXPECT_NEAR(slopes(0, 0) / slopes(1, 1), 7.0 / 5, 1e-9);
  EXPECT_NEAR(slopes(0, 1), 0, 1e-12);
}

TEST(SeaState, HasTheWaveHeightOfItsSpectrum) {
  EXPECT_NEAR(4 * std::sqrt(ElevationVariance(SeaState(10, kFullyDeveloped))), 2.04, 0.005);
}

TEST(SeaState, OfElfouhailySpreadsWavesByTheirWavenumber) {
  const SeaState sea({.waves = WindSea{.wind_speed_10m = 7, .model = &kElfouhailyModel}});
  // Along and across, from the Python script of elfouhaily_spectrum_test.cc.
  const Eigen::Matrix2d slopes = SlopeCovariance(sea);
  EXPECT_NEAR(slopes(0, 0), 0.02375, 5e-6);
  EXPECT_NEAR(slopes(1, 1), 0.01637, 5e-6);
  const double k_p = sea.spectrum().peak_wavenumber();
  EXPECT_LT(sea.Psi(k_p, std::numbers::pi / 2) / sea.Psi(k_p, 0), 1e-3);
  EXPECT_GT(sea.Psi(30, std::numbers::pi / 2) / sea.Psi(30, 0), 0.6);
}

TEST(SeaState, LosesTheVarianceOfTheCorrectedWaves) {
  for (const SpectrumModel* model : kSpectrumModels) {
    const SeaOptions options{.waves = WindSea{.wind_speed_10m = 8, .model = model}};
    SeaOptions corrected = options;
    corrected.corrected_above = 20;
    const SeaState whole(options), rest(corrected);
    const double longest = 2 * std::numbers::pi / 20;
    const double removed = ElevationVariance(whole) - ElevationVariance(rest);
    // Simpson's rule over the waves left out.
    constexpr int kSteps = 2000;
    const double lowest = whole.energetic_range().lowest, step = (longest - lowest) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i)
      sum += whole.S(lowest + i * step) * step / 3 * (i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2);
    EXPECT_NEAR(removed / sum, 1, 1e-3) << model->key;
    EXPECT_EQ(rest.S(0.99 * longest), 0) << model->key;
    EXPECT_EQ(rest.S(1.01 * longest), whole.S(1.01 * longest)) << model->key;
  }
}

TEST(SeaState, IsUnchangedByALimitAboveItsLongestWave) {
  const SeaState sea(8, 1e4);
  SeaOptions options = sea.options();
  options.corrected_above = 1e6;  // m, longer than any wave
  const SeaState same(options);
  EXPECT_EQ(ElevationVariance(sea), ElevationVariance(same));
  EXPECT_EQ(SlopeCovariance(sea), SlopeCovariance(same));
}

TEST(SeaState, ScalesTheHeightOfEveryWave) {
  const SeaState sea(8, 1e4), scaled({.waves = WindSea{.wind_speed_10m = 8, .fetch = 1e4}, .height_scale = 3});
  EXPECT_NEAR(ElevationVariance(scaled) / ElevationVariance(sea), 9, 1e-12);
  EXPECT_NEAR(scaled.Psi(3, 0.4) / sea.Psi(3, 0.4), 9, 1e-12);
}

TEST(SlopeCovariance, IsAccurateToOnePartInTenThousandForAnyFootprint) {
  for (const double wind_speed : {2.0, 12.0}) {
    for (const double fetch : {100.0, kFullyDeveloped}) {
      for (const double footprint : {0.1, 0.5, 5.0}) {
        for (const SpectrumModel* model : kSpectrumModels) {
          const SeaState sea({.waves = WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = model}});
          const BeamOptions beam{.incidence = 0.4, .azimuth = 0.5, .footprint = footprint};
          const Eigen::Matrix2d fast =
              SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); });
          const Eigen::Matrix2d fine = FineSlopeCovariance(sea, beam);
          const double passed = std::max(fine.norm(), 3e-5 * SlopeCovariance(sea).trace());
          EXPECT_LT((fast - fine).norm(), 1e-4 * passed)
              << model->key << ", " << wind_speed << " m/s, " << fetch << " m, footprint " << footprint;
        }
      }
    }
  }
}

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

TEST(SpectrumModels, AreFoundByTheNamesOfTheirSpectra) {
  for (const SpectrumModel* model : kSpectrumModels)
    EXPECT_EQ(&SpectrumModelNamed(MakeSpectrum(WindSea{.wind_speed_10m = 7, .model = model})->name()), model);
  EXPECT_EQ(&SpectrumModelNamed("Elfouhaily"), &kElfouhailyModel);
  EXPECT_EQ(&SpectrumModelNamed("not stated"), &kElfouhailyModel);
  EXPECT_EQ(&SpectrumModelNamed(""), &kElfouhailyModel);
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

TEST(SpectrumModels, HoldAllButOnePartInTenThousandInTheirEnergeticRange) {
  for (const SpectrumModel* model : kSpectrumModels) {
    for (const double wind_speed : {1.0, 2.0, 5.0, 15.0}) {
      for (const double fetch : {100.0, 1e4, kFullyDeveloped}) {
        const auto spectrum = MakeSpectrum(WindSea{.wind_speed_10m = wind_speed, .fetch = fetch, .model = model});
        const auto [lowest, highest] = spectrum->energetic_range();
        const auto moment = [&](int power, double from, double to) {  // by trapezoids in log k
          constexpr int kSteps = 20000;
          const double step = std::log(to / from) / kSteps;
          double sum = 0;
          for (int i = 0; i <= kSteps; ++i) {
            const double k = from * std::exp(i * step);
            sum += (i == 0 || i == kSteps ? 0.5 : 1.0) * std::pow(k, power + 1) * (*spectrum)(k)*step;
          }
          return sum;
        };
        for (const int power : {0, 2}) {
          const double whole = moment(power, 0.1 * spectrum->peak_wavenumber(), 1e6);
          EXPECT_NEAR(moment(power, lowest, highest) / whole, 1, 1e-4)
              << model->key << ", " << wind_speed << " m/s, " << fetch << " m, moment " << power;
        }
      }
    }
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
