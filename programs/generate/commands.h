// The commands of albtpu-generate: their options, which are checked already, and running them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "sea/sea_state.h"
#include "sea/spectra/spectral_tail.h"
#include "sea/water_index.h"
#include "tables/water/water_schema.h"

namespace albtpu::programs {

// One of `count` equal parts of the units.
struct Shard {
  int index = 0, count = 1;
};

struct TableOptions {
  std::filesystem::path campaign;
  std::filesystem::path output;  // empty with `shard`, which writes no table
  bool overwrite = false;
  std::filesystem::path work;  // a folder; empty to keep only the table
  bool resume = false;
  std::optional<Shard> shard;
};
absl::Status RunTable(const TableOptions& options);

struct MergeOptions {
  std::filesystem::path work, output;
  bool overwrite = false;
};
absl::Status RunMerge(const MergeOptions& options);

struct PlanOptions {
  std::filesystem::path campaign;
  int cores = 0;  // to print the time on, besides this machine; 0 for none
};
absl::Status RunPlan(const PlanOptions& options);

absl::Status RunKeys();

// The sea of a file for tracing. Directions are of the compass, in degrees. Absent members are taken from the file or
// assumed (described_sea.h).
struct SeaOfFile {
  std::filesystem::path file;       // of any kind that ReadSeaFile takes
  std::optional<std::string> time;  // UTC, as 2020-06-08T03:50Z; not needed if the file has one state
  std::optional<double> water_depth, wind_speed, wind_from;  // m; m/s at 10 m; degree
  TailRule tail = TailRule::kRelax;
  std::optional<double> tail_from;  // Hz
};

struct PointOptions {
  std::optional<SeaOfFile> sea;  // in place of wind, fetch and spectrum; it holds a given wind
  double wind_speed = 0;         // m/s
  double fetch = std::numeric_limits<double>::infinity();            // m
  std::string spectrum{WindSea().model->key};                        // of kSpectrumModels
  double corrected_above = std::numeric_limits<double>::infinity();  // m
  double incidence = 0;                                              // degree
  // Degrees from downwind, or from the x axis of `sea`. Without either, the worst of some directions.
  std::optional<double> azimuth;
  std::optional<double> beam_azimuth;  // degrees of the compass, of where the light travels; only with `sea`
  double footprint = 0;                // m
  std::vector<double> depth;           // m
  std::string profile = "uniform";     // or "gaussian"
  double refractive_index = kRefractiveIndex;
  double relative_error = 0.01;
  std::string estimator = "control_variate";  // or "plain"
  std::uint64_t seed = 1;
  bool json = false;
};
absl::Status RunPoint(const PointOptions& options);

struct WaterPointOptions {
  double incidence = 0;                   // degree, in air
  double kd = 0, omega0 = 0;              // In place of the next two, which the flags then set.
  double absorption = 0, scattering = 0;  // 1/m
  double backscatter_fraction = kMeanBackscatterFraction;
  double depth = 0, field_of_view = 0;  // m; the field of view may be infinite
  double pulse_length = 0;              // ns
  double footprint = 0;                 // m
  double refractive_index = 1.342, group_index = kSeaWaterGroupIndex;
  std::uint32_t photons = 1'600'000;
  std::uint64_t seed = 1;
  bool json = false;
};
absl::Status RunWaterPoint(const WaterPointOptions& options);

struct ValidateOptions {
  std::filesystem::path output;  // a folder
  bool quick = false;
  std::uint64_t seed = 1;
  bool overwrite = false;
};
absl::Status RunValidate(const ValidateOptions& options);

}  // namespace albtpu::programs
