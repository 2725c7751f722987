#include "tests/flights/survey.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "tests/flights/beam_path.h"

namespace albtpu::testing {
namespace {

constexpr double kPause = 60;               // s between lines
constexpr double kLineSpacing = 0.6;        // of the altitude
constexpr double kShallowest = 0.5;         // m; no returns are delivered between here and the beach
constexpr double kLowestLand = 0.2;         // m
constexpr double kLeastAboveBottom = 1;     // m, of the second return under water
constexpr double kMostAboveBottom = 6;      // m
constexpr double kLeastBelowSurface = 0.4;  // m

Coast MakeCoast(const SurveyOptions& options) {
  const double length = options.speed * options.seconds;
  return {.course = options.course,
          .shoreline = 0.08 * length,
          .deepest_at = length + 0.45 * options.altitude,
          .water_level = options.water_level};
}

std::vector<Aircraft> MakeAircraft(const SurveyOptions& options, const AreaChart& chart, RandomNumbers& random) {
  std::vector<Aircraft> aircraft;
  const double length = options.speed * options.seconds, spacing = kLineSpacing * options.altitude;
  const double sine = std::sin(options.course), cosine = std::cos(options.course);
  // A line that begins `along` and `across` from the beginning of the first one.
  const auto add = [&](double along, double across, double turn) {
    aircraft.emplace_back(chart,
                          Aircraft::Options{.east = along * sine + across * cosine,
                                            .north = along * cosine - across * sine,
                                            .course = options.course + turn,
                                            .height = options.water_level + options.altitude,
                                            .speed = options.speed,
                                            .crab_angle = options.crab_angle},
                          random);
  };
  for (int line = 0; line < options.lines; ++line)
    line % 2 == 1 ? add(length, line * spacing, std::numbers::pi) : add(0, line * spacing, 0);
  // Evenly over the lines, and as far beyond the block on one side as on the other.
  const double width = (options.lines - 1) * spacing;
  for (int line = 0; line < options.cross_lines; ++line)
    add((line + 0.5) / options.cross_lines * length, (width - length) / 2, std::numbers::pi / 2);
  return aircraft;
}

// What one pulse returns, added to `survey`.
class PulseSimulator {
 public:
  PulseSimulator(const Scene& scene, SimulatedSurvey& survey, RandomNumbers& random)
      : scene_(scene), survey_(survey), random_(random), scanner_axes_(Attitude(survey.options.boresight)) {
    const SurveyOptions& options = survey.options;
    if (options.errors.any())
      processing_.emplace(options.errors, options.lever_arm, options.range_noise, survey.lines(), options.seed);
  }

  void Fire(int line, double since_start) {
    const SurveyOptions& options = survey_.options;
    const AircraftState aircraft = survey_.aircraft[static_cast<std::size_t>(line)].At(since_start);
    const Eigen::Matrix3d body = aircraft.BodyAxes();
    const Eigen::Vector3d sensor = EarthCentred(aircraft.position) + body * options.lever_arm;
    const Eigen::Vector3d in_body = scanner_axes_ * BeamDirection(options.scanner, options.scan_rate * since_start);
    const Eigen::Vector3d beam = body * in_body;

    BeamPath path = PathToWater(scene_, sensor, beam, since_start);
    if (processing_.has_value()) {
      path.water_direction = processing_->Refracted(path, beam);
      processing_->Receive(line, since_start, aircraft, in_body, path);
    }
    SimulatedPulse pulse{.time = survey_.LineStart(line) + since_start,
                         .line = line + 1,
                         .sensor = GeodeticFrom(sensor),
                         .incidence = path.incidence,
                         .azimuth = path.azimuth,
                         .slant_range = path.slant_range,
                         .scan_angle = std::atan2(in_body.y(), in_body.z()) - aircraft.roll};
    const double to_bottom = DistanceToGround(scene_, path.water_point, path.water_direction);
    const double depth = DepthOf(path.water_point + to_bottom * path.water_direction);
    if (depth > kShallowest) {
      UnderWater(path, beam, to_bottom, depth);
    } else if (const double to_land = DistanceToGround(scene_, sensor, beam);
               DepthOf(sensor + to_land * beam) < -kLowestLand) {
      pulse.slant_range = to_land;
      Add(ReturnKind::kLand, sensor + to_land * beam, beam, 0, to_land);
    }
    if (!found_.empty()) Keep(pulse);
  }

 private:
  double DepthOf(const Eigen::Vector3d& point) const {
    return survey_.options.water_level - GeodeticFrom(point).height;
  }

  // From `point`, which lies `way` m behind the water, or on land `way` m from the sensor.
  void Add(ReturnKind kind, const Eigen::Vector3d& point, const Eigen::Vector3d& beam, double depth, double way) {
    if (processing_.has_value() && kind != ReturnKind::kLand) {
      found_.push_back({.kind = kind, .position = GeodeticFrom(processing_->Reported(way)), .depth = depth});
      return;
    }
    const double noise = survey_.options.range_noise * random_.Normal();
    const Eigen::Vector3d reported = processing_.has_value() ? processing_->ReportedOnLand(way) : point + noise * beam;
    found_.push_back({.kind = kind, .position = GeodeticFrom(reported), .depth = depth});
  }

  void UnderWater(const BeamPath& path, const Eigen::Vector3d& beam, double to_bottom, double depth) {
    const SurveyOptions& options = survey_.options;
    if (random_.Uniform(0, 1) < options.surface_share) Add(ReturnKind::kSurface, path.water_point, beam, 0, 0);
    const double highest = std::min(kMostAboveBottom, depth - kLeastBelowSurface);
    const double above = random_.Uniform(kLeastAboveBottom, std::max(highest, kLeastAboveBottom));
    if (random_.Uniform(0, 1) < options.column_share && highest > kLeastAboveBottom) {
      const double way = to_bottom * (1 - above / depth);
      const Eigen::Vector3d point = path.water_point + way * path.water_direction;
      Add(ReturnKind::kColumn, point, path.water_direction, DepthOf(point), way);
    }
    Add(ReturnKind::kBottom, path.water_point + to_bottom * path.water_direction, path.water_direction, depth,
        to_bottom);
  }

  void Keep(const SimulatedPulse& pulse) {
    survey_.pulses.push_back(pulse);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      found_[i].pulse = survey_.pulses.size() - 1;
      found_[i].number = static_cast<int>(i) + 1;
      found_[i].count = static_cast<int>(found_.size());
      survey_.returns.push_back(found_[i]);
    }
    found_.clear();
  }

  const Scene& scene_;
  SimulatedSurvey& survey_;
  RandomNumbers& random_;
  Eigen::Matrix3d scanner_axes_;
  std::optional<ReportedPoints> processing_;  // With errors.
  std::vector<SimulatedReturn> found_;        // Of the pulse that is being fired.
};

}  // namespace

double SimulatedSurvey::LineStart(int line) const { return options.start + line * (options.seconds + kPause); }

SimulatedSurvey Simulate(const SurveyOptions& options) {
  RandomNumbers random(options.seed);
  const AreaChart chart(options.latitude, options.longitude);
  const Coast coast = MakeCoast(options);
  const WavySurface waves(options.wave_height, options.course + 1, random);
  SimulatedSurvey survey{.options = options, .aircraft = MakeAircraft(options, chart, random)};
  const Scene scene{chart, coast, waves};
  PulseSimulator simulator(scene, survey, random);
  const int pulses = static_cast<int>(options.seconds * options.pulse_rate);
  for (int line = 0; line < survey.lines(); ++line)
    for (int pulse = 0; pulse < pulses; ++pulse) simulator.Fire(line, pulse / options.pulse_rate);
  return survey;
}

}  // namespace albtpu::testing
