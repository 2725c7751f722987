#include "formats/trajectories/trajectory_sigmas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "formats/text/text.h"

namespace albtpu::formats {
namespace {

// Of the standard deviations of a whole file.
struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;  // The least of those above 0.
  bool stated = false;
};

// m or rad. A file whose greatest is below `least`, or whose least is above `greatest`, has another unit.
struct Limits {
  double least, greatest;
};
// A millimetre is the noise of a receiver's carrier phase; 5 m is beyond that of one without any correction.
constexpr Limits kPosition = {0.001, 5};
// A fifth of what the best airborne systems state after processing, 0.0025 degrees (Applanix POS AV 610), and four
// times what those of the smallest aircraft do, 0.025 degrees (Applanix APX-15 UAV).
constexpr Limits kTilt = {0.0005 * std::numbers::pi / 180, 0.1 * std::numbers::pi / 180};

struct Unit {
  const char* name;
  double size;  // m or rad; exact.
};
constexpr Unit kLengths[] = {{"millimetres", 0.001}, {"centimetres", 0.01}};
constexpr Unit kAngles[] = {{"radians", 1},
                            {"degrees", std::numbers::pi / 180},
                            {"arc minutes", std::numbers::pi / (180 * 60)},
                            {"arc seconds", std::numbers::pi / (180 * 3600)}};

// " (they may be radians)"; empty where no unit fits. `stated` is in the unit of the file.
std::string UnitsThatFit(double stated, const Limits& limits, std::span<const Unit> units) {
  std::vector<std::string> fitting;
  for (const Unit& unit : units)
    if (stated * unit.size >= limits.least && stated * unit.size <= limits.greatest) fitting.emplace_back(unit.name);
  return fitting.empty() ? "" : absl::StrCat(" (they may be ", absl::StrJoin(fitting, " or "), ")");
}

}  // namespace

absl::Status CheckSigmaUnits(const std::string& name, const SigmaColumns& columns, std::size_t size,
                             const std::function<TrajectorySigma(std::size_t)>& of_record) {
  constexpr std::size_t kFirstAngle = 6, kHeading = 8;
  std::array<Range, kSigmaFields.size()> ranges;
  for (std::size_t record = 0; record < size; ++record) {
    const TrajectorySigma sigma = of_record(record);
    for (std::size_t field = 0; field < ranges.size(); ++field) {
      const double value = sigma.*kSigmaFields[field];
      ranges[field].stated |= !std::isnan(value);
      if (value > 0) ranges[field].least = std::min(ranges[field].least, value);
      if (value > 0) ranges[field].greatest = std::max(ranges[field].greatest, value);
    }
  }
  for (const std::size_t field : {0, 1, 2, 6, 7, 8}) {
    const Range& range = ranges[field];
    const bool is_angle = field >= kFirstAngle;
    if (!range.stated) continue;
    const auto error = [&](const std::string& text) {
      return InvalidFile(name, absl::StrCat(columns.names[field], " ", text));
    };
    if (range.greatest == 0) {
      return error(
          absl::StrCat("is 0 throughout, which no trajectory has; write what it is, or, if that is not known, ",
                       columns.if_unknown));
    }
    if (field == kHeading) continue;  // On a straight course nothing tells it, and it may be large.
    const Limits& limits = is_angle ? kTilt : kPosition;
    const bool is_small = range.greatest < limits.least;
    if (!is_small && range.least <= limits.greatest) continue;
    const double stated = (is_small ? range.greatest : range.least) / (is_angle ? columns.radians : 1);
    const std::string unit = is_angle ? columns.angle : "m";
    return error(absl::StrFormat(
        "is at %s %.2g %s, %s than any navigation system of laser bathymetry has%s; convert it to %s, or, if it is not "
        "known, %s",
        is_small ? "most" : "least", stated, unit, is_small ? "less" : "more",
        UnitsThatFit(stated, limits, is_angle ? std::span<const Unit>(kAngles) : kLengths), unit, columns.if_unknown));
  }
  return absl::OkStatus();
}

}  // namespace albtpu::formats
