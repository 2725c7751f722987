// The flight lines of a survey: points of one point source ID. Where one ID stands for several lines, they begin after
// gaps in time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace albtpu::quality {

// The seconds in which there are points of each point source ID, whatever their order.
class LineTimes {
 public:
  // `time` in s. One that is 0 or not finite is none.
  void Add(int id, double time);

  // By ID, in order; empty where no point of it has a time.
  std::map<int, std::set<std::int64_t>> seconds() const;

  // False where times are so many and so scattered that they are no times of flight lines.
  bool are_plausible() const { return seen_.size() < kMostSeconds; }

 private:
  static constexpr std::size_t kMostSeconds = 2'000'000;  // Three weeks.

  std::unordered_set<std::uint64_t> seen_;  // An ID in the upper 16 bits, a second in the others.
  std::uint64_t last_ = 0;
  std::set<int> ids_;
};

struct FlightLine {
  int id = 0;                                               // Point source ID.
  double begin = std::numeric_limits<double>::quiet_NaN();  // GPS time, s, where the ID stands for several lines.
};

class FlightLines {
 public:
  // A scanner that looks ahead and back sees a place twice in 15 s at most (600 m, 30 m/s, 20 degrees); a turn takes
  // longer. ID 0 means that none was assigned, and a single ID distinguishes nothing. Where there are several, one that
  // is used again after a while stands for another flight.
  static constexpr double kPause = 20, kLongPause = 600;  // s, to a second.

  FlightLines() = default;
  explicit FlightLines(const LineTimes& times);

  std::size_t size() const { return size_; }

  // A number of the line that is equal for its points and rises with ID and time. It is the ID where no ID stands for
  // several lines. Absent where the ID does, and the point has no time.
  std::optional<std::uint16_t> NumberOf(int id, double time) const;

  FlightLine Line(std::uint16_t number) const;

  // Why no two lines could be compared, as "no lines overlap (...)".
  std::string NothingToCompare() const;

 private:
  std::map<int, std::pair<std::uint16_t, std::vector<double>>> begins_;  // First number and begins; empty: not split.
  std::size_t size_ = 0;
  int first_id_ = 0;
};

// "line 3", or "line 0 from 147532417 s on".
std::string NameOf(const FlightLine& line);

}  // namespace albtpu::quality
