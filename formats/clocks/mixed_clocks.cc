#include "formats/clocks/mixed_clocks.h"

#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/clocks/point_clock.h"

namespace albtpu::formats {
namespace {

using Group = TimeTally::Group;

constexpr double kOneFlight = 86400;  // s; no flight lasts longer.

// The clocks of dates in seconds. Those in milliseconds have no dates of their own: they are those of other clocks.
std::vector<PointClock> DateClocks(const TimeSpan& span) {
  std::vector<PointClock> clocks;
  for (const TimeFormat format : {TimeFormat::kAdjusted, TimeFormat::kGps, TimeFormat::kUnix})
    for (const PointClock& clock : ClocksOf({.span = span}, format)) clocks.push_back(clock);
  return clocks;
}

bool AreOfWeek(const TimeSpan& span) { return !ClocksOf({.span = span}, TimeFormat::kWeek).empty(); }

std::string Text(const Group& group, const std::string& what) {
  return absl::StrFormat("%s (%.1f to %.1f)", what, group.span.first, group.span.last);
}

std::string BothText(const Group& one, const std::string& what, const Group& other, const std::string& what_other) {
  return absl::StrCat(one.points, " points have ", Text(one, what), ", and ", other.points, " ",
                      Text(other, what_other));
}

}  // namespace

std::optional<std::string> MixedClocks(const TimeTally& tally) {
  const std::vector<Group> groups = tally.Groups();
  if (groups.size() < 2 || tally.Bulk().has_value()) return std::nullopt;
  const Group &one = groups[0], &other = groups[1];
  const std::vector<PointClock> clocks = DateClocks(one.span), clocks_of_other = DateClocks(other.span);
  for (const PointClock& clock : clocks) {
    for (const PointClock& of_other : clocks_of_other) {
      if (clock.format == of_other.format) continue;
      if (Overlap(clock(one.span).span, of_other(other.span).span) >= -kOneFlight)
        return BothText(one, clock.description, other, of_other.description);
    }
  }
  const bool is_of_week = AreOfWeek(one.span);
  const std::vector<PointClock>& dates = is_of_week ? clocks_of_other : clocks;
  if (is_of_week == AreOfWeek(other.span) || dates.empty()) return std::nullopt;
  const std::string week = MayBeOfDay(is_of_week ? one.span : other.span) ? "seconds of the GPS week or of the day"
                                                                          : "seconds of the GPS week";
  const std::string date = absl::StrJoin(
      dates, " or ", [](std::string* text, const PointClock& clock) { absl::StrAppend(text, clock.description); });
  return is_of_week ? BothText(one, week, other, date) : BothText(one, date, other, week);
}

absl::Status CheckOneClock(const std::string& name, const TimeTally& tally) {
  const std::optional<std::string> mixed = MixedClocks(tally);
  if (!mixed.has_value()) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat(name, ": its GPS times are of two clocks: ", *mixed,
                   "; write all of them by one clock, or split the file by them; if all are of one, name it by "
                   "--time-format"));
}

}  // namespace albtpu::formats
