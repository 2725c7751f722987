#include "formats/clocks/gps_time.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

#include "absl/strings/str_format.h"

namespace albtpu::formats {
namespace {

using std::chrono::sys_days;
using std::chrono::year;

constexpr sys_days kEpoch = year{1980} / 1 / 6;

constexpr double SinceEpoch(sys_days day) { return static_cast<double>((day - kEpoch).count()) * kSecondsPerDay; }

// The days with which a leap second took effect since GPS time began (IERS, leap-seconds.list).
constexpr std::array kLeapDays = {
    sys_days{year{1981} / 7 / 1}, sys_days{year{1982} / 7 / 1}, sys_days{year{1983} / 7 / 1},
    sys_days{year{1985} / 7 / 1}, sys_days{year{1988} / 1 / 1}, sys_days{year{1990} / 1 / 1},
    sys_days{year{1991} / 1 / 1}, sys_days{year{1992} / 7 / 1}, sys_days{year{1993} / 7 / 1},
    sys_days{year{1994} / 7 / 1}, sys_days{year{1996} / 1 / 1}, sys_days{year{1997} / 7 / 1},
    sys_days{year{1999} / 1 / 1}, sys_days{year{2006} / 1 / 1}, sys_days{year{2009} / 1 / 1},
    sys_days{year{2012} / 7 / 1}, sys_days{year{2015} / 7 / 1}, sys_days{year{2017} / 1 / 1}};

// Reads parts of a fixed number of digits from the front of a text.
class Digits {
 public:
  explicit Digits(std::string_view text) : rest_(text) {}

  // A number of `count` digits, at most `most`; fails at anything else.
  int Number(std::size_t count, int most) {
    int number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (rest_.empty() || rest_.front() < '0' || rest_.front() > '9') return Fail();
      number = 10 * number + (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return number <= most ? number : Fail();
  }

  // One of the characters.
  void Expect(std::string_view characters) {
    if (rest_.empty() || characters.find(rest_.front()) == std::string_view::npos)
      Fail();
    else
      rest_.remove_prefix(1);
  }

  bool Next(char character) const { return !rest_.empty() && rest_.front() == character; }

  // `.5` and the like; 0 where no point follows.
  double Fraction() {
    double fraction = 0;
    if (!Next('.')) return fraction;
    const auto [end, error] =
        std::from_chars(rest_.data(), rest_.data() + rest_.size(), fraction, std::chars_format::fixed);
    if (error != std::errc()) return Fail();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return fraction;
  }

  bool ok() const { return ok_; }
  bool at_end() const { return rest_.empty(); }

 private:
  int Fail() {
    ok_ = false;
    return 0;
  }

  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace

int LeapSecondsAtUtc(double utc) {
  const auto passed =
      std::count_if(kLeapDays.begin(), kLeapDays.end(), [&](sys_days day) { return SinceEpoch(day) <= utc; });
  return static_cast<int>(passed);
}

std::optional<double> ParseUtc(std::string_view text) {
  Digits digits(text);
  const int years = digits.Number(4, 9999);
  digits.Expect("-");
  const int months = digits.Number(2, 12);
  digits.Expect("-");
  const int days = digits.Number(2, 31);
  digits.Expect("T ");
  const int hours = digits.Number(2, 23);
  digits.Expect(":");
  const int minutes = digits.Number(2, 59);
  int seconds = 0;
  double fraction = 0;
  if (digits.Next(':')) {
    digits.Expect(":");
    seconds = digits.Number(2, 59);
    fraction = digits.Fraction();
  }
  digits.Expect("Z");
  const std::chrono::year_month_day date(year{years}, std::chrono::month(static_cast<unsigned>(months)),
                                         std::chrono::day(static_cast<unsigned>(days)));
  if (!digits.ok() || !digits.at_end() || !date.ok() || sys_days(date) < kEpoch) return std::nullopt;
  const double utc = SinceEpoch(sys_days(date)) + (hours * 60 + minutes) * 60 + seconds + fraction;
  return utc + LeapSecondsAtUtc(utc);
}

std::string UtcText(double gps_time) {
  // A leap second itself is written as the second after it.
  double utc = std::floor(gps_time);
  for (int leap = static_cast<int>(kLeapDays.size()); leap >= 0; --leap) {
    if (LeapSecondsAtUtc(std::floor(gps_time) - leap) < leap) continue;
    utc = std::floor(gps_time) - leap;
    break;
  }
  const double day = std::floor(utc / kSecondsPerDay);
  const std::chrono::year_month_day date(kEpoch + std::chrono::days(static_cast<int>(day)));
  const int second = static_cast<int>(utc - day * kSecondsPerDay);
  return absl::StrFormat("%04d-%02d-%02dT%02d:%02d:%02dZ", static_cast<int>(date.year()),
                         static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), second / 3600,
                         second / 60 % 60, second % 60);
}

std::string InstantText(double gps_time) {
  return gps_time >= 0 && gps_time < kLastText ? UtcText(gps_time) : "a time before 1980";
}

std::string DateText(double gps_time) {
  return gps_time >= 0 && gps_time < kLastText ? UtcText(gps_time).substr(0, 10) : "a date before 1980";
}

// Within the leap second itself either side of it is right enough.
int GpsMinusUtc(double gps) { return LeapSecondsAtUtc(gps - LeapSecondsAtUtc(gps)); }

double UtcOfGps(double gps) { return gps - GpsMinusUtc(gps) + kGpsEpoch; }

double GpsOfUtc(double utc) { return utc - kGpsEpoch + LeapSecondsAtUtc(utc - kGpsEpoch); }

std::optional<double> GpsTimeOfDay(int year_number, int day_of_year) {
  const year of(year_number);
  if (year_number < 1990 || year_number > 2100 || day_of_year < 1 || day_of_year > (of.is_leap() ? 366 : 365))
    return std::nullopt;
  const double utc = SinceEpoch(sys_days(of / 1 / 1) + std::chrono::days(day_of_year - 1));
  return utc + LeapSecondsAtUtc(utc);
}

}  // namespace albtpu::formats
