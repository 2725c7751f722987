#include "tests/quality/crosscheck/simulated_lines.h"

#include <cmath>
#include <map>
#include <numbers>

#include "tests/budget/air/air_forward.h"
#include "tests/budget/total/total_memory.h"
#include "tests/flights/beam_path.h"

namespace albtpu::testing {
namespace {

constexpr double kAltitude = 400, kIncidence = 20, kSpeed = 60;
constexpr double kLineSpacing = 240;
// rad/s and number of the sinusoids of an error of the trajectory, which are correlated over some seconds.
constexpr double kSlowest = 0.1, kFastest = 1;
constexpr int kTerms = 8;
constexpr double kSwath = 140;  // m on each side; the cone of 20 degrees reaches 146 m.
// Lines differ by errors that last for hundreds of metres. A ninth of the bottom shows them as the whole of it does:
// squares of 10 m, which are four patches each, 30 m apart.
constexpr double kSquare = 10, kPeriod = 30;  // m

bool InSquare(double x, double y) {
  const auto in_strip = [](double along) { return along - kPeriod * std::floor(along / kPeriod) < kSquare; };
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

// The standard deviations of the above along the beam, across it and down, in m for a depth of 1 m, by a simulation of
// its own.
Eigen::Vector3d SeaSigmas(double wave_slope) {
  static std::map<double, Eigen::Vector3d> known;  // The surveys of a test have the same waves.
  if (const auto found = known.find(wave_slope); found != known.end()) return found->second;
  RandomNumbers random(4711);
  const Eigen::Vector3d beam(std::sin(kIncidence * kDegree), 0, std::cos(kIncidence * kDegree));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d error = ErrorOfSlope(beam, wave_slope * random.Normal(), wave_slope * random.Normal(), 1);
    sum += error / kDraws;
    squares += error.cwiseAbs2() / kDraws;
  }
  return known[wave_slope] = (squares - sum.cwiseAbs2()).cwiseSqrt();
}

class Line {
 public:
  Line(const SimulatedLines& options, int number, double course, double middle, RandomNumbers& random)
      : options_(options), number_(number), course_(course), middle_(middle), random_(random) {
    for (int i = 0; i < 6; ++i) wander_.emplace_back(0, 1, kSlowest, kFastest, kTerms, random);
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
    const double time = along / kSpeed;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      drawn[kNorth + i] = errors.position[axis] * wander_[axis].At(time);
      drawn[kRoll + i] = errors.attitude[axis] * kDegree * wander_[axis + 3].At(time);
    }
    drawn[kBoresightX] = options_.roll_of_scanner * kDegree;
    drawn[kScanA] = errors.scan * kDegree * random_.Normal();
    drawn[kScanB] = errors.scan * kDegree * random_.Normal();
    drawn[kBottomRange] = errors.bottom_range * random_.Normal();
    drawn[kSurfaceHeight] = errors.surface_range * std::cos(kIncidence * kDegree) * random_.Normal();
    const Eigen::Matrix<double, kAirUnknowns, 1> none = Eigen::Matrix<double, kAirUnknowns, 1>::Zero();
    const Eigen::Vector3d beam(std::sin(kIncidence * kDegree) * std::cos(azimuth * kDegree),
                               std::sin(kIncidence * kDegree) * std::sin(azimuth * kDegree),
                               std::cos(kIncidence * kDegree));
    const Eigen::Vector3d error =
        ReportedPoint<double>(pulse, false, drawn) - ReportedPoint<double>(pulse, false, none) +
        ErrorOfSlope(beam, options_.wave_slope * random_.Normal(), options_.wave_slope * random_.Normal(), depth);
    const double rough = options_.bottom_waves * std::sqrt(2) * std::sin(x * 0.9 + 0.7 * y + 3 * std::sin(y * 0.31));
    quality::AnnotatedPoint& point = points.emplace_back();
    point.x = x + error.y();
    point.y = y + error.x();
    point.z = -depth - error.z() + rough;
    point.line = number_;
    point.has_number = true;
    point.depth = static_cast<float>(depth);
    point.incidence = static_cast<float>(kIncidence);
    point.tvu_air = static_cast<float>(azimuth);  // Until the budget is computed.
    headings.push_back(course_);
  }

  // Points in the squares where another line saw the bottom, too.
  template <typename Place>
  void Fly(bool whole_swath, const Place& place, std::vector<quality::AnnotatedPoint>& points,
           std::vector<double>& headings) {
    const auto jitter = [&] { return random_.Uniform(0, options_.spacing); };
    for (double along = 0; along + options_.spacing < options_.length; along += options_.spacing)
      for (double across = -kSwath; across < kSwath; across += options_.spacing) {
        if (!whole_swath && std::abs(across) < kLineSpacing - kSwath) continue;
        const double a = along + jitter(), c = across + jitter();
        const auto [x, y] = place(a, c, middle_);
        if (InSquare(x, y)) AddPoint(a, c, x, y, points, headings);
      }
  }

 private:
  const SimulatedLines& options_;
  int number_;
  double course_, middle_;
  RandomNumbers& random_;
  std::vector<SmoothMotion> wander_;  // Errors of the trajectory, of variance 1.
};

// Replaces the azimuth by what the budget makes of it. The axis of the sea is taken as that of each beam, because its
// errors are known along and across it.
void Predict(const AirErrors& errors, const Eigen::Vector3d& sea, const std::vector<double>& headings,
             std::vector<quality::AnnotatedPoint>& points) {
  TotalInputs inputs;
  inputs[BudgetInput::kIncidence] = {kIncidence};
  inputs[BudgetInput::kAltitude] = {kAltitude};
  inputs[BudgetInput::kRefractionAlong] = {static_cast<float>(sea[0])};
  inputs[BudgetInput::kRefractionCross] = {static_cast<float>(sea[1])};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float depth = points[i].depth;
    inputs[BudgetInput::kBeamAzimuth].push_back(points[i].tvu_air);
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
  for (int i = 0; i < options.lines; ++i) {
    const bool back = options.to_and_fro && i % 2 == 1;  // x is east, y north; flown east, and back west.
    Line line(options, i + 1, back ? 270 : 90, i * kLineSpacing, random);
    line.Fly(
        false,
        [&](double along, double across, double middle) {
          return std::pair(back ? options.length - along : along, back ? middle + across : middle - across);
        },
        points, headings);
  }
  for (int i = 0; i < options.cross_lines; ++i) {
    const double middle = (i + 0.5) / options.cross_lines * options.length;
    Line line(options, 101 + i, 0, middle, random);
    line.Fly(
        true,
        [&](double along, double across, double x) {
          return std::pair(x + across, along - (options.length - (options.lines - 1) * kLineSpacing) / 2);
        },
        points, headings);
  }
  AirErrors declared = TrueErrors();
  for (double& each : declared.position) each *= options.declared;
  for (double& each : declared.attitude) each *= options.declared;
  for (double* const each : {&declared.scan, &declared.bottom_range, &declared.surface_range})
    *each *= options.declared;
  Predict(declared, SeaSigmas(options.wave_slope), headings, points);
  return points;
}

}  // namespace albtpu::testing
