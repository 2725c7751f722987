// Samples of points, by which files with the same points are noticed: copies of a flight line, tiles with buffers.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "formats/las/las_header.h"
#include "formats/las/las_points.h"

namespace albtpu::quality {

// Points of a file that are chosen by their times alone, or by x where they have none: two files with the same points
// have the same sample, whatever the order of their points, their classes and heights and their format are, and the
// samples of a file and of a part of it have points in common.
class PointSample {
 public:
  struct Point {
    std::uint64_t rank;  // Random, but a function of the time.
    double x, y, z;
    bool has_time;
  };

  // Withheld points are in the sample if they are used.
  PointSample(const formats::LasHeader& header, bool use_withheld)
      : fields_(header), record_length_(header.record_length), steps_(header.scale), use_withheld_(use_withheld) {}

  // Those of some records that may be in the sample. By any thread.
  std::vector<Point> Choose(std::string_view records) const;
  // Adds them. By one thread at a time.
  void Add(const std::vector<Point>& chosen);

  // Of the points that both samples could have, the share that both have, of the file with fewer of them: at the same
  // times and places, and those of them that have a time and the same height, too. 0 if there are too few to judge.
  struct Common {
    double share = 0, identical = 0;
  };
  static Common CommonOf(const PointSample& a, const PointSample& b);

 private:
  formats::LasPointFields fields_;
  std::size_t record_length_;
  std::array<double, 3> steps_;  // Of coordinates.
  bool use_withheld_;
  std::atomic<std::uint64_t> limit_ = UINT64_MAX;  // All points of lower rank are in the sample.
  std::vector<Point> points_;
};

// The files of a run.
class SampledFiles {
 public:
  // Fails where a file has points of another one. By any thread, and again for the same file.
  absl::Status Add(const std::filesystem::path& path, std::shared_ptr<const PointSample> sample);

 private:
  std::mutex mutex_;
  std::map<std::filesystem::path, std::shared_ptr<const PointSample>> samples_;
};

}  // namespace albtpu::quality
