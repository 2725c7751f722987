// Arbitrary text as a file of a sea, for the reader of each format and for the one that finds the format, is rejected
// with a message, or is a sea as sea/files/sea_series.h promises it.
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sea/files/ndbc_bulk.h"
#include "sea/files/ndbc_spectra.h"
#include "sea/files/sea_csv.h"
#include "sea/files/sea_file.h"
#include "sea/files/swan_spectra.h"
#include "sea/files/ww3_points.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

void MustBeBins(const BinnedSpectrum& bins) {
  ALBTPU_MUST(bins.size() >= 2 && bins.trusted_up_to() > 0);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    ALBTPU_MUST(bins.centre(i) > (i == 0 ? 0 : bins.centre(i - 1)));
    const DirectionalEnergy bin = bins.bin(i);
    ALBTPU_MUST(bin.energy >= 0 && std::isfinite(bin.energy));
    for (std::size_t n = 0; n < kSeaHarmonics; ++n)
      ALBTPU_MUST(std::hypot(bin.cosine[n], bin.sine[n]) <= bin.energy * (1 + 1e-9));
  }
}

void MustBeWaves(const SeaRecord& record) {
  if (const auto* bins = std::get_if<BinnedWaves>(&record.waves)) {
    ALBTPU_MUST(*bins != nullptr);
    MustBeBins(**bins);
  } else if (const auto* components = std::get_if<WaveComponents>(&record.waves)) {
    ALBTPU_MUST(*components != nullptr && !(*components)->empty());
    for (const JonswapWaves& waves : **components) {
      ALBTPU_MUST(waves.significant_wave_height >= 0 && waves.significant_wave_height < 99);
      ALBTPU_MUST(waves.peak_period >= 0.5 && waves.peak_period < 99 && std::isfinite(waves.travels_towards));
    }
  } else if (std::holds_alternative<WindAlone>(record.waves)) {
    ALBTPU_MUST(record.wind_speed_10m && (record.wind_from || *record.wind_speed_10m == 0));
  } else {
    const HarmonicSpectrum& whole = *std::get<WholeSea>(record.waves);
    ALBTPU_MUST(whole.size() >= 2 && whole.s.size() == whole.size() && whole.b.size() == whole.harmonics());
    for (const auto& harmonic : whole.a) ALBTPU_MUST(harmonic.size() == whole.size());
  }
}

// One line without a name, or records in order of which each can be described.
void MustBeASea(const absl::StatusOr<SeaSeries>& series, std::string_view input) {
  if (!series.ok()) {
    ALBTPU_MUST(absl::IsInvalidArgument(series.status()) && series.status().message().size() > 10);
    ALBTPU_MUST(series.status().message().find('\n') == std::string::npos);
    return;
  }
  ALBTPU_MUST(!series->records.empty());
  for (std::size_t i = 0; i < series->records.size(); ++i) {
    const SeaRecord& record = series->records[i];
    ALBTPU_MUST(record.point < series->points.size());
    ALBTPU_MUST(i == 0 || series->records[i - 1].point <= record.point);
    if (i > 0 && series->records[i - 1].point == record.point) ALBTPU_MUST(series->records[i - 1].time < record.time);
    ALBTPU_MUST(!record.water_depth || *record.water_depth > 0);
    ALBTPU_MUST(!record.wind_speed_10m || (*record.wind_speed_10m >= 0 && std::isfinite(*record.wind_speed_10m)));
    MustBeWaves(record);
  }
  if (!IsOneIn(1024, input)) return;  // It takes a thousand times as long as reading a short file.
  const DescribedSea sea = Describe(series->records.front());
  ALBTPU_MUST(MeanSquareSlope(sea.spectrum) >= 0 && std::isfinite(MeanSquareSlope(sea.spectrum)));
}

// NDBC's files of energy, r2 and alpha2, divided by zero bytes.
void NdbcSpectraTarget(std::string_view input) {
  std::vector<std::string> texts;  // Copies: sanitizers see reads beyond each.
  std::size_t begin = 0;
  for (std::size_t end = 0; end != input.npos; begin = end + 1) {
    end = texts.size() < 2 ? input.find('\0', begin) : input.npos;
    texts.emplace_back(input.substr(begin, end - begin));
  }
  NdbcTexts files{.energy = texts[0]};
  if (texts.size() > 1) files.spread = texts[1];
  if (texts.size() > 2) files.direction = texts[2];
  MustBeASea(ReadNdbcSpectra(files), input);
}

// Bytes that gzip made, or not, inflate to no more than the limit.
void GzipTarget(std::string_view bytes) {
  constexpr std::size_t kMost = 100'000;
  const auto text = Inflated(bytes, kMost);
  ALBTPU_MUST(text.ok() ? text->size() <= kMost : text.status().message().size() > 10);
  ALBTPU_MUST(!text.ok() || IsGzip(bytes));
}

}  // namespace

const std::vector<Target> kTargets = {
    {"ndbc_bulk", [](std::string_view text) { MustBeASea(ReadNdbcBulk(text), text); }},
    {"ndbc_spectra", NdbcSpectraTarget},
    {"sea_csv", [](std::string_view text) { MustBeASea(ReadSeaCsv(text), text); }},
    {"sea_gzip", GzipTarget},
    {"sea_text", [](std::string_view text) { MustBeASea(ReadSeaText(text), text); }},
    {"swan_spectra", [](std::string_view text) { MustBeASea(ReadSwanSpectra(text), text); }},
    {"ww3_points", [](std::string_view text) { MustBeASea(ReadWw3Points(text), text); }}};

}  // namespace albtpu::fuzz
