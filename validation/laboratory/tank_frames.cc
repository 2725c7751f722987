#include "validation/laboratory/tank_frames.h"

#include <numbers>

namespace albtpu {
namespace {

constexpr double kFrameRate = 20;  // Hz

// The correlation of a series with itself one frame later.
double CorrelationWithNext(const Eigen::ArrayXd& sample) {
  const Eigen::Index n = sample.size();
  const Eigen::ArrayXd deviation = sample - sample.mean();
  return (deviation.head(n - 1) * deviation.tail(n - 1)).sum() / deviation.square().sum();
}

}  // namespace

DataTable LightUnderWaves(std::uint64_t seed) {
  constexpr double kBin = 0.002;  // m
  constexpr int kBins = 150;
  TankExperiment experiment;
  experiment.rays = 1'000'000;
  experiment.grid.size = 2048;  // 0.5 mm, so that single facets do not show
  const WaterOfFrame water = IndependentFrames(TankSea(2, kTankWaveHeight), experiment.grid, seed, 0);
  std::vector<double> light(kBins * kBins, 0.0);
  for (const Eigen::Vector2d& spot : LightOfFrame(experiment, water(0))) {
    const Eigen::Array2d bin = (spot.array() / kBin + 0.5 * kBins).floor();
    if ((bin < 0).any() || (bin >= kBins).any()) continue;
    light[static_cast<int>(bin.x()) * kBins + static_cast<int>(bin.y())] += 1;
  }
  DataTable table{"table_4_light",
                  "Light of one frame at the depth of the array, 2 m/s, nadir: irradiance relative to its "
                  "mean on the water",
                  {"along_wind_m", "cross_wind_m", "irradiance"},
                  {},
                  false};
  const double footprint = experiment.beams.front().footprint;
  const double rays_of_bin =
      experiment.rays * kBin * kBin / (0.25 * std::numbers::pi * footprint * footprint);
  for (int i = 0; i < kBins; ++i) {
    for (int j = 0; j < kBins; ++j) {
      table.rows.push_back({(i + 0.5 - 0.5 * kBins) * kBin, (j + 0.5 - 0.5 * kBins) * kBin,
                            light[i * kBins + j] / rays_of_bin});
    }
  }
  return table;
}

std::vector<EvolvingTank> WatchEvolvingTank(const std::vector<double>& winds, int frames,
                                            std::uint64_t seed) {
  std::vector<EvolvingTank> tanks;
  for (const double wind : winds) {
    TankExperiment experiment;
    experiment.frames = frames;
    const auto draw = static_cast<std::uint32_t>(tanks.size());
    const WaterOfFrame water =
        SuccessiveFrames(TankSea(wind, kTankWaveHeight), experiment.grid, kFrameRate, seed, draw);
    const TankReading reading = ObserveTank(experiment, water).front();
    const CentroidAngles& array = reading.arrays.front();
    tanks.push_back({wind, ScatterOf(array), ScatterOf(reading.full_beam),
                     CorrelationWithNext(array.along_wind),
                     CorrelationWithNext(reading.full_beam.along_wind)});
  }
  return tanks;
}

DataTable TableOf(const std::vector<EvolvingTank>& tanks) {
  DataTable table{
      "table_4_evolving",
      "The array at nadir under waves that evolve in time, 20 frames per second: standard errors as if "
      "frames were independent, and the correlation of each frame with the next",
      {"wind_speed_m_s", "along_wind_deg", "along_wind_standard_error_deg", "cross_wind_deg",
       "cross_wind_standard_error_deg", "full_beam_along_wind_deg", "full_beam_cross_wind_deg",
       "array_correlation_with_next_frame", "full_beam_correlation_with_next_frame"},
      {}};
  for (const EvolvingTank& t : tanks) {
    table.rows.push_back({t.wind_speed, t.array.along_wind.value, t.array.along_wind.standard_error,
                          t.array.cross_wind.value, t.array.cross_wind.standard_error,
                          t.full_beam.along_wind.value, t.full_beam.cross_wind.value, t.array_correlation,
                          t.full_beam_correlation});
  }
  return table;
}

}  // namespace albtpu
