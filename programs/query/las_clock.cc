#include "programs/query/las_clock.h"

#include <algorithm>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/clocks/point_clock.h"

namespace albtpu::programs {
namespace {

using formats::kAdjustedGpsOffset;
using formats::PointClock;
using formats::PointTimeForm;
using formats::PointTimes;

constexpr double kFirstSurvey = 315e6;  // GPS time of 1990; airborne lasers have been placed by GPS since about then.

bool IsPossible(const PointTimes& times, double latest) {
  const auto& [first, last] = times.span;
  if (times.form == PointTimeForm::kWeekSeconds)
    return first >= 0 && last <= formats::kSecondsPerWeek + formats::kSecondsPerDay;
  return first + kAdjustedGpsOffset >= kFirstSurvey && last + kAdjustedGpsOffset <= latest;
}

struct Judgement {
  bool is_header_possible = false;
  bool is_after_creation = false;  // By the header's clock, the points are later than the file.
  std::vector<PointClock> others;  // That are possible.
};

Judgement Judge(const PointTimes& points, double now) {
  const std::vector<PointClock> clocks = formats::ClocksOf(points, formats::TimeFormat::kAuto);
  const auto is_possible = [&](const PointClock& clock, double latest) {
    return IsPossible(clock(points.span), latest + formats::kSecondsPerDay);
  };
  // The date of the header is that of some place, up to half a day from UTC.
  const double created =
      std::min(now, points.created.has_value() ? *points.created + formats::kSecondsPerDay / 2 : now);
  Judgement judgement;
  judgement.is_header_possible = is_possible(clocks.front(), now);
  judgement.is_after_creation = judgement.is_header_possible && !is_possible(clocks.front(), created);
  for (const double latest : {created, now}) {
    for (const PointClock& clock : clocks)
      if (clock.format != formats::TimeFormat::kAuto && is_possible(clock, latest)) judgement.others.push_back(clock);
    // Without another clock, it is the creation that is wrong.
    if (!judgement.others.empty()) break;
  }
  return judgement;
}

std::string SpanText(const PointTimes& times) {
  const double first = times.span.first + kAdjustedGpsOffset, last = times.span.last + kAdjustedGpsOffset;
  if (times.form == PointTimeForm::kWeekSeconds || !(first >= 0 && last < 1e11))
    return absl::StrFormat("%.1f to %.1f s", times.span.first, times.span.last);
  return absl::StrCat(formats::UtcText(first), " to ", formats::UtcText(last));
}

// "Unix seconds (2016-05-11T14:00:00Z to 2016-05-11T14:30:00Z; --time-format unix)"
std::string OthersText(const PointTimes& points, const std::vector<PointClock>& others) {
  return absl::StrJoin(others, " or ", [&](std::string* text, const PointClock& clock) {
    absl::StrAppend(text, clock.description, " (", SpanText(clock(points.span)), "; ", formats::TimeFormatFlag(clock),
                    ")");
  });
}

// Seconds of a day may be of seven days, and need one name.
std::vector<PointClock> OfDifferentFormats(const std::vector<PointClock>& clocks) {
  std::vector<PointClock> different;
  for (const PointClock& clock : clocks) {
    const bool is_day = clock.form == PointTimeForm::kWeekSeconds && clock.shift > 0;
    if (!is_day) different.push_back(clock);
  }
  return different;
}

}  // namespace

std::string ClockText(const PointTimes& points, double now) {
  const bool adjusted = points.form == PointTimeForm::kAdjustedStandard;
  const Judgement judgement = Judge(points, now);
  const std::vector<PointClock> others = OfDifferentFormats(judgement.others);
  std::string text =
      absl::StrCat(SpanText(points), adjusted ? ", by adjusted standard GPS time according to the header"
                                              : ", which are seconds of the GPS week according to the header");
  const bool week_seconds = points.span.first >= 0 && points.span.last <= formats::kSecondsPerWeek;
  if (judgement.is_header_possible) {
    if (!adjusted) return absl::StrCat(text, ", whose date is not known");
    if (week_seconds) return absl::StrCat(text, "; but they may be seconds of a week (--time-format week then)");
    if (!judgement.is_after_creation || others.empty()) return text;
    return absl::StrCat(text, "; the file was created before, on ", formats::UtcText(*points.created).substr(0, 10),
                        " by its header: if that is right, they are ", OthersText(points, others));
  }
  absl::StrAppend(&text, "; but ",
                  !adjusted                                     ? "no week has as many"
                  : points.span.last + kAdjustedGpsOffset > now ? "this is in the future"
                                                                : "no laser survey was flown then");
  if (others.empty()) return absl::StrCat(text, ", and they are of no known clock");
  return absl::StrCat(text, ": they ", others.size() > 1 ? "may be " : "are ", OthersText(points, others));
}

std::string ClockName(const PointTimes& points, double now) {
  const Judgement judgement = Judge(points, now);
  const std::vector<PointClock> others = OfDifferentFormats(judgement.others);
  if (!judgement.is_header_possible && others.size() == 1) return others.front().description;
  return points.form == PointTimeForm::kAdjustedStandard ? "adjusted standard GPS times" : "seconds of the GPS week";
}

}  // namespace albtpu::programs
