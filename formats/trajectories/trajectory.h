// A trajectory of any format: position, velocity and attitude at increasing times.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace albtpu::formats {

inline constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

// The reference point of the navigation system, and how the body of the system is turned. Position and time are always
// finite; what the format does not state is kNotStated.
struct TrajectoryRecord {
  double time = 0;                     // s, as Trajectory::TimeAt.
  double latitude = 0, longitude = 0;  // rad, geodetic, north and east positive.
  double height = 0;                   // m above the ellipsoid.
  double velocity_north = kNotStated;  // m/s
  double velocity_east = kNotStated;   // m/s
  double velocity_up = kNotStated;     // m/s
  double roll = kNotStated;            // rad, right side down positive.
  double pitch = kNotStated;           // rad, nose up positive.
  double heading = kNotStated;         // rad, of the nose, clockwise from true north; any turn.
  // rad/s, about the axes of the body: forward, right, down.
  double rate_forward = kNotStated, rate_right = kNotStated, rate_down = kNotStated;
};

// Standard deviations of a record, from an error file (SMRMSG) or from columns of an ASCII trajectory.
struct TrajectorySigma {
  double north = kNotStated, east = kNotStated, down = kNotStated;                             // m
  double velocity_north = kNotStated, velocity_east = kNotStated, velocity_down = kNotStated;  // m/s
  double roll = kNotStated, pitch = kNotStated, heading = kNotStated;                          // rad
};
// In the order of an SMRMSG.
inline constexpr std::array kSigmaFields = {
    &TrajectorySigma::north,          &TrajectorySigma::east,          &TrajectorySigma::down,
    &TrajectorySigma::velocity_north, &TrajectorySigma::velocity_east, &TrajectorySigma::velocity_down,
    &TrajectorySigma::roll,           &TrajectorySigma::pitch,         &TrajectorySigma::heading};

// The first of the records `begin` to `end` - 1 at or after `time`, or `end`. `time_at(record)` increases.
template <typename TimeAt>
std::size_t FirstRecordFrom(std::size_t begin, std::size_t end, double time, const TimeAt& time_at) {
  while (begin < end) {
    const std::size_t middle = begin + (end - begin) / 2;
    if (time_at(middle) < time)
      begin = middle + 1;
    else
      end = middle;
  }
  return begin;
}

// An opened and checked file: at least two records, finite positions, times that increase. Immutable: any number of
// threads may read it at a time.
class Trajectory {
 public:
  virtual ~Trajectory() = default;

  // The path, for messages.
  const std::string& name() const { return name_; }

  // The format, for people: "SBET".
  const std::string& format() const { return format_; }

  // Number of records, at least 2.
  virtual std::size_t size() const = 0;

  // s, strictly increasing. Seconds of the GPS week in which the file begins (in GPS or UTC, which no file says), or
  // whatever absolute form the file has. A week that ends does not matter: times continue beyond 604 800 s, also where
  // the file starts again from 0.
  virtual double TimeAt(std::size_t record) const = 0;

  virtual TrajectoryRecord Record(std::size_t record) const = 0;

  // Whether velocities are stated, or derived from positions where they should be.
  virtual bool states_velocities() const { return true; }

  // What was repaired in reading the file, a line for the user; empty where nothing was.
  const std::string& remark() const { return remark_; }

  // nullopt: the file states none.
  virtual std::optional<TrajectorySigma> SigmaAt(std::size_t) const { return std::nullopt; }

 protected:
  Trajectory(std::string name, std::string format) : name_(std::move(name)), format_(std::move(format)) {}
  void set_remark(std::string remark) { remark_ = std::move(remark); }

 private:
  std::string name_, format_, remark_;
};

// The formats, detected by the content of the file (OpenTrajectory, trajectory_files.h): SbetFile::Open(path) in
// sbet_file.h, AsciiTrajectory::Open(path) in ascii_trajectory.h. Both check what they open. Both give
// absl::StatusOr<std::unique_ptr<...>>. ascii_motion.h compares velocities with differences of position.

}  // namespace albtpu::formats
