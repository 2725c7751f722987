#include "programs/query/beam_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "annotate/run/file_progress.h"
#include "annotate/totals/water_column.h"
#include "programs/command_line/command_line.h"
#include "programs/query/options.h"
#include "status/status_macros.h"

namespace albtpu::programs {
namespace {

using config::SurveySettings;

enum Way : unsigned { kTrajectory = 1, kReturns = 2, kScanner = 4, kIncidence = 8 };

struct WayFlag {
  Way way;
  const char* flag;
  bool given;
};

std::array<WayFlag, 4> WayFlags(const BeamOptions& options, const config::TrajectorySettings& trajectory) {
  return {{{kTrajectory, "--trajectory", !trajectory.files.empty()},
           {kReturns, "--trajectory-from-returns", trajectory.from_returns.value_or(false)},
           {kScanner, "--scanner", options.scanner.has_value()},
           {kIncidence, "--incidence", options.incidence.has_value()}}};
}

// All that are given.
unsigned WaysGiven(const BeamOptions& options, const config::TrajectorySettings& trajectory) {
  unsigned given = 0;
  for (const WayFlag& way : WayFlags(options, trajectory))
    if (way.given) given |= way.way;
  return given;
}

// Requires that one is given.
absl::StatusOr<WayFlag> ChosenWay(const BeamOptions& options, const config::TrajectorySettings& trajectory) {
  std::optional<WayFlag> chosen;
  for (const WayFlag& way : WayFlags(options, trajectory)) {
    if (!way.given) continue;
    if (chosen.has_value()) {
      return formats::UsageError(
          absl::StrCat("las: ", chosen->flag, " and ", way.flag, " both say where each beam went; give one of them"));
    }
    chosen = way;
  }
  return *chosen;
}

// Flags that mean something for some of the ways only.
absl::Status CheckFlagsOf(const WayFlag& way, const BeamOptions& options, const SurveySettings& flags,
                          const config::SurfaceSettings& surface) {
  // The surface at a point is found from the returns around it, as far as their unit is known.
  const unsigned of_places = surface.classes.empty() ? kTrajectory | kReturns : way.way;
  const struct {
    const char* flag;
    bool given;
    unsigned ways;
  } checked[] = {
      {"--trajectory-errors", !flags.trajectory.errors.empty(), kTrajectory},
      {"--trajectory-time", flags.trajectory.time.has_value(), kTrajectory},
      {"--velocity-axes", flags.trajectory.velocity_axes.has_value(), kTrajectory},
      {"--geoid-separation", flags.datum.geoid_separation.has_value(), kTrajectory},
      {"--lever-arm", flags.sensor.lever_arm.has_value(), kTrajectory},
      {"--crs", options.crs.has_value(), of_places},
      {"--flight-direction", options.flight_direction.has_value(), kScanner},
      {"--beam-azimuth", options.beam_azimuth.has_value(), kIncidence},
      {"--altitude", options.altitude.has_value(), kScanner | kIncidence},
      {"--azimuth", options.fixed[annotate::PulseInput::kAzimuth].has_value(), kScanner | kIncidence},
  };
  for (const auto& flag : checked) {
    if (!flag.given || (flag.ways & way.way) != 0) continue;
    std::vector<std::string> others;
    for (const WayFlag& other : WayFlags(options, flags.trajectory))
      if ((flag.ways & other.way) != 0) others.emplace_back(other.flag);
    return formats::UsageError(absl::StrCat("las: ", flag.flag, " has no effect with ", way.flag,
                                            "; leave it out (it belongs to ", absl::StrJoin(others, " and "), ")"));
  }
  return absl::OkStatus();
}

static_assert(formats::kTimeFormatNames == config::kTimeFormats);
static_assert(formats::kVelocityAxesNames == config::kVelocityAxes);

// Of the names, the one that is given, or the first.
template <typename Names>
std::size_t IndexOf(const Names& names, const std::optional<std::string>& given) {
  const auto found = std::find(names.begin(), names.end(), given.value_or(std::string(names.front())));
  return static_cast<std::size_t>(found - names.begin());
}

absl::StatusOr<annotate::BeamSource> Source(const WayFlag& way, const BeamOptions& options,
                                            const SurveySettings& settings) {
  const config::TrajectorySettings& trajectory = settings.trajectory;
  switch (way.way) {
    case kTrajectory:
      return annotate::TrajectoryFromFiles{.paths = trajectory.files,
                                           .errors = trajectory.errors,
                                           .utc = trajectory.time == "utc",
                                           .velocity_axes = static_cast<formats::VelocityAxes>(
                                               IndexOf(formats::kVelocityAxesNames, trajectory.velocity_axes)),
                                           .geoid_separation = settings.datum.geoid_separation,
                                           .lever_arm = settings.sensor.lever_arm.value_or(config::Triple{})};
    case kReturns:
      return annotate::TrajectoryFromReturns();
    case kScanner:
      return annotate::AcrossTrackScan{.flight_direction = options.flight_direction, .altitude = options.altitude};
    case kIncidence:
      break;
  }
  if (*options.incidence >= 90) {
    return formats::UsageError(
        absl::StrCat("las: --incidence is ", *options.incidence, " degrees; give an angle from the vertical below 90"));
  }
  return annotate::ConstantIncidence{
      .incidence = *options.incidence, .beam_azimuth = options.beam_azimuth, .altitude = options.altitude};
}

// Whether the footprint is given, or the divergence and the distance that it takes effect over.
bool IsSizeKnown(const BeamOptions& options, bool track) {
  return options.fixed[annotate::PulseInput::kFootprint].has_value() ||
         (options.divergence.has_value() && (track || options.altitude.has_value()));
}

std::string SizeMessage(const char* problem, bool track) {
  return absl::StrCat("the size of the beam is ", problem, "; give either --footprint, or ",
                      track ? "--divergence" : "--altitude and --divergence");
}

absl::Status SetFootprint(const BeamOptions& options, bool details, annotate::BeamPlan& plan) {
  const std::optional<float>& footprint = options.fixed[annotate::PulseInput::kFootprint];
  const bool track = plan.has_track();
  if (IsSizeKnown(options, track) && !footprint.has_value()) {
    plan.footprint =
        annotate::DivergingBeam{.divergence = *options.divergence, .aperture = options.aperture.value_or(0)};
    return absl::OkStatus();
  }
  const bool altitude_has_effect = !options.altitude.has_value() || details;
  if (options.divergence.has_value() || !altitude_has_effect)
    return formats::UsageError(absl::StrCat("las: ", SizeMessage("given twice", track)));
  if (options.aperture.has_value())
    return formats::UsageError("las: --aperture has no effect without --divergence; leave it out");
  plan.footprint = *footprint;
  return absl::OkStatus();
}

absl::Status SetAzimuth(const BeamOptions& options, const config::SeaSettings& sea, bool details,
                        annotate::BeamPlan& plan) {
  plan.azimuth = options.fixed[annotate::PulseInput::kAzimuth];
  if (plan.any_sea) {  // The direction of a beam is known from the wind, or from north; or not at all.
    if (!plan.azimuth.has_value() || !plan.has_direction()) return absl::OkStatus();
    return formats::UsageError(
        "las: the direction of the beam is given twice; give --azimuth (from downwind), or its true direction");
  }
  plan.wind_from = sea.wind_from;
  if (plan.azimuth.has_value() && plan.wind_from.has_value()) {
    return formats::UsageError(
        "las: the direction of the beam is given twice; give --azimuth (from downwind), or --wind-from and "
        "the true direction");
  }
  if (plan.has_track() || plan.wind_from.has_value() || details) return absl::OkStatus();
  for (const auto& [flag, direction] :
       {std::pair("--flight-direction", options.flight_direction), std::pair("--beam-azimuth", options.beam_azimuth)}) {
    if (!direction.has_value()) continue;
    return formats::UsageError(
        absl::StrCat("las: ", flag, " has no effect without --wind-from; give both or none of them"));
  }
  return absl::OkStatus();
}

absl::Status SetWater(const config::SurfaceSettings& surface, annotate::BeamPlan& plan) {
  plan.water_classes = {surface.classes.begin(), surface.classes.end()};
  plan.level_reference = {.datum = surface.level_datum,
                          .offset = surface.level_offset.value_or(0),
                          .hours_from_utc = surface.level_hours_from_utc};
  const bool refers =
      surface.level_datum.has_value() || surface.level_offset.has_value() || surface.level_hours_from_utc.has_value();
  const bool file_given = surface.level.has_value() && std::holds_alternative<std::string>(*surface.level);
  if (refers && !file_given) {
    return formats::UsageError(
        "las: --level-datum, --level-offset and --level-hours-from-utc have no effect without a file of water levels; "
        "leave them out, or give the file by --water-level");
  }
  if (!surface.level.has_value()) return absl::OkStatus();
  if (const auto* file = std::get_if<std::string>(&*surface.level))
    plan.water_level_file = *file;
  else
    plan.water_level = std::get<double>(*surface.level);
  return absl::OkStatus();
}

void AddWays(CLI::App& command, BeamOptions& options, SurveyFlags& flags) {
  AddFlags(command,
           {"--trajectory", "--trajectory-errors", "--trajectory-time", "--time-format", "--velocity-axes",
            "--geoid-separation", "--lever-arm"},
           group::kBeam, flags);
  command
      .add_option("--crs", options.crs,
                  "Coordinate system of the points, such as EPSG:26917, in place of what the files state")
      ->type_name("CODE")
      ->check(NotEmpty("coordinate system"))
      ->group(group::kBeam);
  AddFlags(command, {"--trajectory-from-returns"}, group::kBeam, flags);
  command.add_option("--scanner", options.scanner, "The scanner swings across the track: incidence is |scan angle|")
      ->type_name("across-track")
      ->check(OneOf({"across-track"}))
      ->group(group::kBeam);
  AddNumber(command, "--flight-direction", Sign::kAny, "Direction of flight, for --scanner across-track [degree, true]",
            options.flight_direction)
      ->group(group::kBeam);
  AddNumber(command, "--incidence", Sign::kNotNegative,
            "One angle of all beams from the vertical, in air, as of a cone [degree]", options.incidence)
      ->group(group::kBeam);
  AddNumber(command, "--beam-azimuth", Sign::kAny, "Where the beams travel to, for --incidence [degree, true]",
            options.beam_azimuth)
      ->group(group::kBeam);
}

}  // namespace

void AddBeamOptions(CLI::App& command, BeamOptions& options, SurveyFlags& flags) {
  AddWays(command, options, flags);
  AddFlags(command, {"--water-level", "--level-datum", "--level-offset", "--level-hours-from-utc", "--water-classes"},
           group::kSea, flags);
  for (const annotate::PulseInput input : {annotate::PulseInput::kFootprint, annotate::PulseInput::kAzimuth})
    AddInput(command, input, options.fixed);
  AddNumber(command, "--altitude", Sign::kPositive,
            "Height of the aircraft above the water, where no trajectory gives it [m]", options.altitude)
      ->group(group::kPulse);
  AddNumber(command, "--divergence", Sign::kNotNegative, "Divergence of the beam, full angle [mrad]",
            options.divergence)
      ->group(group::kPulse);
  AddNumber(command, "--aperture", Sign::kNotNegative,
            "Diameter of the beam where it leaves the sensor, with --divergence [m] (default: 0)", options.aperture)
      ->group(group::kPulse);
  std::vector<std::string> words;
  for (const HeightUnit& unit : kHeightUnits) words.emplace_back(unit.name);
  command
      .add_option_function<std::string>(
          "--units",
          [&options](const std::string& text) {
            options.metres_per_unit = std::ranges::find(kHeightUnits, text, &HeightUnit::name)->metres;
          },
          "Unit of the file's heights and of --water-level: m, ft (international) or us-ft (US survey) "
          "(default: that "
          "of the file's coordinate system)")
      ->type_name(absl::StrJoin(words, "|"))
      ->check(OneOf(words))
      ->group(group::kPoints);
}

std::vector<config::OpenDecision> OpenDecisionsOf(const BeamOptions& options, const SurveySettings& settings) {
  std::vector<config::OpenDecision> open;
  const unsigned given = WaysGiven(options, settings.trajectory);
  if (given == 0) {
    open.push_back({"trajectory",
                    "nothing says where each beam went; give --trajectory FILES, --trajectory-from-returns, --scanner "
                    "across-track (its incidence is |scan angle|) or --incidence DEG (a cone)"});
  }
  if (!settings.sea.wind_speed.has_value() && !settings.sea.has_waves()) {
    open.push_back({"sea",
                    "--wind-speed is missing; give the wind speed at 10 m in m/s, or the waves by --sea, --hs or "
                    "[[sea.waves]] of a survey file"});
  }
  if (!settings.surface.level.has_value() && settings.surface.classes.empty()) {
    open.push_back({"surface",
                    "the water surface is missing; give --water-level (its height in the unit and datum of the file's "
                    "heights, or a CSV file of heights by time) or --water-classes (the classes of returns from it: "
                    "41,42, or in point formats 0 to 5 mostly 9 or 27)"});
  }
  // Where the direction of the wind counts, it takes that of the beams.
  const char* const direction = given == kScanner && !options.flight_direction.has_value() ? "--flight-direction"
                                : given == kIncidence && !options.beam_azimuth.has_value() ? "--beam-azimuth"
                                                                                           : nullptr;
  if (direction != nullptr && settings.sea.wind_from.has_value() && !settings.sea.has_waves() &&
      !options.fixed[annotate::PulseInput::kAzimuth].has_value()) {
    open.push_back(
        {direction, absl::StrCat("--wind-from has no effect without ", direction, "; give both or none of them")});
  }
  const bool track = given == 0 || (given & (kTrajectory | kReturns)) != 0;
  if (!IsSizeKnown(options, track)) open.push_back({"beam size", SizeMessage("missing", track)});
  return open;
}

bool GoesWith(std::string_view flag_of_way, const BeamOptions& options, const SurveySettings& flags) {
  const auto ways = WayFlags(options, flags.trajectory);
  const auto way = std::ranges::find(ways, flag_of_way, &WayFlag::flag);
  return way != ways.end() && CheckFlagsOf(*way, options, flags, flags.surface).ok();
}

absl::StatusOr<annotate::BeamPlan> MakePlan(const BeamOptions& options, const SurveySettings& flags,
                                            const SurveySettings& settings, bool details) {
  const config::SeaSettings& sea = settings.sea;
  ASSIGN_OR_RETURN(const WayFlag way, ChosenWay(options, settings.trajectory));
  RETURN_IF_ERROR(CheckFlagsOf(way, options, flags, settings.surface));
  ASSIGN_OR_RETURN(const annotate::BeamSource source, Source(way, options, settings));
  annotate::FixedInputs wind;
  TakeWind(sea, wind);
  annotate::BeamPlan plan;
  plan.source = source;
  plan.time_format =
      static_cast<formats::TimeFormat>(IndexOf(formats::kTimeFormatNames, settings.trajectory.time_format));
  plan.any_sea = wind.any_sea;
  plan.wind_speed = wind[annotate::PulseInput::kWindSpeed].value_or(0);
  plan.fetch = wind[annotate::PulseInput::kFetch];
  plan.crs = options.crs;
  plan.metres_per_unit = options.metres_per_unit;
  if (plan.has_track()) plan.refractive_index = annotate::IndexOrUsual(settings.water);
  RETURN_IF_ERROR(SetWater(settings.surface, plan));
  RETURN_IF_ERROR(SetFootprint(options, details, plan));
  RETURN_IF_ERROR(SetAzimuth(options, sea, details, plan));
  return plan;
}

}  // namespace albtpu::programs
