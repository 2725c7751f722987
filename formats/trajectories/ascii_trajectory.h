// A trajectory as text: one line a record, of the columns in ascii_columns.h, separated by blanks, tabs, commas or
// semicolons. Beside semicolons, and beside blanks where only so the columns are a layout, commas are decimal marks.
// Lines above the numbers that do not begin with a number are a header.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/trajectories/ascii_motion.h"
#include "formats/trajectories/trajectory.h"

namespace albtpu::formats {

class AsciiTrajectory : public Trajectory {
 public:
  // Reads and checks the file. Its errors name line and column. A file whose motion is not that of an aircraft is
  // refused (CheckMotion): angles in radians, latitude and longitude exchanged.
  static absl::StatusOr<std::unique_ptr<AsciiTrajectory>> Open(const std::filesystem::path& path);

  // The same for text in memory. `name` is for messages.
  static absl::StatusOr<std::unique_ptr<AsciiTrajectory>> Parse(std::string name, std::string_view text);

  // Whether a file may be such a text rather than a binary format.
  static bool Recognizes(std::string_view bytes);

  // Whether the first line of numbers of a text has as many columns as a trajectory.
  static bool HasRecords(std::string_view text);

  std::size_t columns() const { return columns_; }  // 15 or 20.

  std::size_t size() const override { return lines_.size(); }
  double TimeAt(std::size_t record) const override { return lines_[record].time; }
  TrajectoryRecord Record(std::size_t record) const override;
  // Those of position or attitude are not stated where their columns are 0 in all lines.
  std::optional<TrajectorySigma> SigmaAt(std::size_t record) const override;

  // X and Y of a record, to be compared with the projected position: another map frame (such as the neighbouring UTM
  // zone) is a mistake. nullopt if the file has zeros instead.
  std::optional<GridPosition> GridPositionAt(std::size_t record) const;

  // A line as it is kept, in m, rad and s; 96 bytes. Sigmas in single precision: none is known to 1e-7 of itself.
  struct Line {
    double time, longitude, latitude, x, y, height, roll, pitch, heading;
    float sigma_x, sigma_y, sigma_z, sigma_roll, sigma_pitch, sigma_heading;
  };

 private:
  AsciiTrajectory(std::string name, std::size_t columns) : Trajectory(std::move(name), "ASCII"), columns_(columns) {}

  std::size_t columns_;
  std::vector<Line> lines_;
  std::vector<std::array<double, 3>> velocities_;  // North, east, up, m/s; empty without such columns.
  // A number other than 0 in these columns.
  bool has_grid_ = false, has_position_sigma_ = false, has_attitude_sigma_ = false;

  friend class AsciiReader;
};

}  // namespace albtpu::formats
