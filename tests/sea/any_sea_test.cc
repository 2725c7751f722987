// From what is known of a sea to what it does to a beam: descriptions and files, through the spectrum, to refraction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <vector>

#include "sea/angle.h"
#include "sea/files/sea_file.h"
#include "sea/response/closed_form.h"
#include "sea/response/sea_response.h"
#include "sea/spectra/described_sea.h"
#include "sea/spectra/jonswap.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

constexpr BeamOptions kNadir = {.footprint = 0.6};
constexpr TailRule kTails[] = {TailRule::kWind, TailRule::kRelax, TailRule::kLevel};

// Waves of 3.2 s from 230 degrees, with their wind.
SeaDescription WavesOf(double hs, TailRule tail) {
  const double from = RadiansOfDegrees(230);
  return {.waves = std::make_shared<JonswapSpectrum>(std::vector{JonswapWaves{
              .significant_wave_height = hs, .peak_period = 3.2, .travels_towards = from - std::numbers::pi}}),
          .wind_speed_10m = 6,
          .wind_from = from,
          .tail = tail};
}

BeamResponse ResponseTo(const HarmonicSpectrum& spectrum) { return SeaResponse(spectrum, kRefractiveIndex)(kNadir); }

// Degrees, of the axis on which refraction is greater.
double Refraction(const HarmonicSpectrum& spectrum) {
  const BeamResponse response = ResponseTo(spectrum);
  return DegreesOfRadians(std::max(response.refraction_along_wind(), response.refraction_cross_wind()));
}

// At nadir the ray follows the slope with the gain (n - 1) / n, less 0.19 of the mean square slope of the whole sea by
// the third order in slope (closed_form.h). The fifth order is of the order of that slope squared.
TEST(AnySea, OfHeightAndPeriodRefractsByTheSlopesUnderTheFootprint) {
  for (const TailRule tail : kTails) {
    const HarmonicSpectrum sea = Describe(WavesOf(0.6, tail)).spectrum;
    HarmonicSpectrum seen = sea;
    for (std::size_t i = 0; i < seen.size(); ++i) seen.s[i] *= FootprintPower(kNadir, seen.k[i], 0);
    const double gain = (kRefractiveIndex - 1) / kRefractiveIndex;
    const double linear = 2 * gain * std::sqrt(MeanSquareSlope(seen));
    const double mss = MeanSquareSlope(sea), depth = 1000;
    EXPECT_NEAR(ResponseTo(sea).Thu(depth) / depth / linear, 1 - 0.19 * mss, mss * mss);
  }
}

TEST(AnySea, RefractsMoreAlongTheWindThanAcrossAndWithItsTailThanWithout) {
  const double bare = Refraction(Describe(WavesOf(0.6, TailRule::kNone)).spectrum);
  for (const TailRule tail : kTails) {
    const BeamResponse response = ResponseTo(Describe(WavesOf(0.6, tail)).spectrum);
    EXPECT_GT(response.refraction_along_wind(), response.refraction_cross_wind());
    EXPECT_GT(DegreesOfRadians(response.refraction_along_wind()), bare);
  }
}

// The power of the height to which refraction is proportional: 1 without a tail or where the tail has the level of the
// waves, less where it follows the wind. The third order in slope takes up to 0.3 of the mean square slope off
// refraction on one axis, and as the slope is in proportion to the height, up to twice that off the power.
TEST(AnySea, FollowsTheHeightOfTheWavesAsItsTailDoes) {
  const auto power = [](TailRule tail) {
    const double more = Refraction(Describe(WavesOf(0.63, tail)).spectrum);
    return std::log(more / Refraction(Describe(WavesOf(0.6, tail)).spectrum)) / std::log(0.63 / 0.6);
  };
  const double mss = MeanSquareSlope(Describe(WavesOf(0.63, TailRule::kLevel)).spectrum);
  EXPECT_NEAR(power(TailRule::kNone), 1, 2 * 0.3 * mss);
  EXPECT_NEAR(power(TailRule::kLevel), 1, 2 * 0.3 * mss);
  EXPECT_LT(power(TailRule::kWind), power(TailRule::kRelax));
  EXPECT_LT(power(TailRule::kRelax), power(TailRule::kLevel));
}

// A station in the open ocean that states no wind. The ranges are what an independent computation found for hours of
// this station; the calmest and the roughest ones lie beyond.
TEST(AnySea, OfABuoyRefractsByItsWavesAndMoreByItsTail) {
  const std::filesystem::path file = std::filesystem::path(SEA_SAMPLES) / "41010.data_spec";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "no sample files in " << SEA_SAMPLES;
  }
  const auto series = ReadSeaFile(file);
  std::vector<double> measured, whole;
  for (const SeaRecord& record : series->records) {
    const HarmonicSpectrum sea = Describe(record).spectrum;
    measured.push_back(Refraction(Describe(record, {.tail = TailRule::kNone}).spectrum));
    whole.push_back(Refraction(sea));
    // Short waves that the footprint averages out lower the gain a little.
    EXPECT_GT(whole.back(), (1 - 0.19 * MeanSquareSlope(sea)) * measured.back());
  }
  const auto median = [](std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
  };
  EXPECT_GT(median(measured), 0.5);
  EXPECT_LT(median(measured), 1.6);
  EXPECT_GT(median(whole), 1.4);
  EXPECT_LT(median(whole), 2.6);
}

}  // namespace
}  // namespace albtpu
