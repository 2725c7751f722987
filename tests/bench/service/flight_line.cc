#include "tests/bench/service/flight_line.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <numbers>
#include <random>

namespace albtpu::bench {

FlightLine::FlightLine(std::size_t pulse_count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < pulse_count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i % 400) / 400;
    const double incidence = 17 + 3 * std::sin(turn) + 0.2 * normal(random);
    const double along = static_cast<double>(i) / static_cast<double>(pulse_count);
    incidence_.push_back(static_cast<float>(incidence));
    azimuth_.push_back(static_cast<float>(turn * 180 / std::numbers::pi - 180));
    footprint_.push_back(static_cast<float>(0.6 / std::cos(incidence * std::numbers::pi / 180)));
    depth_.push_back(static_cast<float>(std::abs(1 + 20 * along + std::sin(turn) + 0.3 * normal(random))));
  }
}

PulseColumns FlightLine::pulses(std::size_t begin, std::size_t count) const {
  const auto some = [=](const std::vector<float>& column) { return std::span(column).subspan(begin, count); };
  return {.size = count,
          .axis = {std::span(&wind_speed_, 1), {}, some(incidence_), some(azimuth_), some(footprint_), some(depth_)}};
}

AnswerMemory::AnswerMemory(std::size_t pulse_count) : outcomes_(pulse_count), axes_(pulse_count) {
  for (std::vector<float>& column : values_) column.resize(pulse_count);
}

AnswerColumns AnswerMemory::columns(std::size_t begin) {
  AnswerColumns columns;
  columns.outcomes = outcomes_.data() + begin;
  columns.outcome_axes = axes_.data() + begin;
  for (std::size_t q = 0; q < kAskedQuantities; ++q) columns.values[q] = values_[q].data() + begin;
  return columns;
}

void AnswerMemory::ExpectSame(const AnswerMemory& expected) const {
  bool same = outcomes_ == expected.outcomes_ && axes_ == expected.axes_;
  for (std::size_t q = 0; q < kAskedQuantities; ++q) {
    const std::vector<float>&ours = values_[q], &theirs = expected.values_[q];
    same = same && std::memcmp(ours.data(), theirs.data(), theirs.size() * sizeof(float)) == 0;
  }
  if (same) return;
  std::cerr << "service_bench: answers differ from those of the table itself\n";
  std::exit(1);
}

}  // namespace albtpu::bench
