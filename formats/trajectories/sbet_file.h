// The files of Applanix's post-processing: the trajectory (SBET) and its standard deviations (SMRMSG).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/files/file_access.h"
#include "formats/trajectories/sbet_record.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

// An SBET file (smoothed best estimate of trajectory, Applanix POSPac): records of 17 little-endian doubles without a
// header. The file is mapped, not copied: five hours at 200 Hz are 490 MB.
class SbetFile : public Trajectory {
 public:
  // Maps the file and checks every record: its numbers are finite, latitude and longitude are angles on the globe, the
  // height lies between -1 and 20 km, roll and pitch are below 90 degrees, times are not negative and increase. At the
  // end of the GPS week they may continue beyond 604 800 s or start again from 0. Then compares velocities with
  // differences of position (ascii_motion.h) and headings with courses. An error names the cause where exchanging
  // fields, units or the wander angle explains it. Reading every record takes about as long as reading the file from
  // the disk, and 0.1 s for 490 MB that are in memory. Velocities along other axes than the format says are turned, and
  // velocities that are left out are derived from the positions (FindVelocityFrame); remark() says so.
  static absl::StatusOr<std::unique_ptr<SbetFile>> Open(const std::filesystem::path& path,
                                                        VelocityAxes axes = VelocityAxes::kAuto);

  // The same for an open file, or for memory that is aligned for doubles. `name` is for messages.
  static absl::StatusOr<std::unique_ptr<SbetFile>> Parse(const std::string& name, MappedFile file,
                                                         VelocityAxes axes = VelocityAxes::kAuto);

  std::size_t size() const override { return records_.size(); }
  double TimeAt(std::size_t record) const override {
    return records_[record].time + (record >= next_week_ ? kSecondsPerWeek : 0);
  }
  TrajectoryRecord Record(std::size_t record) const override;
  bool states_velocities() const override { return frame_ != VelocityFrame::kNone; }
  VelocityFrame velocity_frame() const { return frame_; }

  // The records as they are in the file, with accelerations and rates.
  std::span<const SbetRecord> records() const { return records_; }

 private:
  SbetFile(std::string name, MappedFile file);
  absl::Status CheckRecords(VelocityAxes axes);
  void DeriveVelocity(std::size_t record, TrajectoryRecord& result) const;

  MappedFile file_;
  std::span<const SbetRecord> records_;
  std::size_t next_week_;  // The first record after the time started again from 0; size() if it did not.
  VelocityFrame frame_ = VelocityFrame::kWander;
};

// An error file of Applanix's post-processing (SMRMSG): the standard deviations of an SBET, mostly once a second.
//
// Records of ten little-endian doubles, 80 bytes, without a header: time [s], sigma of the position north, east and
// down [m], of the velocity north, east and down [m/s], of roll, pitch and heading [arc-minutes, 1/60 degree].

// An opened and checked file: at least one record, times that increase, sigmas that are finite, not negative and
// plausible (CheckSigmaUnits). Immutable: any number of threads may read it at a time.
class SmrmsgFile {
 public:
  static constexpr std::size_t kRecordSize = 80;

  // s. Between records further apart than this, no sigma is interpolated.
  static constexpr double kLongestGap = 10;

  static absl::StatusOr<SmrmsgFile> Open(const std::filesystem::path& path);

  // The same for bytes in memory, which must outlive the file. `name` is for messages.
  static absl::StatusOr<SmrmsgFile> Parse(std::string name, std::string_view bytes);

  // Whether the first records can be those of an SMRMSG; those of an SBET or of a text cannot.
  static bool Recognizes(std::string_view bytes);

  const std::string& name() const { return name_; }
  std::size_t size() const { return bytes_.size() / kRecordSize; }

  // s, strictly increasing, in the scale of the SBET: seconds of the GPS week in which the file begins. Times continue
  // beyond 604 800 s, also where the file starts again from 0.
  double TimeAt(std::size_t record) const;

  TrajectorySigma SigmaOf(std::size_t record) const;

  // Linear between the two records around `time`. nullopt before the first and after the last record, and in a gap:
  // sigmas grow where the navigation lost its satellites, so nothing is extrapolated.
  std::optional<TrajectorySigma> SigmaAt(double time) const;

 private:
  SmrmsgFile(std::string name, std::string_view bytes) : name_(std::move(name)), bytes_(bytes) {}
  double Number(std::size_t record, std::size_t field) const;
  absl::Status Check();
  absl::Status CheckSigmas(std::size_t record) const;

  std::string name_;
  std::optional<MappedFile> file_;
  std::string_view bytes_;
  std::size_t next_week_ = 0;  // The first record after the end of the week, if the file starts again from 0 there.
};

}  // namespace albtpu::formats
