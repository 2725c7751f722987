// What sea/files/sea_series.h promises of a series that was read, and what a message must have.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"
#include "sea/spectra/spectrum_moments.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {

inline void MustBeBins(const BinnedSpectrum& bins) {
  ALBTPU_MUST(bins.size() >= 2 && bins.trusted_up_to() > 0);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    ALBTPU_MUST(bins.centre(i) > (i == 0 ? 0 : bins.centre(i - 1)));
    const DirectionalEnergy bin = bins.bin(i);
    ALBTPU_MUST(bin.energy >= 0 && std::isfinite(bin.energy));
    for (std::size_t n = 0; n < kSeaHarmonics; ++n)
      ALBTPU_MUST(std::hypot(bin.cosine[n], bin.sine[n]) <= bin.energy * (1 + 1e-9));
  }
}

inline void MustBeWaves(const SeaRecord& record) {
  if (const auto* bins = std::get_if<BinnedWaves>(&record.waves)) {
    ALBTPU_MUST(*bins != nullptr);
    MustBeBins(**bins);
  } else if (const auto* components = std::get_if<WaveComponents>(&record.waves)) {
    ALBTPU_MUST(*components != nullptr && !(*components)->empty());
    for (const JonswapWaves& waves : **components) {
      ALBTPU_MUST(waves.significant_wave_height >= 0 && waves.significant_wave_height < 99);
      ALBTPU_MUST(waves.peak_period >= 0.5 && waves.peak_period < 99 && std::isfinite(waves.travels_towards));
    }
  } else {
    const HarmonicSpectrum& whole = *std::get<WholeSea>(record.waves);
    ALBTPU_MUST(whole.size() >= 2 && whole.s.size() == whole.size() && whole.b.size() == whole.harmonics());
    for (const auto& harmonic : whole.a) ALBTPU_MUST(harmonic.size() == whole.size());
  }
}

// One line without a name, or records in order of which each can be described.
inline void MustBeASea(const absl::StatusOr<SeaSeries>& series, bool describe) {
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
  if (!describe) return;
  const DescribedSea sea = Describe(series->records.front());
  ALBTPU_MUST(MeanSquareSlope(sea.spectrum) >= 0 && std::isfinite(MeanSquareSlope(sea.spectrum)));
}

// Describing a sea takes a thousand times as long as reading a short file: done for one input in as many.
inline bool IsDescribed(std::string_view input) { return std::hash<std::string_view>()(input) % 1024 == 0; }

}  // namespace albtpu::fuzz
