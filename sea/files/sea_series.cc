#include "sea/files/sea_series.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

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
  sea.assumed.axes_from_north = !given.wind_from;
  sea.wind_speed_10m = given.wind_speed_10m.value_or(0);
  sea.water_depth = given.water_depth.value_or(sea.water_depth);
  return sea;
}

void NoteIsotropic(SeaSeries& series, std::string_view what) {
  constexpr double kNoted = 0.1;
  const auto is_noted = [](const SeaRecord& record) {
    const auto* bins = std::get_if<BinnedWaves>(&record.waves);
    return bins != nullptr && (*bins)->isotropic_share() > kNoted;
  };
  const auto records = std::ranges::count_if(series.records, is_noted);
  if (records > 0)
    series.assumed.push_back(absl::StrCat(records, " records have no ", std::string(what),
                                          ", or an r2 of 0, for a tenth of their energy or more: these waves are taken "
                                          "as isotropic"));
}

void SortByTime(SeaSeries& series) {
  const auto key = [](const SeaRecord& record) { return std::tuple(record.point, record.time.value_or(-INFINITY)); };
  std::vector<std::size_t> order(series.records.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(series.records[a]) < key(series.records[b]); });
  std::vector<SeaRecord> sorted;
  for (const std::size_t i : order)
    if (sorted.empty() || key(sorted.back()) != key(series.records[i])) sorted.push_back(std::move(series.records[i]));
  const std::size_t repeated = series.records.size() - sorted.size();
  series.records = std::move(sorted);
  if (repeated > 0)
    series.assumed.push_back(absl::StrCat(repeated, " records repeat the time of another one and are left out"));
}

}  // namespace albtpu
