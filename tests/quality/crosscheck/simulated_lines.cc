#include "tests/quality/crosscheck/simulated_lines.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "budget/total/budget_columns.h"
#include "tests/budget/air/air_forward.h"

namespace albtpu::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAltitude = 400, kIncidence = 20, kIndex = 1.34, kSpeed = 60;
constexpr double kLineSpacing = 240;
constexpr double kSwath = 140;  // m on each side; the cone of 20 degrees reaches 146 m.

using Random = std::mt19937_64;

double Normal(Random& random) { return std::normal_distribution<double>()(random); }

// `slope`: the root mean square of that of ridges 150 m apart.
double Depth(double x, double y, double slope) {
  constexpr double kWavenumber = 2 * std::numbers::pi / 150;
  const double ridges = std::sqrt(2) * slope / kWavenumber * (1 + std::sin(kWavenumber * (x + 0.5 * y)));
  return 9 + 7 * std::sin(x / 900 + 1) + 1.5 * std::sin(y / 400) + ridges;
}

// A process of mean 0 and variance 1 whose correlation falls to 1/e over `memory`.
class Wander {
 public:
  Wander(double seconds, double memory, Random& random) : step_(memory / 20) {
    const double keep = std::exp(-step_ / memory);
    double value = Normal(random);
    for (double t = 0; t <= seconds + 2 * step_; t += step_) {
      values_.push_back(value);
      value = keep * value + std::sqrt(1 - keep * keep) * Normal(random);
    }
  }
  double At(double time) const { return values_[static_cast<std::size_t>(time / step_)]; }

 private:
  double step_;
  std::vector<double> values_;
};

// What a surface of this slope does to the reported point, reported less true: the beam (unit, z down) goes on where
// Snell's law sends it at the tilted surface, until it meets the bottom; processing assumes a level surface and the
// same length of path.
Eigen::Vector3d ErrorOfSlope(const Eigen::Vector3d& beam, double slope_x, double slope_y, double depth) {
  const auto refracted = [&](Eigen::Vector3d normal) -> Eigen::Vector3d {
    normal.normalize();
    const double cosine = beam.dot(normal), ratio = 1 / kIndex;
    return ratio * beam + (std::sqrt(1 - ratio * ratio * (1 - cosine * cosine)) - ratio * cosine) * normal;
  };
  const Eigen::Vector3d level = refracted({0, 0, 1}), tilted = refracted({slope_x, slope_y, 1});
  return depth / tilted.z() * (level - tilted);
}

// The standard deviations of the above along the beam, across it and down, in m for a depth of 1 m, by a simulation of
// its own.
Eigen::Vector3d SeaSigmas(double wave_slope) {
  Random random(4711);
  const Eigen::Vector3d beam(std::sin(kIncidence * kDegree), 0, std::cos(kIncidence * kDegree));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d error = ErrorOfSlope(beam, wave_slope * Normal(random), wave_slope * Normal(random), 1);
    sum += error / kDraws;
    squares += error.cwiseAbs2() / kDraws;
  }
  return (squares - sum.cwiseAbs2()).cwiseSqrt();
}

class Line {
 public:
  Line(const SimulatedLines& options, int number, double course, double middle, Random& random)
      : options_(options), number_(number), course_(course), middle_(middle), random_(random) {
    for (int i = 0; i < 6; ++i) wander_.emplace_back(options.length / kSpeed, options.memory, random);
  }

  // At `along` and `across` (m, right positive) of the line.
  void AddPoint(double along, double across, double x, double y, std::vector<quality::AnnotatedPoint>& points,
                std::vector<double>& headings) {
    const double sine = std::clamp(across / (kAltitude * std::tan(kIncidence * kDegree)), -1.0, 1.0);
    const bool backward = std::uniform_int_distribution<int>(0, 1)(random_) == 1;
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
                         .index = kIndex};
    const AirErrors errors = TrueErrors();
    Eigen::Matrix<double, kAirUnknowns, 1> drawn = Eigen::Matrix<double, kAirUnknowns, 1>::Zero();
    const double time = along / kSpeed;
    for (int i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      drawn[kNorth + i] = errors.position[axis] * wander_[axis].At(time);
      drawn[kRoll + i] = errors.attitude[axis] * kDegree * wander_[axis + 3].At(time);
    }
    drawn[kBoresightX] = options_.roll_of_scanner * kDegree;
    drawn[kScanA] = errors.scan * kDegree * Normal(random_);
    drawn[kScanB] = errors.scan * kDegree * Normal(random_);
    drawn[kBottomRange] = errors.bottom_range * Normal(random_);
    drawn[kSurfaceHeight] = errors.surface_range * std::cos(kIncidence * kDegree) * Normal(random_);
    const Eigen::Matrix<double, kAirUnknowns, 1> none = Eigen::Matrix<double, kAirUnknowns, 1>::Zero();
    const Eigen::Vector3d beam(std::sin(kIncidence * kDegree) * std::cos(azimuth * kDegree),
                               std::sin(kIncidence * kDegree) * std::sin(azimuth * kDegree),
                               std::cos(kIncidence * kDegree));
    const Eigen::Vector3d error =
        ReportedPoint<double>(pulse, false, drawn) - ReportedPoint<double>(pulse, false, none) +
        ErrorOfSlope(beam, options_.wave_slope * Normal(random_), options_.wave_slope * Normal(random_), depth);
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

  // Points where another line saw the bottom, too.
  template <typename Place>
  void Fly(bool whole_swath, const Place& place, std::vector<quality::AnnotatedPoint>& points,
           std::vector<double>& headings) {
    std::uniform_real_distribution<double> jitter(0, options_.spacing);
    for (double along = 0; along + options_.spacing < options_.length; along += options_.spacing)
      for (double across = -kSwath; across < kSwath; across += options_.spacing) {
        if (!whole_swath && std::abs(across) < kLineSpacing - kSwath) continue;
        const double a = along + jitter(random_), c = across + jitter(random_);
        const auto [x, y] = place(a, c, middle_);
        AddPoint(a, c, x, y, points, headings);
      }
  }

 private:
  const SimulatedLines& options_;
  int number_;
  double course_, middle_;
  Random& random_;
  std::vector<Wander> wander_;
};

// Replaces the azimuth by what the budget makes of it. The axis of the sea is taken as that of each beam, because its
// errors are known along and across it.
void Predict(const AirErrors& errors, const Eigen::Vector3d& sea, const std::vector<double>& headings,
             std::vector<quality::AnnotatedPoint>& points) {
  const std::size_t size = points.size();
  std::array<std::vector<float>, kBudgetInputCount> columns;
  BudgetInputs inputs{.size = size};
  const auto add = [&](BudgetInput input, auto value) {
    std::vector<float>& column = columns[static_cast<std::size_t>(input)];
    for (std::size_t i = 0; i < size; ++i) column.push_back(static_cast<float>(value(i)));
    inputs[input] = column;
  };
  const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
  add(BudgetInput::kIncidence, constant(kIncidence));
  add(BudgetInput::kAltitude, constant(kAltitude));
  add(BudgetInput::kBeamAzimuth, [&](std::size_t i) { return points[i].tvu_air; });
  add(BudgetInput::kHeading, [&](std::size_t i) { return headings[i]; });
  add(BudgetInput::kDepth, [&](std::size_t i) { return points[i].depth; });
  add(BudgetInput::kSeaThu, [&](std::size_t i) { return 2 * std::hypot(sea[0], sea[1]) * points[i].depth; });
  add(BudgetInput::kSeaTvu, [&](std::size_t i) { return 2 * sea[2] * points[i].depth; });
  add(BudgetInput::kRefractionAlong, constant(sea[0]));
  add(BudgetInput::kRefractionCross, constant(sea[1]));
  add(BudgetInput::kSeaAxis, [&](std::size_t i) { return points[i].tvu_air; });
  std::vector<float> thu(size), tvu(size), air(size), thu_sea(size), tvu_sea(size), pulse(size), line(size);
  std::array<std::vector<float>, 6> total;
  BudgetOutputs outputs;
  outputs.thu = thu;
  outputs.tvu = tvu;
  outputs.tvu_air = air;
  outputs.thu_sea = thu_sea;
  outputs.tvu_sea = tvu_sea;
  for (std::size_t i = 0; i < total.size(); ++i) {
    total[i].resize(size);
    outputs.total[i] = total[i];
  }
  outputs.groups[0][2] = pulse;
  outputs.groups[1][2] = line;
  BudgetOptions options{.errors = errors, .index = kIndex, .coverage = Coverage::kOneSigma};
  ComputeBudget(inputs, options, outputs);
  for (std::size_t i = 0; i < size; ++i) {
    points[i].thu = thu[i];
    points[i].tvu = tvu[i];
    points[i].tvu_air = air[i];
    points[i].thu_sea = thu_sea[i];
    points[i].tvu_sea = tvu_sea[i];
    points[i].tvu_pulse = std::sqrt(pulse[i]);
    points[i].tvu_line = std::sqrt(line[i]);
    const auto of = [&](std::size_t entry) { return total[entry][i]; };  // NN EE DD NE ND ED
    points[i].variance_x = of(1);
    points[i].variance_y = of(0);
    points[i].variance_z = of(2);
    points[i].covariance_xy = of(3);
    points[i].covariance_xz = -of(5);
    points[i].covariance_yz = -of(4);
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
  Random random(options.seed);
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
