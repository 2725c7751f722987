// The sea of a file for tracing, which `albtpu-generate point --sea` compares with the response theory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "sea/sea_state.h"
#include "sea/spectra/described_sea.h"

namespace albtpu::programs {

// Directions are of the compass, in degrees. Absent members are taken from the file or assumed (described_sea.h).
struct SeaOfFile {
  std::filesystem::path file;       // of any kind that ReadSeaFile takes
  std::optional<std::string> time;  // UTC, as 2020-06-08T03:50Z; not needed if the file has one state
  std::optional<double> water_depth, wind_speed, wind_from;  // m; m/s at 10 m; degree
  TailRule tail = TailRule::kRelax;
  std::optional<double> tail_from;  // Hz
};

struct TracedSea {
  DescribedSea described;
  KnownWaves waves;  // in the frame of `described`
};

// NotFound or InvalidArgument, beginning with the path: the file cannot be read, has several places, or has no state of
// this time.
absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given);

}  // namespace albtpu::programs
