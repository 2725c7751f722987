// The pulses of a scanner and memory for their answers, for the benchmarks of the service.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "budget/query/budget_query.h"
#include "tables/query/column_query.h"

namespace albtpu::bench {

// What is asked for pulses, and how many columns of numbers this takes in the request and in the answer. Columns of the
// request: incidence, azimuth, footprint and depth; for the budget, then those of the aircraft up to the rates.
struct Question {
  std::size_t columns, quantities;
};
inline constexpr Question kSeaSurface = {.columns = 4, .quantities = 4};  // Both refractions, THU and TVU.
inline constexpr Question kBudget = {.columns = 15, .quantities = 2};     // THU and TVU of all contributions.
using Columns = std::array<std::span<const float>, kBudget.columns>;

// The wind of all pulses must outlive the result.
PulseColumns PulsesOf(const float& wind_speed, const Columns& columns);
BudgetPulses BudgetPulsesOf(const float& wind_speed, const Columns& columns);

// Quantities of an answer as columns of `count` numbers that follow each other, and outcomes before their axes.
AnswerColumns AnswersIn(float* numbers, std::uint8_t* outcomes, std::size_t count);
BudgetAnswers BudgetAnswersIn(float* numbers, std::uint8_t* outcomes, std::size_t count);

BudgetOptions OptionsOfBudget();

// The pulses of a circular scan, 400 for each turn, over a sloping, rough bottom: one wind over a fully developed sea.
// All are within the table `survey`.
class FlightLine {
 public:
  explicit FlightLine(std::size_t pulse_count);

  std::size_t size() const { return columns_[0].size(); }
  const float& wind_speed() const { return wind_speed_; }
  Columns columns(std::size_t begin, std::size_t count) const;
  PulseColumns pulses(std::size_t begin, std::size_t count) const {
    return PulsesOf(wind_speed_, columns(begin, count));
  }

 private:
  float wind_speed_ = 6.5f;
  std::array<std::vector<float>, kBudget.columns> columns_;
};

class AnswerMemory {
 public:
  explicit AnswerMemory(std::size_t pulse_count);

  AnswerColumns columns(std::size_t begin = 0);  // From this pulse on.
  BudgetAnswers budget() { return BudgetAnswersIn(numbers(), outcomes(), size_); }
  float* numbers() { return numbers_.data(); }  // All columns, as AnswersIn takes them.
  std::uint8_t* outcomes() { return outcomes_.data(); }
  // Takes the bytes of `count` answers from the pulse `begin` on: quantities, outcomes and axes, each a column.
  void Put(const Question& question, std::size_t begin, std::size_t count, const char* bytes);
  bool operator==(const AnswerMemory& other) const;  // Bit by bit.

 private:
  std::size_t size_;
  std::vector<float> numbers_;
  std::vector<std::uint8_t> outcomes_;
};

}  // namespace albtpu::bench
