#include "generator/water/bottom_detector.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

namespace albtpu {
namespace {

const double kSigmaOfWidth = 1 / (2 * std::sqrt(2 * std::numbers::ln2));
constexpr double kStepsOfPulse = 40;  // Echoes of finer steps are summed into such.
constexpr double kReach = 6;          // in standard deviations of the pulse
constexpr double kGate = 0.1;         // of the maximum

// A waveform and its first two derivatives.
struct Wave {
  double value = 0, slope = 0, curvature = 0;
};

// Moments of a waveform between two times.
struct Area {
  double total = 0, moment = 0;
};

// Samples under a Gaussian pulse.
class Waveform {
 public:
  Waveform(double first, double step, const std::vector<double>& samples, double sigma)
      : first_(first), step_(step), samples_(samples), sigma_(sigma) {}

  Wave At(double time) const {
    Wave wave;
    const auto [begin, end] = Near(time, time);
    for (std::size_t i = begin; i < end; ++i) {
      const double u = (time - TimeOf(i)) / sigma_;
      const double value = samples_[i] * std::exp(-0.5 * u * u);
      wave.value += value;
      wave.slope -= u * value;
      wave.curvature += (u * u - 1) * value;
    }
    const double scale = 1 / (sigma_ * std::sqrt(2 * std::numbers::pi));
    return {wave.value * scale, wave.slope * scale / sigma_, wave.curvature * scale / (sigma_ * sigma_)};
  }

  // Values at every `stride`-th sample, which need no exponential of their own.
  std::vector<double> Scan(std::size_t stride) const {
    const auto reach = static_cast<std::ptrdiff_t>(kReach * sigma_ / step_);
    Eigen::VectorXd kernel(2 * reach + 1);
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
      const double u = static_cast<double>(k) * step_ / sigma_;
      kernel[k + reach] = std::exp(-0.5 * u * u) / (sigma_ * std::sqrt(2 * std::numbers::pi));
    }
    const Eigen::Map<const Eigen::VectorXd> samples(samples_.data(), std::ssize(samples_));
    std::vector<double> values;
    for (std::ptrdiff_t i = 0; i < samples.size(); i += static_cast<std::ptrdiff_t>(stride)) {
      const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, i - reach);
      const std::ptrdiff_t count = std::min(samples.size(), i + reach + 1) - begin;
      values.push_back(samples.segment(begin, count).dot(kernel.segment(begin - i + reach, count)));
    }
    return values;
  }

  Area Between(double from, double to) const {
    Area area;
    const auto [begin, end] = Near(from, to);
    const double root = sigma_ * std::numbers::sqrt2;
    for (std::size_t i = begin; i < end; ++i) {
      const double a = (from - TimeOf(i)) / root, b = (to - TimeOf(i)) / root;
      const double share = (std::erf(b) - std::erf(a)) / 2;
      const double lean = (std::exp(-a * a) - std::exp(-b * b)) * sigma_ / std::sqrt(2 * std::numbers::pi);
      area.total += samples_[i] * share;
      area.moment += samples_[i] * (share * TimeOf(i) + lean);
    }
    return area;
  }

  double sigma() const { return sigma_; }
  double first() const { return first_; }
  double step() const { return step_; }

 private:
  double TimeOf(std::size_t i) const { return first_ + static_cast<double>(i) * step_; }
  std::pair<std::size_t, std::size_t> Near(double from, double to) const {
    const auto place = [&](double time) {
      return static_cast<std::size_t>(
          std::clamp((time - first_) / step_, 0.0, static_cast<double>(samples_.size() - 1)));
    };
    return {place(from - kReach * sigma_), place(to + kReach * sigma_) + 1};
  }

  double first_, step_;
  const std::vector<double>& samples_;
  double sigma_;
};

// `factor` steps to one; each sample is split between its two new neighbours, so that the mean time stays.
std::vector<double> Coarser(std::span<const double> samples, std::size_t factor) {
  if (factor == 1) return {samples.begin(), samples.end()};
  std::vector<double> coarse(samples.size() / factor + 2, 0.0);
  for (std::size_t begin = 0, to = 0; begin < samples.size(); begin += factor, ++to) {
    double sum = 0, moment = 0;
    for (std::size_t k = 0; k < std::min(factor, samples.size() - begin); ++k) {
      sum += samples[begin + k];
      moment += samples[begin + k] * static_cast<double>(k);
    }
    coarse[to] += sum - moment / static_cast<double>(factor);
    coarse[to + 1] += moment / static_cast<double>(factor);
  }
  return coarse;
}

// Where `excess`, of which the first member is a value and the second its slope, is 0 between two times, at one of
// which it is below 0 and at the other above: Newton's steps, halving the interval where they leave it.
template <typename Excess>
double Root(const Excess& excess, double below, double above, double close) {
  double time = (below + above) / 2;
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = excess(time);
    (value < 0 ? below : above) = time;
    double next = slope != 0 ? time - value / slope : below;
    if (!(next > std::min(below, above) && next < std::max(below, above))) next = (below + above) / 2;
    if (std::abs(next - time) < close) return next;
    time = next;
  }
  return time;
}

// Where `wave` crosses `level` between two times on opposite sides of it.
double Crossing(const Waveform& wave, double level, double below, double above) {
  const auto excess = [&](double time) {
    const Wave at = wave.At(time);
    return std::pair(at.value - level, at.slope);
  };
  return Root(excess, below, above, 1e-9 * wave.sigma());
}

struct Shape {
  double peak, height, half, half_after, gate_begin, gate_end;
};

std::optional<Shape> ShapeOf(const Waveform& wave) {
  const auto stride = static_cast<std::size_t>(std::max(1.0, wave.sigma() / 2 / wave.step()));
  const double step = wave.step() * static_cast<double>(stride);
  const std::vector<double> values = wave.Scan(stride);
  const std::size_t count = values.size();
  const auto top = static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
  if (count < 3 || top == 0 || top + 1 >= count || !(values[top] > 0)) return std::nullopt;
  const auto time = [&](std::size_t i) { return wave.first() + step * static_cast<double>(i); };

  Shape shape{};
  const auto slope = [&](double at) {
    const Wave there = wave.At(at);
    return std::pair(there.slope, there.curvature);
  };
  shape.peak = Root(slope, time(top + 1), time(top - 1), 1e-9 * wave.sigma());
  shape.height = wave.At(shape.peak).value;
  const auto first_above = [&](double level) -> double {
    std::size_t i = 0;
    while (i < top && values[i] < level) ++i;
    const double above = i == top ? shape.peak : time(i);
    return Crossing(wave, level, i == 0 ? wave.first() - step : time(i - 1), above);
  };
  const auto last_above = [&](double level) -> std::optional<double> {
    std::size_t i = top;
    while (i < count && (values[i] >= level || i == top)) ++i;
    if (i == count) return std::nullopt;
    return Crossing(wave, level, time(i), i == top + 1 ? shape.peak : time(i - 1));
  };
  const std::optional<double> half_after = last_above(shape.height / 2), gate = last_above(shape.height * kGate);
  if (!half_after || !gate) return std::nullopt;
  shape.half = first_above(shape.height / 2);
  shape.gate_begin = first_above(shape.height * kGate);
  shape.half_after = *half_after;
  shape.gate_end = *gate;
  return shape;
}

struct Window {
  std::size_t begin, count;

  std::span<const double> Of(std::span<const double> samples) const { return samples.subspan(begin, count); }
};

// The samples from `margin` before the first light to `margin` after the last.
Window WithLight(const Echo& echo, double margin) {
  const auto dark = [](double weight) { return weight == 0; };
  const auto first = std::find_if_not(echo.weights.begin(), echo.weights.end(), dark);
  const auto last = std::find_if_not(echo.weights.rbegin(), echo.weights.rend(), dark).base();
  const auto more = static_cast<std::ptrdiff_t>(std::min(margin / echo.step, 1.0 * echo.weights.size()));
  const std::ptrdiff_t begin = std::max<std::ptrdiff_t>(0, first - echo.weights.begin() - more);
  const std::ptrdiff_t end = std::min(std::ssize(echo.weights), last - echo.weights.begin() + more);
  return {static_cast<std::size_t>(begin), static_cast<std::size_t>(std::max(begin, end) - begin)};
}

}  // namespace

std::optional<DetectedBottom> DetectBottom(const Echo& echo, double pulse_length) {
  const auto factor = static_cast<std::size_t>(std::max(1.0, std::floor(pulse_length / (kStepsOfPulse * echo.step))));
  const double step = echo.step * static_cast<double>(factor), sigma = pulse_length * kSigmaOfWidth;
  const Window window = WithLight(echo, 2 * kReach * sigma);
  const std::vector<double> weights = Coarser(window.Of(echo.weights), factor);
  const std::vector<double> delays = Coarser(window.Of(echo.delays), factor);
  const std::vector<double> losses = Coarser(window.Of(echo.losses), factor);
  const double first = echo.TimeAt(static_cast<double>(window.begin));
  const Waveform wave(first, step, weights, sigma), delayed(first, step, delays, sigma),
      lost(first, step, losses, sigma);
  const std::optional<Shape> found = ShapeOf(wave);
  if (!found) return std::nullopt;
  const Shape& at = *found;

  DetectedBottom bottom;
  bottom.width = at.half_after - at.half;
  // A tilt delays light and loses some of it, by which the waveform y changes by u = -delayed' - lost. That changes the
  // equation that each detector solves: y' = 0 at the peak, y(half) = y(peak) / 2, and the ratio of two integrals whose
  // limits solve y = y(peak) / 10.
  const auto rise = [&](double time) { return -delayed.At(time).slope - lost.At(time).value; };
  const double rise_of_slope = -delayed.At(at.peak).curvature - lost.At(at.peak).slope, peak = rise(at.peak);
  bottom.by[Index(Detector::kPeak)] = {at.peak, -rise_of_slope / wave.At(at.peak).curvature};
  bottom.by[Index(Detector::kHalf)] = {at.half + pulse_length / 2,
                                       (0.5 * peak - rise(at.half)) / wave.At(at.half).slope};
  const auto in_gate = [&](const Waveform& of) { return of.Between(at.gate_begin, at.gate_end); };
  const Area area = in_gate(wave), lost_area = in_gate(lost);
  const double centroid = area.moment / area.total;
  double change = in_gate(delayed).total - (lost_area.moment - centroid * lost_area.total);
  for (const double end : {at.gate_begin, at.gate_end}) {
    const Wave there = wave.At(end);
    const double moved = (kGate * peak - rise(end)) / there.slope;
    const double edge = (end - centroid) * (there.value * moved - delayed.At(end).value);
    change += end == at.gate_end ? edge : -edge;
  }
  bottom.by[Index(Detector::kCentroid)] = {centroid, change / area.total};
  return bottom;
}

DetectedBottom ClearBottom(const EchoSetup& setup, double pulse_length) {
  // Time and point are jointly normal: both grow with where on the surface the light went in.
  const double spread = setup.footprint / 4 / std::cos(setup.incidence);
  const double slope = std::sin(setup.incidence) / setup.group_index;
  const double sigma = std::hypot(pulse_length * kSigmaOfWidth, slope * spread);
  DetectedBottom bottom;
  bottom.width = sigma / kSigmaOfWidth;
  const double ahead = -slope * spread * spread * std::sqrt(2 * std::numbers::ln2) / sigma;
  bottom.by[Index(Detector::kHalf)] = {(pulse_length - bottom.width) / 2, ahead / std::cos(setup.refracted)};
  return bottom;
}

}  // namespace albtpu
