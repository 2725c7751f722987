// A sea from a file for tracing: the settings of the user, and the sea that was read.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "sea/spectra/described_sea.h"
#include "sea/wave_state.h"
#include "tables/provenance.h"

namespace albtpu {

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
  std::map<std::string, AttributeValue>
      attributes;      // sea_attributes.h, and the name of the file and the time
  std::string digest;  // SHA-256 of the spectrum: equal digests give equal results
};

// NotFound or InvalidArgument, beginning with the path: the file cannot be read, has several places, or has no state of
// this time.
absl::StatusOr<TracedSea> ReadTracedSea(const SeaOfFile& given);

}  // namespace albtpu
