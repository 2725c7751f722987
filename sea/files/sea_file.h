// A file of the sea of any kind that this room reads; what it is, its first line says.
#pragma once

#include <filesystem>
#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

struct SeaFileOptions {
  double anemometer_height = 10;  // m above the water, 1 to 100, of the winds in NDBC's meteorological data
};

// Reads the file, inflated if its contents are gzip's, and what belongs to it: beside NDBC's NAME.data_spec NAME.swr2
// and NAME.swdir2, beside the history's 41010w2019.txt.gz 41010k2019.txt.gz and 41010i2019.txt.gz. Errors do not name
// the file.
absl::StatusOr<SeaSeries> ReadSeaFile(const std::filesystem::path& path, const SeaFileOptions& options = {});

// The same of a text in memory, which has nothing beside it.
absl::StatusOr<SeaSeries> ReadSeaText(std::string_view text, const SeaFileOptions& options = {});

}  // namespace albtpu
