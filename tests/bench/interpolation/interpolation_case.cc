#include "tests/bench/interpolation/interpolation_case.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>
#include <utility>

namespace albtpu::bench {
namespace {

constexpr float kRadians = std::numbers::pi_v<float> / 180;

template <typename Value>
Value OrDie(absl::StatusOr<Value> value) {
  if (!value.ok()) {
    std::cerr << value.status() << "\n";
    std::abort();
  }
  return *std::move(value);
}

// `count` nodes from `first` to `last`, even in the scale of the axis.
Axis AxisOf(AxisId id, std::size_t count, double first, double last) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(count - 1);
    const double node =
        Describe(id).scale == Scale::kLog ? first * std::pow(last / first, t) : first + t * (last - first);
    nodes.push_back(static_cast<float>(node));
  }
  return OrDie(Axis::Create(id, nodes));
}

std::vector<float> Numbers(std::size_t count, std::minstd_rand& random) {
  std::vector<float> numbers(count);
  std::uniform_real_distribution<float> number(0.5f, 1.5f);
  for (float& n : numbers) n = number(random);
  return numbers;
}

std::array<std::size_t, kAxisCount> ShapeOf(int megabytes) {
  if (megabytes <= 5) return {8, 5, 8, 7, 8, 16};
  if (megabytes <= 15) return {10, 6, 10, 7, 10, 22};
  return {20, 12, 16, 10, 16, 22};
}

}  // namespace

UncertaintyTable TableOf(int megabytes) {
  const auto [wind_speeds, fetches, incidences, azimuths, footprints, depths] = ShapeOf(megabytes);
  UncertaintyTable::Axes axes = {
      AxisOf(AxisId::kWindSpeed, wind_speeds, 1, 15), AxisOf(AxisId::kFetch, fetches, 1e3, 1e6),
      AxisOf(AxisId::kIncidence, incidences, 0, 25),  AxisOf(AxisId::kAzimuth, azimuths, 0, 90),
      AxisOf(AxisId::kFootprint, footprints, 0.1, 5), AxisOf(AxisId::kDepth, depths, 0, 40)};
  std::minstd_rand random(1);
  UncertaintyTable::Variables variables;
  for (Quantity quantity : kQuantities) {
    const std::size_t count = ValueCount(axes, quantity);
    std::vector<float> values = Numbers(count, random);
    variables[Index(quantity)] = Variable{std::move(values), Numbers(count, random), Scale::kLinear};
  }
  return OrDie(UncertaintyTable::Create(std::move(axes), std::move(variables),
                                        {.id = "bench",
                                         .version = "1",
                                         .title = "Random numbers",
                                         .campaign = "[campaign]\nid = \"bench\"\n",
                                         .attributes = {}}));
}

PulseBatch::PulseBatch(const UncertaintyTable& table, Order order, std::size_t count, bool azimuth_absent) {
  if (order == Order::kScan)
    FlyLine(count);
  else
    Scatter(table, count);
  if (azimuth_absent) numbers_[Index(AxisId::kAzimuth)].clear();
  columns_.size = count;
  for (AxisId axis : kAxes) columns_.axis[Index(axis)] = numbers_[Index(axis)];
}

void PulseBatch::FlyLine(std::size_t count) {
  numbers_[Index(AxisId::kWindSpeed)] = {5.3f};
  numbers_[Index(AxisId::kFetch)] = {4.2e4f};
  for (std::size_t i = 0; i < count; ++i) {
    const float sweep = static_cast<float>(i % 2000) / 1000;  // 0 to 2: there and back
    const float scan_angle = 20 * (sweep < 1 ? 2 * sweep - 1 : 3 - 2 * sweep);
    const float incidence = std::abs(scan_angle);
    const auto along = static_cast<float>(i);
    numbers_[Index(AxisId::kIncidence)].push_back(incidence);
    numbers_[Index(AxisId::kAzimuth)].push_back(scan_angle > 0 ? 37.0f : 143.0f + 74);
    numbers_[Index(AxisId::kFootprint)].push_back(0.45f / std::cos(incidence * kRadians));
    numbers_[Index(AxisId::kDepth)].push_back(6 + 4 * std::sin(along / 9000) + 0.2f * std::sin(along / 150));
  }
}

void PulseBatch::Scatter(const UncertaintyTable& table, std::size_t count) {
  std::mt19937 random(1);
  for (const Axis& axis : table.axes()) {
    const bool log = axis.scale() == Scale::kLog;
    const double first = axis.nodes().front(), last = axis.nodes().back();
    std::uniform_real_distribution<double> scaled(log ? std::log(first) : first, log ? std::log(last) : last);
    for (std::size_t i = 0; i < count; ++i) {
      const double coordinate = log ? std::exp(scaled(random)) : scaled(random);
      numbers_[Index(axis.id())].push_back(static_cast<float>(std::clamp(coordinate, first, last)));
    }
  }
}

}  // namespace albtpu::bench
