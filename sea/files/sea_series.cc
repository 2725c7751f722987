#include "sea/files/sea_series.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>

#include "absl/strings/str_cat.h"
#include "sea/spectra/spectrum_moments.h"

namespace albtpu {
namespace {

struct HeightOf {
  const SeaRecord& record;
  double operator()(WindAlone) const { return SignificantWaveHeight(Describe(record).spectrum); }
  double operator()(const BinnedWaves& waves) const { return waves->significant_wave_height(); }
  double operator()(const WaveComponents& waves) const { return JonswapSpectrum(*waves).significant_wave_height(); }
  double operator()(const WholeSea& waves) const { return SignificantWaveHeight(*waves); }
};

SeaDescription Merged(const SeaRecord& record, SeaDescription given) {
  if (!given.water_depth) given.water_depth = record.water_depth;
  if (!given.wind_speed_10m) given.wind_speed_10m = record.wind_speed_10m;
  if (!given.wind_from) given.wind_from = record.wind_from;
  return given;
}

}  // namespace

double SeaRecord::significant_wave_height() const { return std::visit(HeightOf{*this}, waves); }

SeaDescription DescriptionOf(const SeaRecord& record, SeaDescription given) {
  assert(!std::holds_alternative<WholeSea>(record.waves));
  given = Merged(record, std::move(given));
  if (const auto* bins = std::get_if<BinnedWaves>(&record.waves)) {
    given.waves = *bins;
  } else if (const auto* components = std::get_if<WaveComponents>(&record.waves)) {
    given.waves = std::make_shared<JonswapSpectrum>(
        **components, given.water_depth.value_or(std::numeric_limits<double>::infinity()));
  }
  return given;
}

DescribedSea Describe(const SeaRecord& record, SeaDescription given) {
  const auto* const whole = std::get_if<WholeSea>(&record.waves);
  if (whole == nullptr) return Describe(DescriptionOf(record, std::move(given)));
  given = Merged(record, std::move(given));
  DescribedSea sea;
  sea.spectrum = sea.resolved = Resampled(**whole, SeaWavenumbers());
  sea.x_azimuth = given.wind_from ? FullTurn(*given.wind_from + std::numbers::pi) : 0;
  sea.wind_speed_10m = given.wind_speed_10m.value_or(0);
  sea.water_depth = given.water_depth.value_or(sea.water_depth);
  return sea;
}

void SortByTime(SeaSeries& series) {
  const auto key = [](const SeaRecord& record) { return std::tuple(record.point, record.time.value_or(-INFINITY)); };
  std::stable_sort(series.records.begin(), series.records.end(),
                   [&](const SeaRecord& a, const SeaRecord& b) { return key(a) < key(b); });
  const auto end = std::unique(series.records.begin(), series.records.end(),
                               [&](const SeaRecord& a, const SeaRecord& b) { return key(a) == key(b); });
  const auto repeated = series.records.end() - end;
  series.records.erase(end, series.records.end());
  if (repeated > 0)
    series.assumed.push_back(absl::StrCat(repeated, " records repeat the time of another one and are left out"));
}

}  // namespace albtpu
