#include "formats/trajectories/sbet_diagnosis.h"

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "formats/crs/foot.h"
#include "formats/trajectories/ascii_motion.h"
#include "sea/angle.h"

namespace albtpu::formats {
namespace {

constexpr double kKnot = 1852.0 / 3600;   // m/s, exact.
constexpr double kFlying = 20;            // m/s: slower ones may drift, hover or roll on the ground.
constexpr std::size_t kSectors = 8;       // Of courses, 45 degrees each.
constexpr std::size_t kMinInSector = 20;  // Pairs.

// A mistake: its description for a message, and the change that undoes it.
struct SbetMistake {
  const char* description;
  SbetRecord (*undo)(SbetRecord);
};

SbetRecord InRadians(SbetRecord record) {
  record.latitude = RadiansOfDegrees(record.latitude);
  record.longitude = RadiansOfDegrees(record.longitude);
  return record;
}
SbetRecord Exchanged(SbetRecord record) {
  std::swap(record.latitude, record.longitude);
  return record;
}
SbetRecord WithWander(SbetRecord record, double angle) {
  record.wander_angle = angle;
  return record;
}
SbetRecord WithVelocities(SbetRecord record, double x, double y, double z) {
  record.velocity_x = x;
  record.velocity_y = y;
  record.velocity_z = z;
  return record;
}
SbetRecord WithVelocitiesTimes(const SbetRecord& record, double factor) {
  return WithVelocities(record, factor * record.velocity_x, factor * record.velocity_y, factor * record.velocity_z);
}

constexpr std::array kSbetMistakes = {
    SbetMistake{"its latitude and longitude are in degrees, not in radians", InRadians},
    SbetMistake{"its angles are in degrees, not in radians",
                [](SbetRecord record) { return WithWander(InRadians(record), RadiansOfDegrees(record.wander_angle)); }},
    SbetMistake{"its latitude and longitude are exchanged", Exchanged},
    SbetMistake{"its latitude and longitude are exchanged and in degrees",
                [](SbetRecord record) { return InRadians(Exchanged(record)); }},
    SbetMistake{"its velocities are along north and west already, and its wander angle does not belong to them",
                [](SbetRecord record) { return WithWander(record, 0); }},
    SbetMistake{"its wander angle has the wrong sign",
                [](SbetRecord record) { return WithWander(record, -record.wander_angle); }},
    SbetMistake{"its wander angle is in degrees, not in radians",
                [](SbetRecord record) { return WithWander(record, RadiansOfDegrees(record.wander_angle)); }},
    SbetMistake{"its velocities are in the order north, east, down",
                [](SbetRecord record) {
                  return WithVelocities(WithWander(record, 0), record.velocity_x, -record.velocity_y,
                                        -record.velocity_z);
                }},
    SbetMistake{"its velocities are in the order north, east, up",
                [](SbetRecord record) {
                  return WithVelocities(WithWander(record, 0), record.velocity_x, -record.velocity_y,
                                        record.velocity_z);
                }},
    SbetMistake{"its velocities are in the order east, north, up",
                [](SbetRecord record) {
                  return WithVelocities(WithWander(record, 0), record.velocity_y, -record.velocity_x,
                                        record.velocity_z);
                }},
    SbetMistake{"its vertical velocities are positive downwards",
                [](SbetRecord record) {
                  return WithVelocities(record, record.velocity_x, record.velocity_y, -record.velocity_z);
                }},
    SbetMistake{"its velocities are in feet per second",
                [](SbetRecord record) { return WithVelocitiesTimes(record, kMetresOfFoot); }},
    SbetMistake{"its velocities are in knots", [](SbetRecord record) { return WithVelocitiesTimes(record, kKnot); }},
    SbetMistake{"its heights are in feet",
                [](SbetRecord record) {
                  record.height *= kMetresOfFoot;
                  return record;
                }},
};

// None where the change makes a position that is not on the globe.
std::optional<std::vector<VelocityPair>> Velocities(std::span<const SbetPair> pairs, SbetRecord (*undo)(SbetRecord),
                                                    VelocityFrame frame = VelocityFrame::kWander) {
  std::vector<VelocityPair> velocities;
  velocities.reserve(pairs.size());
  for (const SbetPair& pair : pairs) {
    const SbetRecord first = undo(pair.first), second = undo(pair.second);
    for (const SbetRecord& record : {first, second})
      if (!(std::abs(record.latitude) <= std::numbers::pi / 2 && std::abs(record.longitude) <= 2 * std::numbers::pi))
        return std::nullopt;
    velocities.push_back(CompareVelocities(TrajectoryRecordOf(first, frame), TrajectoryRecordOf(second, frame)));
  }
  return velocities;
}

SbetRecord AsItIs(SbetRecord record) { return record; }

// The angle by which the velocities must be turned clockwise to agree best with the differences of position, the
// argument of sum(d conj(v)) with north + i east; and the difference that is left.
struct Turn {
  double angle = 0, difference = 0;
};
Turn BestTurn(std::vector<VelocityPair> velocities) {
  std::complex<double> sum = 0;
  for (const VelocityPair& pair : velocities)
    sum += std::complex(pair.north, pair.east) * std::conj(std::complex(pair.stated_north, pair.stated_east));
  const double angle = std::arg(sum);
  for (VelocityPair& pair : velocities) {
    const auto turned = std::complex(pair.stated_north, pair.stated_east) * std::polar(1.0, angle);
    pair.stated_north = turned.real();
    pair.stated_east = turned.imag();
  }
  return {angle, VelocityDifference(velocities)};
}

// The slope of dh/dt over v_U, and its standard error; nullopt where nothing climbs. In an aircraft that flies level,
// heights in feet and vertical velocities of the wrong sign hardly show in the difference of velocities, but they do in
// this slope, which is then 3.28 or -1 and not 1.
struct ClimbSlope {
  double slope = 0, standard_error = 0;

  bool is(double value) const { return standard_error < 0.1 && std::abs(slope - value) < 4 * standard_error + 0.01; }
};
std::optional<ClimbSlope> SlopeOfClimb(std::span<const VelocityPair> velocities) {
  double sum_squares = 0, sum_products = 0;
  for (const VelocityPair& pair : velocities) {
    sum_squares += pair.stated_up * pair.stated_up;
    sum_products += pair.up * pair.stated_up;
  }
  if (velocities.size() < 3 || sum_squares == 0) return std::nullopt;
  const double slope = sum_products / sum_squares;
  double residual = 0;
  for (const VelocityPair& pair : velocities) {
    const double difference = pair.up - slope * pair.stated_up;
    residual += difference * difference;
  }
  return ClimbSlope{slope, std::sqrt(residual / static_cast<double>(velocities.size() - 1) / sum_squares)};
}

// The angle from the courses to the headings. Wind turns headings to one side on the way out and to the other on the
// way back, so the mean over opposite courses is free of it.
struct HeadingTurn {
  double angle = 0;           // rad
  bool free_of_wind = false;  // From opposite courses.
  double wander = 0;          // rad, mean of the wander angles of the same records.
};
std::optional<HeadingTurn> TurnOfHeadings(std::span<const SbetPair> pairs, std::span<const VelocityPair> velocities) {
  std::array<std::complex<double>, kSectors> sums = {};
  std::array<std::size_t, kSectors> counts = {};
  std::complex<double> all = 0, wander = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::complex<double> velocity(velocities[i].north, velocities[i].east);
    if (std::abs(velocity) < kFlying) continue;
    const double course = std::arg(velocity);
    const std::complex<double> turn = std::polar(1.0, TrajectoryRecordOf(pairs[i].first).heading - course);
    const auto sector =
        static_cast<std::size_t>((course + std::numbers::pi) / (2 * std::numbers::pi) * kSectors) % kSectors;
    sums[sector] += turn;
    ++counts[sector];
    all += turn;
    wander += std::polar(1.0, pairs[i].first.wander_angle);
  }
  if (std::abs(all) < kMinInSector) return std::nullopt;
  HeadingTurn result = {std::arg(all), false, std::arg(wander)};
  std::complex<double> opposite = 0;
  for (std::size_t i = 0; i < kSectors / 2; ++i) {
    const std::size_t j = i + kSectors / 2;
    if (counts[i] < kMinInSector || counts[j] < kMinInSector) continue;
    const double weight = static_cast<double>(std::min(counts[i], counts[j]));
    opposite += weight * (sums[i] / std::abs(sums[i]) + sums[j] / std::abs(sums[j]));
  }
  if (std::abs(opposite) > 0) {
    result.angle = std::arg(opposite);
    result.free_of_wind = true;
  }
  return result;
}

// A system may be mounted a quarter or half turn from the nose, which is no mistake: only the remainder counts.
double RestOfQuarterTurns(double angle) { return std::remainder(angle, std::numbers::pi / 2); }

absl::Status CheckHeadings(const std::string& name, std::span<const SbetPair> pairs,
                           std::span<const VelocityPair> velocities) {
  const std::optional<HeadingTurn> turn = TurnOfHeadings(pairs, velocities);
  if (!turn.has_value()) return absl::OkStatus();
  const double angle = RestOfQuarterTurns(turn->angle);
  // Within 5 degrees, which is more than the residual effect of wind and less than the smallest wander angle that is
  // sought.
  const bool is_wander = std::abs(RestOfQuarterTurns(turn->angle - turn->wander)) < RadiansOfDegrees(5) ||
                         std::abs(RestOfQuarterTurns(turn->angle + turn->wander)) < RadiansOfDegrees(5);
  // One course alone: a cross wind of a third of the speed turns the heading by 20 degrees; no survey is flown in more.
  const double limit = RadiansOfDegrees(turn->free_of_wind ? 10 : (is_wander ? 15 : 30));
  if (std::abs(angle) <= limit) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrFormat(
      "%s: its headings differ from its courses by %.1f degrees%s%s; give an SBET whose true heading is "
      "platform heading - wander angle",
      name, DegreesOfRadians(angle), turn->free_of_wind ? " on opposite courses, which wind does not do" : "",
      is_wander ? absl::StrFormat(" (its wander angle, %.1f degrees, was applied twice or not at all)",
                                  DegreesOfRadians(turn->wander))
                : " (a wander angle that was not applied)"));
}

}  // namespace

std::optional<std::string> VelocityCause(std::span<const SbetPair> pairs) {
  if (pairs.empty()) return std::nullopt;
  const std::optional<std::vector<VelocityPair>> stated = Velocities(pairs, AsItIs);
  if (stated.has_value() && VelocityDifference(*stated) <= kLargestVelocityDifference) return std::nullopt;
  double least = kLargestVelocityDifference;
  const char* best = nullptr;
  for (const SbetMistake& mistake : kSbetMistakes) {
    const std::optional<std::vector<VelocityPair>> velocities = Velocities(pairs, mistake.undo);
    if (!velocities.has_value()) continue;
    const double difference = VelocityDifference(*velocities);
    if (difference < least) {
      least = difference;
      best = mistake.description;
    }
  }
  if (best != nullptr) return best;
  if (!stated.has_value()) return std::nullopt;
  const Turn turn = BestTurn(*stated);
  if (turn.difference >= kLargestVelocityDifference) return std::nullopt;
  return absl::StrFormat("its velocities are turned by %.1f degrees, as by a wander angle that was left out",
                         DegreesOfRadians(turn.angle));
}

absl::Status CheckSbetMotion(const std::string& name, std::span<const SbetPair> pairs, VelocityFrame frame) {
  const std::optional<std::vector<VelocityPair>> velocities = Velocities(pairs, AsItIs, frame);
  if (!velocities.has_value() || velocities->empty()) return absl::OkStatus();
  if (frame == VelocityFrame::kNone) return CheckHeadings(name, pairs, *velocities);
  const std::optional<ClimbSlope> climb = SlopeOfClimb(*velocities);
  if (climb.has_value() && climb->is(1 / kMetresOfFoot)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s: its heights change 3.28 times as fast as its vertical velocities state (its "
                        "heights are in feet); "
                        "convert them to metres",
                        name));
  }
  const double difference = VelocityDifference(*velocities);
  // Larger differences have the same cause, which VelocityCause finds, or others beside it.
  if (climb.has_value() && climb->is(-1) && difference <= kLargestVelocityDifference) {
    return absl::InvalidArgumentError(
        absl::StrCat(name,
                     ": its vertical velocities are positive downwards: they have the opposite sign of the changes of "
                     "its heights; give an SBET whose vertical velocities are positive upwards"));
  }
  if (difference > kLargestVelocityDifference) {
    const std::optional<std::string> cause =
        frame == VelocityFrame::kWander ? VelocityCause(pairs)
                                        : std::optional(absl::StrCat("they were taken as along ", FrameText(frame)));
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: its velocities differ from the differences of its positions by %.2f m/s rms, more than %.0f m/s "
        "(%s); give an SBET of 17 doubles a record, in radians, metres and seconds",
        name, difference, kLargestVelocityDifference,
        cause.value_or("no exchange of fields or units and no wander angle explains it: disorder, or another "
                       "format")));
  }
  return CheckHeadings(name, pairs, *velocities);
}

}  // namespace albtpu::formats
