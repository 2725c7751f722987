#include "tests/quality/crosscheck/simulated_lines.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "tests/budget/air/air_forward.h"
#include "tests/budget/total/total_memory.h"
#include "tests/flights/beam_path.h"
#include "tests/quality/crosscheck/travelling_sea.h"

namespace albtpu::testing {
namespace {

constexpr double kAltitude = 400, kIncidence = 20, kSpeed = 60;
// rad/s and number of the sinusoids of an error of the trajectory, which last for tens of seconds, as those
// of a smoothed trajectory do.
constexpr double kSlowest = 0.02, kFastest = 0.2;
constexpr int kTerms = 8;
constexpr double kFirstTime = 100, kBetweenLines = 300;  // s

bool InSquare(double x, double y, const SimulatedLines& options) {
  const auto in_strip = [&](double along) {
    return along - options.period * std::floor(along / options.period) < options.square;
  };
  return in_strip(x) && in_strip(y);
}

// `slope`: the root mean square of that of ridges 150 m apart.
double Depth(double x, double y, double slope) {
  constexpr double kWavenumber = 2 * std::numbers::pi / 150;
  const double ridges = std::sqrt(2) * slope / kWavenumber * (1 + std::sin(kWavenumber * (x + 0.5 * y)));
  return 9 + 7 * std::sin(x / 900 + 1) + 1.5 * std::sin(y / 400) + ridges;
}

// What a surface of this slope does to the reported point, reported less true: the beam (unit, z down) goes on where
// Snell's law sends it at the tilted surface, until it meets the bottom; processing assumes a level surface and the
// same length of path.
Eigen::Vector3d ErrorOfSlope(const Eigen::Vector3d& beam, double slope_x, double slope_y, double depth) {
  const Eigen::Vector3d level = Refract(beam, {0, 0, -1});
  const Eigen::Vector3d tilted = Refract(beam, -Eigen::Vector3d(slope_x, slope_y, 1).normalized());
  return depth / tilted.z() * (level - tilted);
}

// What the water does where it lies a metre above where it is taken to be: the true path in air ends 1 / cos(incidence)
// earlier, and of what is left of the light's time an nth is laid along the beam in the water. Reported less true.
Eigen::Vector3d ErrorOfHeight(const Eigen::Vector3d& beam) {
  return (beam - Refract(beam, {0, 0, -1}) / kIndexOfWater) / beam.z();
}

// The standard deviations of what slopes do along the beam, across it and down, in m for a depth of 1 m, by a
// simulation of its own. `slopes`: the covariance of those along and across an axis. The beam is turned from it to
// the left by `azimuth`, rad.
Eigen::Vector3d SigmasOfSlopes(const Eigen::Matrix2d& slopes, double azimuth) {
  RandomNumbers random(4711);
  const Eigen::Vector3d beam(std::sin(kIncidence * kDegree), 0, std::cos(kIncidence * kDegree));
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(-azimuth).toRotationMatrix();
  const Eigen::Matrix2d root = Eigen::Matrix2d(turned * slopes * turned.transpose()).llt().matrixL();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  constexpr int kDraws = 100'000;
  for (int i = 0; i < kDraws; ++i) {
    const double first = random.Normal();
    const Eigen::Vector2d slope = root * Eigen::Vector2d(first, random.Normal());
    const Eigen::Vector3d error = ErrorOfSlope(beam, slope.x(), slope.y(), 1);
    sum += error / kDraws;
    squares += error.cwiseAbs2() / kDraws;
  }
  return (squares - sum.cwiseAbs2()).cwiseSqrt();
}

// By the azimuth of the beam, degree clockwise from north.
class SeaSigmas {
 public:
  explicit SeaSigmas(const Eigen::Matrix2d& slopes) {
    for (int i = 0; i < kSteps; ++i) known_.push_back(SigmasOfSlopes(slopes, std::numbers::pi * i / kSteps));
  }
  const Eigen::Vector3d& operator()(double azimuth) const {
    const auto step = std::lround((90 - azimuth) / 180 * kSteps);  // The wind blows to the east.
    return known_[static_cast<std::size_t>((step % kSteps + kSteps) % kSteps)];
  }

 private:
  static constexpr int kSteps = 24;
  std::vector<Eigen::Vector3d> known_;
};

const SeaSigmas& SigmasOf(const SimulatedLines& options) {
  static std::map<std::pair<double, double>, SeaSigmas> known;  // The surveys of a test have the same waves.
  const double wind = options.declared_wind > 0 ? options.declared_wind : options.wind_speed;
  const std::pair key(wind, options.wave_slope);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const Eigen::Matrix2d slopes = wind > 0
                                     ? SlopesUnderFootprint(wind)
                                     : Eigen::Matrix2d(std::pow(options.wave_slope, 2) * Eigen::Matrix2d::Identity());
  return known.emplace(key, SeaSigmas(slopes)).first->second;
}

class Line {
 public:
  // `pass`: how many were flown before.
  Line(const SimulatedLines& options, int pass, int number, double course, double middle, const TravellingSea* sea,
       RandomNumbers& random)
      : options_(options),
        number_(number),
        course_(course),
        middle_(middle),
        start_(kFirstTime + kBetweenLines * pass),
        sea_(sea),
        random_(random) {
    for (int i = 0; i < 6; ++i) {
      const double mean = options.lasting ? random.Normal() : 0;
      wander_.emplace_back(options.trajectory * mean, options.lasting ? 0 : options.trajectory, kSlowest, kFastest,
                           kTerms, random);
    }
  }

  // At `along` and `across` (m, right positive) of the line.
  void AddPoint(double along, double across, double x, double y, std::vector<quality::AnnotatedPoint>& points,
                std::vector<double>& headings) {
    const double sine = std::clamp(across / (kAltitude * std::tan(kIncidence * kDegree)), -1.0, 1.0);
    const bool backward = random_.Uniform(0, 1) < 0.5;
    const double azimuth = course_ + (backward ? 180 - std::asin(sine) / kDegree : std::asin(sine) / kDegree);
    const double depth = Depth(x, y, options_.bottom_slope);
    const AirPulse pulse{.incidence = kIncidence,
                         .beam_azimuth = azimuth,
                         .altitude = kAltitude,
                         .depth = depth,
                         .roll = 0,
                         .pitch = 0,
                         .heading = course_,
                         .velocity = Eigen::Vector3d::Zero(),
                         .rates = Eigen::Vector3d::Zero(),
                         .lever_arm = Eigen::Vector3d::Zero(),
                         .index = kIndexOfWater};
    const AirErrors errors = TrueErrors();
    Eigen::Matrix<double, kAirUnknowns, 1> drawn = Eigen::Matrix<double, kAirUnknowns, 1>::Zero();
    // A beam that looks ahead meets the water before the aircraft is there.
    const double ahead = kAltitude * std::tan(kIncidence * kDegree) * std::sqrt(1 - sine * sine) * (backward ? -1 : 1);
    const double time = (along - ahead) / kSpeed;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      drawn[kNorth + i] = errors.position[axis] * wander_[axis].At(time);
      drawn[kRoll + i] = errors.attitude[axis] * kDegree * wander_[axis + 3].At(time);
    }
    drawn[kBoresightX] = options_.roll_of_scanner * kDegree;
    drawn[kScanA] = options_.scan * errors.scan * kDegree * random_.Normal();
    drawn[kScanB] = options_.scan * errors.scan * kDegree * random_.Normal();
    drawn[kBottomRange] = errors.bottom_range * random_.Normal();
    drawn[kSurfaceHeight] = errors.surface_range * std::cos(kIncidence * kDegree) * random_.Normal();
    const Eigen::Matrix<double, kAirUnknowns, 1> none = Eigen::Matrix<double, kAirUnknowns, 1>::Zero();
    const Eigen::Vector3d beam(std::sin(kIncidence * kDegree) * std::cos(azimuth * kDegree),
                               std::sin(kIncidence * kDegree) * std::sin(azimuth * kDegree),
                               std::cos(kIncidence * kDegree));
    const double gps_time = start_ + time;
    Eigen::Vector2d slope;  // North, east.
    double height = 0;      // Of the water above where it is taken to be.
    if (sea_ == nullptr) {
      slope.x() = options_.wave_slope * random_.Normal();
      slope.y() = options_.wave_slope * random_.Normal();
    } else {
      const double back = depth * std::tan(std::asin(std::sin(kIncidence * kDegree) / kIndexOfWater));
      const TravellingSea::Water water =
          sea_->At(x - back * std::sin(azimuth * kDegree), y - back * std::cos(azimuth * kDegree), gps_time);
      slope = {water.slope.y(), water.slope.x()};
      if (options_.unseen_heights) height = water.height;
    }
    // Still water would refract the pulse to (x, y), where it is reported but for errors of the air side; waves refract
    // it to another place. What is reported therefore lies where the pulse met the water, whatever the waves do.
    const Eigen::Vector3d of_waves = ErrorOfSlope(beam, slope.x(), slope.y(), depth) + height * ErrorOfHeight(beam);
    const double east = x - of_waves.y(), north = y - of_waves.x();
    const Eigen::Vector3d error =
        ReportedPoint<double>(pulse, false, drawn) - ReportedPoint<double>(pulse, false, none);
    const double rough =
        options_.bottom_waves * std::sqrt(2) * std::sin(east * 0.9 + 0.7 * north + 3 * std::sin(north * 0.31));
    quality::AnnotatedPoint& point = points.emplace_back();
    point.x = x + error.y();
    point.y = y + error.x();
    point.z = -Depth(east, north, options_.bottom_slope) - of_waves.z() - error.z() + rough;
    point.line = number_;
    point.has_number = true;
    point.depth = static_cast<float>(depth);
    point.incidence = static_cast<float>(kIncidence);
    point.beam_azimuth = static_cast<float>(azimuth);
    point.footprint = static_cast<float>(kSeaFootprint);
    point.time = gps_time;
    headings.push_back(course_);
  }

  // Points in the squares where another line saw the bottom, too.
  template <typename Place>
  void Fly(bool whole_swath, const Place& place, std::vector<quality::AnnotatedPoint>& points,
           std::vector<double>& headings) {
    const auto jitter = [&] { return random_.Uniform(0, options_.spacing); };
    for (double along = 0; along + options_.spacing < options_.length; along += options_.spacing)
      for (double across = -options_.swath; across < options_.swath; across += options_.spacing) {
        if (!whole_swath && std::abs(across) < options_.line_spacing - options_.swath) continue;
        const double a = along + jitter(), c = across + jitter();
        const auto [x, y] = place(a, c, middle_);
        if (InSquare(x, y, options_)) AddPoint(a, c, x, y, points, headings);
      }
  }

 private:
  const SimulatedLines& options_;
  int number_;
  double course_, middle_, start_;
  const TravellingSea* sea_;  // Null: slopes are drawn anew for each pulse.
  RandomNumbers& random_;
  std::vector<SmoothMotion> wander_;  // Errors of the trajectory, of variance 1.
};

// What the budget predicts. The axis of the sea is taken as that of each beam, because its
// errors are known along and across it.
void Predict(const AirErrors& errors, const SimulatedLines& options, const std::vector<double>& headings,
             std::vector<quality::AnnotatedPoint>& points) {
  const SeaSigmas& sigmas = SigmasOf(options);
  TotalInputs inputs;
  if (options.unseen_heights)
    inputs[BudgetInput::kWaveHeight] = {static_cast<float>(SigmaOfHeights(options.wind_speed))};
  inputs[BudgetInput::kIncidence] = {kIncidence};
  inputs[BudgetInput::kAltitude] = {kAltitude};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float depth = points[i].depth;
    const Eigen::Vector3d& sea = sigmas(points[i].beam_azimuth);
    inputs[BudgetInput::kRefractionAlong].push_back(static_cast<float>(sea[0]));
    inputs[BudgetInput::kRefractionCross].push_back(static_cast<float>(sea[1]));
    inputs[BudgetInput::kBeamAzimuth].push_back(points[i].beam_azimuth);
    inputs[BudgetInput::kHeading].push_back(static_cast<float>(headings[i]));
    inputs[BudgetInput::kDepth].push_back(depth);
    inputs[BudgetInput::kSeaThu].push_back(static_cast<float>(2 * std::hypot(sea[0], sea[1])) * depth);
    inputs[BudgetInput::kSeaTvu].push_back(static_cast<float>(2 * sea[2]) * depth);
  }
  inputs[BudgetInput::kSeaAxis] = inputs[BudgetInput::kBeamAzimuth];
  TotalMemory totals(points.size());
  ComputeBudget(inputs.inputs(), {.errors = errors, .index = kIndexOfWater, .coverage = Coverage::kOneSigma},
                totals.outputs());
  for (std::size_t i = 0; i < points.size(); ++i) {
    quality::AnnotatedPoint& point = points[i];
    point.thu = totals.numbers[0][i];
    point.tvu = totals.numbers[1][i];
    point.tvu_air = totals.numbers[3][i];
    point.thu_sea = totals.numbers[4][i];
    point.tvu_sea = totals.numbers[5][i];
    point.tvu_pulse = static_cast<float>(std::sqrt(totals.Covariance(kPulsePart, i)(2, 2)));
    point.tvu_line = static_cast<float>(std::sqrt(totals.Covariance(kLinePart, i)(2, 2)));
    const Eigen::Matrix3f c = totals.Covariance(kTotalPart, i).cast<float>();  // North, east, down.
    point.variance_x = c(1, 1);
    point.variance_y = c(0, 0);
    point.variance_z = c(2, 2);
    point.covariance_xy = c(0, 1);
    point.covariance_xz = -c(1, 2);
    point.covariance_yz = -c(0, 2);
  }
}

}  // namespace

AirErrors TrueErrors() {
  return {.position = {0.03, 0.03, 0.06},
          .attitude = {0.004, 0.004, 0.008},
          .scan = 0.01,
          .bottom_range = 0.04,
          .surface_range = 0.04};
}

std::vector<quality::AnnotatedPoint> Simulate(const SimulatedLines& options) {
  RandomNumbers random(options.seed);
  std::vector<quality::AnnotatedPoint> points;
  std::vector<double> headings;
  std::optional<TravellingSea> waves;
  if (options.wind_speed > 0) waves.emplace(options.wind_speed, random);
  const TravellingSea* const sea = waves.has_value() ? &*waves : nullptr;
  for (int i = 0; i < options.lines; ++i) {
    const bool back = options.to_and_fro && i % 2 == 1;  // x is east, y north; flown east, and back west.
    Line line(options, i, i + 1, back ? 270 : 90, i * options.line_spacing, sea, random);
    line.Fly(
        false,
        [&](double along, double across, double middle) {
          return std::pair(back ? options.length - along : along, back ? middle + across : middle - across);
        },
        points, headings);
  }
  for (int i = 0; i < options.cross_lines; ++i) {
    const double middle = (i + 0.5) / options.cross_lines * options.length;
    Line line(options, options.lines + i, 101 + i, 0, middle, sea, random);
    line.Fly(
        true,
        [&](double along, double across, double x) {
          return std::pair(x + across, along - (options.length - (options.lines - 1) * options.line_spacing) / 2);
        },
        points, headings);
  }
  AirErrors declared = TrueErrors();
  for (double& each : declared.position) each *= options.declared;
  for (double& each : declared.attitude) each *= options.declared;
  for (double* const each : {&declared.scan, &declared.bottom_range, &declared.surface_range})
    *each *= options.declared;
  Predict(declared, options, headings, points);
  return points;
}

}  // namespace albtpu::testing
