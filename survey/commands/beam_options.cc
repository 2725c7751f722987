#include "survey/commands/beam_options.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "survey/exit_status.h"
#include "survey/number_text.h"

namespace albtpu::client {
namespace {

// Glass and water of any salinity lie well inside; sines of refracted rays stay below 1.
// Fresh water at 30 degrees and 1064 nm has 1.32, cold sea water at 355 nm 1.36.
constexpr double kLeastIndex = 1.3, kGreatestIndex = 1.4;

enum Way : unsigned { kTrajectory = 1, kReturns = 2, kScanner = 4, kIncidence = 8 };

struct WayFlag {
  Way way;
  const char* flag;
  bool given;
};

std::array<WayFlag, 4> WayFlags(const BeamOptions& options) {
  return {{{kTrajectory, "--trajectory", !options.trajectory.empty()},
           {kReturns, "--trajectory-from-returns", options.from_returns},
           {kScanner, "--scanner", options.scanner.has_value()},
           {kIncidence, "--incidence", options.incidence.has_value()}}};
}

absl::StatusOr<WayFlag> ChosenWay(const BeamOptions& options) {
  std::optional<WayFlag> chosen;
  for (const WayFlag& way : WayFlags(options)) {
    if (!way.given) continue;
    if (chosen.has_value()) {
      return UsageError(absl::StrCat("las: ", chosen->flag, " and ", way.flag,
                                     " both say where each beam went; give one of them"));
    }
    chosen = way;
  }
  if (chosen.has_value()) return *chosen;
  return UsageError(
      "las: nothing says where each beam went; give --trajectory FILES, --trajectory-from-returns, "
      "--scanner across-track (its incidence is |scan angle|) or --incidence DEG (a cone)");
}

// Flags that mean something for some of the ways only.
absl::Status CheckFlagsOf(const WayFlag& way, const BeamOptions& options) {
  const struct {
    const char* flag;
    bool given;
    unsigned ways;
  } flags[] = {
      {"--trajectory-errors", !options.trajectory_errors.empty(), kTrajectory},
      {"--trajectory-time", options.trajectory_time.has_value(), kTrajectory},
      {"--geoid-separation", options.geoid_separation.has_value(), kTrajectory},
      {"--lever-arm", options.lever_arm.has_value(), kTrajectory},
      {"--crs", options.crs.has_value(), kTrajectory | kReturns},
      {"--water-index", options.water_index.has_value(), kTrajectory | kReturns},
      {"--flight-direction", options.flight_direction.has_value(), kScanner},
      {"--beam-azimuth", options.beam_azimuth.has_value(), kIncidence},
      {"--altitude", options.altitude.has_value(), kScanner | kIncidence},
      {"--azimuth", options.fixed[Index(AxisId::kAzimuth)].has_value(), kScanner | kIncidence},
  };
  for (const auto& flag : flags) {
    if (!flag.given || (flag.ways & way.way) != 0) continue;
    std::vector<std::string> others;
    for (const WayFlag& other : WayFlags(options)) {
      if ((flag.ways & other.way) != 0) others.emplace_back(other.flag);
    }
    return UsageError(absl::StrCat("las: ", flag.flag, " has no effect with ", way.flag,
                                   "; leave it out (it belongs to ", absl::StrJoin(others, " and "), ")"));
  }
  return absl::OkStatus();
}

absl::StatusOr<BeamSource> Source(const WayFlag& way, const BeamOptions& options) {
  switch (way.way) {
    case kTrajectory:
      return TrajectoryFromFiles{.paths = options.trajectory,
                                 .errors = options.trajectory_errors,
                                 .utc = options.trajectory_time == "utc",
                                 .geoid_separation = options.geoid_separation,
                                 .lever_arm = options.lever_arm.value_or(std::array<double, 3>{}),
                                 .crs = options.crs};
    case kReturns:
      return TrajectoryFromReturns{.crs = options.crs};
    case kScanner:
      return AcrossTrackScan{.flight_direction = options.flight_direction, .altitude = options.altitude};
    case kIncidence:
      break;
  }
  if (*options.incidence >= 90) {
    return UsageError(absl::StrCat("las: --incidence is ", *options.incidence,
                                   " degrees; give an angle from the vertical below 90"));
  }
  return ConstantIncidence{
      .incidence = *options.incidence, .beam_azimuth = options.beam_azimuth, .altitude = options.altitude};
}

absl::Status SetFootprint(const BeamOptions& options, bool details, BeamPlan& plan) {
  const std::optional<float>& footprint = options.fixed[Index(AxisId::kFootprint)];
  const bool track = plan.has_track();
  const bool range_known = track || options.altitude.has_value();
  if (options.divergence.has_value() && range_known && !footprint.has_value()) {
    plan.footprint =
        DivergingBeam{.divergence = *options.divergence, .aperture = options.aperture.value_or(0)};
    return absl::OkStatus();
  }
  const bool altitude_has_effect = !options.altitude.has_value() || details;
  if (!footprint.has_value() || options.divergence.has_value() || !altitude_has_effect) {
    return UsageError(
        absl::StrCat("las: the size of the beam is missing or given twice; give either --footprint, or ",
                     track ? "--divergence" : "--altitude and --divergence"));
  }
  if (options.aperture.has_value()) {
    return UsageError("las: --aperture has no effect without --divergence; leave it out");
  }
  plan.footprint = *footprint;
  return absl::OkStatus();
}

// Over any sea the direction of a beam is known from the wind, or from north; or not at all.
absl::Status CheckDirectionOnce(const BeamPlan& plan) {
  if (!plan.azimuth.has_value() || !plan.has_direction()) return absl::OkStatus();
  return UsageError(
      "las: the direction of the beam is given twice; give --azimuth (from downwind), or its true direction");
}

absl::Status SetAzimuth(const BeamOptions& options, bool details, BeamPlan& plan) {
  plan.azimuth = options.fixed[Index(AxisId::kAzimuth)];
  if (plan.any_sea) return CheckDirectionOnce(plan);
  plan.wind_from = options.wind_from;
  if (plan.azimuth.has_value() && plan.wind_from.has_value()) {
    return UsageError(
        "las: the direction of the beam is given twice; give --azimuth (from downwind), or --wind-from and "
        "the true direction");
  }
  if (plan.has_track()) return absl::OkStatus();
  const bool scanner = std::holds_alternative<AcrossTrackScan>(plan.source);
  const bool direction = scanner ? options.flight_direction.has_value() : options.beam_azimuth.has_value();
  const std::string flag = scanner ? "--flight-direction" : "--beam-azimuth";
  if (plan.wind_from.has_value() && !direction) {
    return UsageError(
        absl::StrCat("las: --wind-from has no effect without ", flag, "; give both or none of them"));
  }
  if (!plan.wind_from.has_value() && direction && !details) {
    return UsageError(
        absl::StrCat("las: ", flag, " has no effect without --wind-from; give both or none of them"));
  }
  return absl::OkStatus();
}

absl::Status SetWater(const BeamOptions& options, BeamPlan& plan) {
  if (!options.water_level.has_value() && options.water_classes.empty()) {
    return UsageError(
        "las: the water surface is missing; give --water-level (its height in the unit and datum of the "
        "file's "
        "heights, or a CSV file of heights by time) or --water-classes (the classes of returns from it: "
        "41,42, or in "
        "point formats 0 to 5 mostly 9 or 27)");
  }
  plan.water_classes = options.water_classes;
  if (options.water_level.has_value()) {
    plan.water_level = ParseDouble(*options.water_level);
    if (!plan.water_level.has_value()) plan.water_level_file = options.water_level;
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<BeamPlan> MakePlan(const BeamOptions& options, bool details, bool any_sea) {
  const absl::StatusOr<WayFlag> way = ChosenWay(options);
  if (!way.ok()) return way.status();
  if (absl::Status status = CheckFlagsOf(*way, options); !status.ok()) return status;
  const absl::StatusOr<BeamSource> source = Source(*way, options);
  if (!source.ok()) return source.status();
  const std::optional<float>& wind_speed = options.fixed[Index(AxisId::kWindSpeed)];
  if (!wind_speed.has_value() && !any_sea) {
    return UsageError(
        "las: --wind-speed is missing; give the wind speed at 10 m in m/s, or the waves by --sea, --hs or "
        "--survey");
  }
  BeamPlan plan;
  plan.source = *source;
  plan.any_sea = any_sea;
  plan.wind_speed = wind_speed.value_or(0);
  plan.fetch = options.fixed[Index(AxisId::kFetch)];
  plan.metres_per_unit = options.metres_per_unit;
  plan.refractive_index = options.water_index.value_or(kSeaWaterIndex);
  if (plan.refractive_index < kLeastIndex || plan.refractive_index > kGreatestIndex) {
    return UsageError(absl::StrCat("las: --water-index is ", plan.refractive_index, " (that of water is ",
                                   kLeastIndex, " to ", kGreatestIndex,
                                   "); give the refractive index of the water, about ", kSeaWaterIndex));
  }
  if (absl::Status status = SetWater(options, plan); !status.ok()) return status;
  if (absl::Status status = SetFootprint(options, details, plan); !status.ok()) return status;
  if (absl::Status status = SetAzimuth(options, details, plan); !status.ok()) return status;
  return plan;
}

}  // namespace albtpu::client
