// An SBET file (smoothed best estimate of trajectory, Applanix POSPac): records of 17 little-endian doubles without a
// header. The file is mapped, not copied: five hours at 200 Hz are 490 MB.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "absl/status/statusor.h"
#include "formats/files/mapped_file.h"
#include "formats/trajectories/gps_time.h"
#include "formats/trajectories/sbet_record.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

class SbetFile : public Trajectory {
 public:
  // Maps the file and checks every record: its numbers are finite, latitude and longitude are angles on the globe, the
  // height lies between -1 and 20 km, roll and pitch are below 90 degrees, times are not negative and increase. At the
  // end of the GPS week they may continue beyond 604 800 s or start again from 0. Then compares velocities with
  // differences of position (velocity_check.h) and headings with courses. An error names the cause where exchanging
  // fields, units or the wander angle explains it. Reading every record takes about as long as reading the file from
  // the disk, and 0.1 s for 490 MB that are in memory.
  static absl::StatusOr<std::unique_ptr<SbetFile>> Open(const std::filesystem::path& path);

  // The same for an open file, or for memory that is aligned for doubles. `name` is for messages.
  static absl::StatusOr<std::unique_ptr<SbetFile>> Parse(const std::string& name, MappedFile file);

  std::size_t size() const override { return records_.size(); }
  double TimeAt(std::size_t record) const override {
    return records_[record].time + (record >= next_week_ ? kSecondsPerWeek : 0);
  }
  TrajectoryRecord Record(std::size_t record) const override;

  // The records as they are in the file, with accelerations and rates.
  std::span<const SbetRecord> records() const { return records_; }

 private:
  SbetFile(std::string name, MappedFile file);
  absl::Status CheckRecords();

  MappedFile file_;
  std::span<const SbetRecord> records_;
  std::size_t next_week_;  // The first record after the time started again from 0; size() if it did not.
};

}  // namespace albtpu::formats
