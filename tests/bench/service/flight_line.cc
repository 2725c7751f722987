#include "tests/bench/service/flight_line.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "tests/budget/query/budget_memory.h"

namespace albtpu::bench {
namespace {

// Of altitude, beam azimuth, attitude, velocity and rates.
constexpr std::array<double, kBudget.columns - kSeaSurface.columns> kMeans = {400, 90,  1,   4,    30, 58,
                                                                              31,  0.4, 1.9, -0.8, 0.6};

}  // namespace

PulseColumns PulsesOf(const float& wind_speed, const Columns& columns) {
  return {.size = columns[0].size(),
          .axis = {std::span(&wind_speed, 1), {}, columns[0], columns[1], columns[2], columns[3]}};
}

BudgetPulses BudgetPulsesOf(const float& wind_speed, const Columns& columns) {
  BudgetPulses pulses{.pulses = PulsesOf(wind_speed, columns), .sea_axis = 70};
  pulses.aircraft.size = pulses.pulses.size;
  for (std::size_t i = kSeaSurface.columns; i < columns.size(); ++i)
    pulses.aircraft[kAircraftInputs[i - kSeaSurface.columns]] = columns[i];
  return pulses;
}

AnswerColumns AnswersIn(float* numbers, std::uint8_t* outcomes, std::size_t count) {
  AnswerColumns answers;
  for (std::size_t q = 0; q < kSeaSurface.quantities; ++q) answers.values[q] = numbers + q * count;
  answers.outcomes = outcomes;
  answers.outcome_axes = outcomes + count;
  return answers;
}

BudgetAnswers BudgetAnswersIn(float* numbers, std::uint8_t* outcomes, std::size_t count) {
  BudgetAnswers answers{.outcomes = outcomes};
  answers.outcome_axes = outcomes + count;
  answers.columns[FirstColumn(BudgetQuantity::kTotalThu)] = numbers;
  answers.columns[FirstColumn(BudgetQuantity::kTotalTvu)] = numbers + count;
  return answers;
}

BudgetOptions OptionsOfBudget() {
  BudgetOptions options = testing::UsualOptions();
  options.coverage = Coverage::kTwoSigma;
  return options;
}

FlightLine::FlightLine(std::size_t pulse_count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < pulse_count; ++i) {
    const double turn = 2 * std::numbers::pi * static_cast<double>(i % 400) / 400;
    const double incidence = 17 + 3 * std::sin(turn) + 0.2 * normal(random);
    const double along = static_cast<double>(i) / static_cast<double>(pulse_count);
    columns_[0].push_back(static_cast<float>(incidence));
    columns_[1].push_back(static_cast<float>(turn * 180 / std::numbers::pi - 180));
    columns_[2].push_back(static_cast<float>(0.6 / std::cos(incidence * std::numbers::pi / 180)));
    columns_[3].push_back(static_cast<float>(std::abs(1 + 20 * along + std::sin(turn) + 0.3 * normal(random))));
    for (std::size_t c = 0; c < kMeans.size(); ++c) {
      const double wave = std::sin(0.001 * static_cast<double>(i * (c + 1)));
      columns_[kSeaSurface.columns + c].push_back(static_cast<float>(kMeans[c] * (1 + 0.1 * wave)));
    }
  }
}

Columns FlightLine::columns(std::size_t begin, std::size_t count) const {
  Columns some;
  for (std::size_t c = 0; c < some.size(); ++c) some[c] = std::span(columns_[c]).subspan(begin, count);
  return some;
}

AnswerMemory::AnswerMemory(std::size_t pulse_count)
    : size_(pulse_count), numbers_(kSeaSurface.quantities * pulse_count), outcomes_(2 * pulse_count) {}

AnswerColumns AnswerMemory::columns(std::size_t begin) {
  return AnswersIn(numbers_.data() + begin, outcomes_.data() + begin, size_);
}

void AnswerMemory::Put(const Question& question, std::size_t begin, std::size_t count, const char* bytes) {
  for (std::size_t q = 0; q < question.quantities; ++q, bytes += count * sizeof(float))
    std::memcpy(numbers_.data() + q * size_ + begin, bytes, count * sizeof(float));
  std::memcpy(outcomes_.data() + begin, bytes, count);
  std::memcpy(outcomes_.data() + size_ + begin, bytes + count, count);
}

bool AnswerMemory::operator==(const AnswerMemory& other) const {
  return outcomes_ == other.outcomes_ && numbers_.size() == other.numbers_.size() &&
         std::memcmp(numbers_.data(), other.numbers_.data(), numbers_.size() * sizeof(float)) == 0;
}

}  // namespace albtpu::bench
