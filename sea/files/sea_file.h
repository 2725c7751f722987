// Reads a file of the sea in any format of this room. The first line shows the format.
#pragma once

#include <filesystem>
#include <string_view>

#include "absl/status/statusor.h"
#include "sea/files/sea_series.h"

namespace albtpu {

struct SeaFileOptions {
  double anemometer_height = 10;  // m above the water, 1 to 100, of the winds in NDBC's meteorological data
};

// Reads the file, compressed by gzip or not, and the files beside it that belong to it: with NDBC's NAME.data_spec,
// NAME.swr2 and NAME.swdir2; with 41010w2019.txt.gz of the history, 41010k2019.txt.gz and 41010i2019.txt.gz. Errors do
// not name `path`.
absl::StatusOr<SeaSeries> ReadSeaFile(const std::filesystem::path& path, const SeaFileOptions& options = {});

// The same for a text in memory, without files beside it.
absl::StatusOr<SeaSeries> ReadSeaText(std::string_view text, const SeaFileOptions& options = {});

}  // namespace albtpu
