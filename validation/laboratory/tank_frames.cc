#include "validation/laboratory/tank_frames.h"

#include <numbers>
#include <utility>

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
  const double rays_of_bin = experiment.rays * kBin * kBin / (0.25 * std::numbers::pi * footprint * footprint);
  for (int i = 0; i < kBins; ++i) {
    for (int j = 0; j < kBins; ++j) {
      table.Add((i + 0.5 - 0.5 * kBins) * kBin, (j + 0.5 - 0.5 * kBins) * kBin, light[i * kBins + j] / rays_of_bin);
    }
  }
  return table;
}

std::vector<EvolvingTank> WatchEvolvingTank(const std::vector<double>& winds, int frames, std::uint64_t seed) {
  std::vector<EvolvingTank> tanks;
  for (const double wind : winds) {
    TankExperiment experiment;
    experiment.frames = frames;
    const auto draw = static_cast<std::uint32_t>(tanks.size());
    const WaterOfFrame water =
        SuccessiveFrames(TankSea(wind, kTankWaveHeight), experiment.grid, kFrameRate, seed, draw);
    const TankReading reading = ObserveTank(experiment, water).front();
    const CentroidAngles& array = reading.arrays.front();
    tanks.push_back({wind, ScatterOf(array), ScatterOf(reading.full_beam), CorrelationWithNext(array.along_wind),
                     CorrelationWithNext(reading.full_beam.along_wind)});
  }
  return tanks;
}

DataTable TableOf(const std::vector<EvolvingTank>& tanks) {
  DataTable table{"table_4_evolving",
                  "The array at nadir under waves that evolve in time, 20 frames per second: standard errors as if "
                  "frames were independent, and the correlation of each frame with the next",
                  {"wind_speed_m_s", "along_wind_deg", "along_wind_standard_error_deg", "cross_wind_deg",
                   "cross_wind_standard_error_deg", "full_beam_along_wind_deg", "full_beam_cross_wind_deg",
                   "array_correlation_with_next_frame", "full_beam_correlation_with_next_frame"}};
  for (const EvolvingTank& t : tanks) {
    table.Add(t.wind_speed, t.array.along_wind, t.array.cross_wind, t.full_beam.along_wind.value,
              t.full_beam.cross_wind.value, t.array_correlation, t.full_beam_correlation);
  }
  return table;
}

namespace {

constexpr double kLightWind = 2;  // m/s
constexpr double kStrongWind = 5.25;
constexpr double kSide = 0.3;  // m, of the array: detectors times pitch

// One of several arrays under the same light.
struct VariedArray {
  std::string parameter;
  double value;
  PhotodiodeArrayOptions array;
};

std::vector<VariedArray> Apertures(const std::string& parameter) {
  std::vector<VariedArray> varied;
  for (const double centimetres : {0.4, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0, 5.0})
    varied.push_back({parameter, centimetres, {.aperture = centimetres / 100}});
  return varied;
}

std::vector<VariedArray> PitchesAndDetectors() {
  std::vector<VariedArray> varied;
  for (const double centimetres : {2.0, 3.0, 4.0, 5.0})
    varied.push_back({"pitch of 6 x 6 detectors (cm)", centimetres, {.pitch = centimetres / 100}});
  for (const int per_side : {3, 6, 10, 15, 30}) {
    varied.push_back(
        {"detectors along 0.30 m", static_cast<double>(per_side), {.per_side = per_side, .pitch = kSide / per_side}});
  }
  return varied;
}

// Runs experiments and collects their results. Experiments with the same `draw` see the same random waves.
class Variations {
 public:
  Variations(int frames, std::uint64_t seed) : frames_(frames), seed_(seed) {}

  void Run(TankExperiment experiment, const SeaState& sea, const std::vector<VariedArray>& varied,
           std::uint32_t draw = 0) {
    experiment.frames = frames_;
    experiment.arrays.clear();
    for (const VariedArray& v : varied) experiment.arrays.push_back(v.array);
    const TankReading reading = ObserveTank(experiment, IndependentFrames(sea, experiment.grid, seed_, draw)).front();
    for (std::size_t i = 0; i < varied.size(); ++i) {
      found_.push_back(
          {varied[i].parameter, varied[i].value, ScatterOf(reading.arrays[i]), ScatterOf(reading.full_beam)});
    }
  }
  void Run(const TankExperiment& experiment, const SeaState& sea, const std::string& parameter, double value,
           std::uint32_t draw = 0) {
    Run(experiment, sea, {{parameter, value, {}}}, draw);
  }

  std::vector<TankVariation> Take() { return std::move(found_); }

 private:
  int frames_;
  std::uint64_t seed_;
  std::vector<TankVariation> found_;
};

}  // namespace

std::vector<TankVariation> TankSensitivity(bool quick, int frames, std::uint64_t seed) {
  const SeaState sea = TankSea(kLightWind, kTankWaveHeight);
  Variations variations(frames, seed);

  std::vector<VariedArray> arrays = Apertures("aperture (cm)");
  for (VariedArray& varied : PitchesAndDetectors()) arrays.push_back(std::move(varied));
  variations.Run(TankExperiment(), sea, arrays);

  TankExperiment gaussian;
  gaussian.beams.front().profile = BeamProfile::kGaussian;
  variations.Run(gaussian, sea, Apertures("aperture, gaussian beam (cm)"));

  for (const double wind : {kLightWind, kStrongWind}) {
    variations.Run(TankExperiment(), TankSea(wind, UnscaledTankWaveHeight(wind)),
                   "wind, waves of the spectrum's own height (m/s)", wind);
  }
  const std::vector<double> heights =
      quick ? std::vector<double>{3, 5, 11} : std::vector<double>{1.6, 2, 3, 4, 5, 6.5, 8, 9, 11};
  for (const double millimetres : heights) {
    variations.Run(TankExperiment(), TankSea(kLightWind, millimetres / 1000), "wave height, 2 m/s (mm)", millimetres);
    if (quick) continue;
    variations.Run(TankExperiment(), TankSea(kStrongWind, millimetres / 1000), "wave height, 5.25 m/s (mm)",
                   millimetres);
  }
  for (const int rays : quick ? std::vector<int>{10000} : std::vector<int>{10000, 20000, 160000}) {
    TankExperiment experiment;
    experiment.rays = rays;
    variations.Run(experiment, sea, "rays", rays);
  }
  if (!quick) {
    for (const int size : {256, 1024, 2048}) {
      TankExperiment experiment;
      experiment.grid.size = size;
      variations.Run(experiment, sea, "grid (mm)", 1000 * experiment.grid.length / size);
    }
    TankExperiment wide;
    wide.grid = {2 * wide.grid.length, 2 * wide.grid.size};
    variations.Run(wide, sea, "side of the patch (m)", wide.grid.length);
    for (const std::uint32_t draw : {1, 2, 3}) variations.Run(TankExperiment(), sea, "other waves", draw, draw);
  }
  return variations.Take();
}

DataTable TableOf(const std::vector<TankVariation>& variations) {
  DataTable table{"table_4_sensitivity",
                  "The array at nadir, 2 m/s, wave height 9 mm, with one parameter changed at a time",
                  {"parameter", "value", "along_wind_deg", "along_wind_standard_error_deg", "cross_wind_deg",
                   "cross_wind_standard_error_deg", "full_beam_along_wind_deg"}};
  for (const TankVariation& v : variations) {
    table.Add(v.parameter, v.value, v.array.along_wind, v.array.cross_wind, v.full_beam.along_wind.value);
  }
  return table;
}

}  // namespace albtpu
