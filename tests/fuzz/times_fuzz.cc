// Arbitrary times of points: every clock by which they are read gives what it promises, and an index of spans finds
// what looking at each span finds.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "formats/clocks/dated_clock.h"
#include "formats/clocks/point_clock.h"
#include "formats/clocks/span_index.h"
#include "formats/clocks/trajectory_time.h"
#include "programs/query/las_clock.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

using namespace albtpu::formats;

// Numbers from the input, one after the other; 0 at its end.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }
  template <typename Number>
  Number Next() {
    Number number{};
    const std::size_t size = std::min(sizeof number, rest_.size());
    if (size > 0) std::memcpy(&number, rest_.data(), size);
    rest_.remove_prefix(size);
    return number;
  }
  // Half of them near what times are: of the week, adjusted, since 1980, Unix, in milliseconds.
  double Time() {
    constexpr double kUsual[] = {0, 302400, 604799, 1.5e8, 1.15e9, 1.463e9, 3.024e8, 1.463e12};
    const auto kind = Next<std::uint8_t>();
    if (kind % 2 == 0) return Next<double>();
    return kUsual[kind / 2 % 8] + Next<std::int16_t>();
  }
  TimeSpan Span() {
    const double first = Time(), length = Length();
    return {first, first + length};
  }

 private:
  double Length() { return std::abs(static_cast<double>(Next<std::int32_t>())) / 1000; }
  std::string_view rest_;
};

PointTimes TimesOf(Numbers& numbers) {
  PointTimes points;
  points.span = numbers.Span();
  const auto form = numbers.Next<std::uint8_t>();
  points.form = form % 2 == 0 ? PointTimeForm::kWeekSeconds : PointTimeForm::kAdjustedStandard;
  points.created = GpsTimeOfDay(numbers.Next<std::uint16_t>() % 3000, form % 400);
  return points;
}

// The header's clock comes first where none is named, and the others differ from each other.
void CheckClocks(const PointTimes& points, TimeFormat format) {
  const std::vector<PointClock> clocks = ClocksOf(points, format);
  ALBTPU_MUST(format != TimeFormat::kAuto || (!clocks.empty() && !clocks.front().changes_times()));
  for (std::size_t i = 0; i < clocks.size(); ++i) {
    ALBTPU_MUST(std::isfinite(clocks[i].scale) && std::isfinite(clocks[i].shift) && clocks[i].scale > 0);
    ALBTPU_MUST(format == TimeFormat::kAuto || clocks[i].format == format);
    for (std::size_t j = 0; j < i; ++j)
      ALBTPU_MUST(clocks[i].scale != clocks[j].scale || clocks[i].shift != clocks[j].shift ||
                  clocks[i].form != clocks[j].form);
  }
}

void ClocksTarget(std::string_view input) {
  Numbers numbers(input);
  const PointTimes points = TimesOf(numbers);
  const auto format = static_cast<TimeFormat>(numbers.Next<std::uint8_t>() % kTimeFormatNames.size());
  CheckClocks(points, format);
  if (!std::isfinite(points.span.first) || !std::isfinite(points.span.last)) return;
  ALBTPU_MUST(programs::ClockText(points, 1.4e9).find('\n') == std::string::npos);
  ALBTPU_MUST(!programs::ClockName(points, 1.4e9).empty());
  // What is known has dates of a century.
  const double begin = std::fmod(std::abs(static_cast<double>(numbers.Next<std::int32_t>())), 1.3e9);
  const TimeSpan known = {begin, begin + numbers.Next<std::uint16_t>() * 60.0};
  std::string note;
  const auto dated = FindDatedClock(points, {.format = format}, known, "known", note);
  ALBTPU_MUST(note.empty() || (dated.ok() && dated->has_value()));
  if (!dated.ok()) ALBTPU_MUST(dated.status().message().size() > 10);
  if (dated.ok() && dated->has_value()) {
    const TimeSpan span = {(**dated)(points.span.first), (**dated)(points.span.last)};
    ALBTPU_MUST(2 * Overlap(span, known) >= (span.last - span.first) * (1 - 1e-9) - 1e-3);
  }
  const TimeSpan utc = {UtcOfGps(known.first + kAdjustedGpsOffset), UtcOfGps(known.last + kAdjustedGpsOffset)};
  const absl::StatusOr<UtcClock> clock = FindUtcClock("file", points, {.format = format}, utc, "known", note);
  if (!clock.ok()) {
    ALBTPU_MUST(absl::StartsWith(clock.status().message(), "file: "));
    return;
  }
  const TimeSpan span = {(*clock)(points.span.first), (*clock)(points.span.last)};
  ALBTPU_MUST(Overlap(span, utc) >= -20);  // Leap seconds may lie between the points and what is known.
}

void SpanIndexTarget(std::string_view input) {
  Numbers numbers(input);
  const TimeSpan times = numbers.Span();
  std::vector<TimeSpan> spans;
  while (!numbers.empty() && spans.size() < 64) {
    const TimeSpan span = numbers.Span();
    if (span.first <= span.last) spans.push_back(span);
  }
  if (!(times.first <= times.last)) return;
  const SpanIndex index(spans);
  ALBTPU_MUST(index.empty() == spans.empty());
  std::vector<std::size_t> found, expected;
  index.Find(times, found);
  for (std::size_t i = 0; i < spans.size(); ++i)
    if (spans[i].first <= times.last && spans[i].last >= times.first) expected.push_back(i);
  std::sort(found.begin(), found.end());
  ALBTPU_MUST(found == expected);
}

}  // namespace

const std::vector<Target> kTargets = {{"clocks", ClocksTarget}, {"span_index", SpanIndexTarget}};

}  // namespace albtpu::fuzz
