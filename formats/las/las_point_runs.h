// The points of a LAS or LAZ file, read front to back in runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "formats/las/las_reader.h"
#include "formats/laz/laz_points.h"

namespace albtpu::formats {

// A run of points, and neighbours that are needed to interpret them.
struct LasRun {
  std::uint64_t first = 0;          // Number in the file of the first own point.
  std::size_t before = 0, own = 0;  // Points.
  std::string records;              // Those before, the own ones, those after.
};

class LasPointRuns {
 public:
  // Each run has up to `before` points before its own, and up to `after` behind them. `reader` must outlive it. Fails
  // when the chunk table of LAZ contradicts the file. The points have at least the fields that are `wanted`.
  static absl::StatusOr<LasPointRuns> Open(const LasReader& reader, std::size_t before, std::size_t after,
                                           laz::WantedFields wanted = laz::WantedFields::kAll);

  // The next run, of at most `most` own points, into `run`, whose memory is used again. False after the last one.
  absl::StatusOr<bool> Next(std::uint64_t most, LasRun& run);

  // Once all points are read: what follows them in the file (in LAZ, them and their chunk table).
  std::uint64_t tail_begin() const;
  std::uint64_t tail_end() const;

 private:
  LasPointRuns(const LasReader& reader, std::size_t before, std::size_t after)
      : reader_(reader), before_(before), after_(after) {}
  absl::Status ReadLaz(std::uint64_t begin, std::uint64_t end, LasRun& run);

  const LasReader& reader_;
  std::size_t before_, after_;
  std::uint64_t next_ = 0;               // First own point of the next run.
  std::unique_ptr<laz::LazPoints> laz_;  // Null for LAS.
  std::string last_;                     // Records of the last run that the next one has, too.
};

// The first point. Requires that the file has one.
absl::StatusOr<std::string> FirstRecord(const LasReader& reader);

}  // namespace albtpu::formats
