#include "quality/crosscheck/flight_lines.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/clocks/trajectory_time.h"

namespace albtpu::quality {
namespace {

constexpr int kBitsOfSecond = 48;
constexpr std::int64_t kLatestTime = std::int64_t{1} << (kBitsOfSecond - 1);  // s
constexpr std::uint64_t kNoSecond = 0;

bool IsTime(double time) { return !formats::IsNoTime(time) && std::abs(time) < static_cast<double>(kLatestTime); }

}  // namespace

void LineTimes::Add(int id, double time) {
  const std::uint64_t second =
      IsTime(time) ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(time)) + kLatestTime) : kNoSecond;
  const std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::uint16_t>(id)) << kBitsOfSecond | second;
  if (key == last_ && !seen_.empty()) return;
  last_ = key;
  if (are_plausible()) seen_.insert(key);
  ids_.insert(id);
}

std::map<int, std::set<std::int64_t>> LineTimes::seconds() const {
  std::map<int, std::set<std::int64_t>> by_id;
  for (const int id : ids_) by_id[id];
  constexpr std::uint64_t kMask = (std::uint64_t{1} << kBitsOfSecond) - 1;
  for (const std::uint64_t key : seen_)
    if ((key & kMask) != kNoSecond)
      by_id[static_cast<int>(key >> kBitsOfSecond)].insert(static_cast<std::int64_t>(key & kMask) - kLatestTime);
  return by_id;
}

FlightLines::FlightLines(const LineTimes& times) {
  const std::map<int, std::set<std::int64_t>> by_id = times.seconds();
  size_ = by_id.size();
  if (by_id.empty()) return;
  first_id_ = by_id.begin()->first;
  if (!times.are_plausible()) return;
  std::size_t number = 0;
  for (const auto& [id, seconds] : by_id) {
    const double pause = id == 0 || by_id.size() == 1 ? kPause : kLongPause;
    auto& [first, begins] = begins_[id];
    first = static_cast<std::uint16_t>(number);
    std::int64_t before = 0;
    for (const std::int64_t second : seconds) {
      if (begins.empty() || static_cast<double>(second - before) > pause) begins.push_back(static_cast<double>(second));
      before = second;
    }
    number += std::max<std::size_t>(begins.size(), 1);
  }
  if (number == by_id.size() || number > std::numeric_limits<std::uint16_t>::max())
    begins_.clear();
  else
    size_ = number;
}

std::optional<std::uint16_t> FlightLines::NumberOf(int id, double time) const {
  if (begins_.empty()) return static_cast<std::uint16_t>(id);
  const auto found = begins_.find(id);
  if (found == begins_.end()) return std::nullopt;
  const auto& [first, begins] = found->second;
  if (begins.size() < 2) return first;
  if (!IsTime(time)) return std::nullopt;
  const auto after = std::ranges::upper_bound(begins, std::floor(time)) - begins.begin();
  return static_cast<std::uint16_t>(first + std::max<std::ptrdiff_t>(after - 1, 0));
}

FlightLine FlightLines::Line(std::uint16_t number) const {
  if (begins_.empty()) return {.id = number};
  for (const auto& [id, line] : begins_) {
    const auto& [first, begins] = line;
    const std::size_t at = number - std::size_t{first};
    if (number < first || at >= std::max<std::size_t>(begins.size(), 1)) continue;
    FlightLine found{.id = id};
    if (begins.size() > 1) found.begin = begins[at];
    return found;
  }
  return {.id = number};
}

std::string FlightLines::NothingToCompare() const {
  if (size_ > 1) {
    return absl::StrFormat(
        "no lines overlap (lines are distinguished by the point source ID, and by pauses of %g s where it is equal)",
        kPause);
  }
  return absl::StrFormat(
      "no lines overlap, or they cannot be told apart (all points have the point source ID %d, and their times have no "
      "pause of %g s)",
      first_id_, kPause);
}

std::string NameOf(const FlightLine& line) {
  return std::isnan(line.begin) ? absl::StrCat("line ", line.id)
                                : absl::StrFormat("line %d from %.0f s on", line.id, line.begin);
}

}  // namespace albtpu::quality
