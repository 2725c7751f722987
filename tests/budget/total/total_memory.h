// Columns of what a total is computed from, and of the total.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "budget/total/budget_columns.h"

namespace albtpu::testing {

struct TotalInputs : AircraftColumns {
  double at(BudgetInput input, std::size_t i) const {
    const std::vector<float>& column = (*this)[input];
    return column.empty() ? 0 : column[column.size() == 1 ? 0 : i];
  }
  // Of as many pulses as the longest column has.
  BudgetInputs inputs() const {
    BudgetInputs inputs;
    for (std::size_t i = 0; i < kBudgetInputCount; ++i) {
      inputs.columns[i] = columns[i];
      inputs.size = std::max(inputs.size, columns[i].size());
    }
    return inputs;
  }
};

struct InputRange {
  BudgetInput input;
  float least, most;
};

// An aircraft over the water.
inline constexpr InputRange kAircraftRanges[] = {
    {BudgetInput::kAltitude, 100, 800},    {BudgetInput::kBeamAzimuth, -180, 360},
    {BudgetInput::kHeading, -180, 360},    {BudgetInput::kRoll, -20, 20},
    {BudgetInput::kPitch, -20, 20},        {BudgetInput::kVelocityNorth, -80, 80},
    {BudgetInput::kVelocityEast, -80, 80}, {BudgetInput::kVelocityDown, -80, 80},
    {BudgetInput::kRollRate, -6, 6},       {BudgetInput::kPitchRate, -6, 6},
    {BudgetInput::kYawRate, -6, 6},
};

// `size` numbers of each range, one column after the other.
template <typename Columns>
void Draw(std::span<const InputRange> ranges, std::size_t size, std::mt19937& random, Columns& columns) {
  for (const auto& [input, least, most] : ranges)
    for (std::size_t i = 0; i < size; ++i)
      columns[input].push_back(least +
                               (most - least) * static_cast<float>(random() >> 8) / static_cast<float>(1 << 24));
}

enum TotalPart { kAirPart, kSeaPart, kWaterPart, kTotalPart, kPulsePart, kLinePart, kSurveyPart };

struct TotalMemory {
  explicit TotalMemory(std::size_t size) : orders(size) {
    for (auto& column : numbers) column.resize(size);
  }
  BudgetOutputs outputs() {
    BudgetOutputs outputs{.thu = numbers[0],
                          .tvu = numbers[1],
                          .thu_air = numbers[2],
                          .tvu_air = numbers[3],
                          .thu_sea = numbers[4],
                          .tvu_sea = numbers[5],
                          .thu_water = numbers[6],
                          .tvu_water = numbers[7],
                          .best_orders = orders};
    std::size_t next = 8;
    for (CovarianceColumns* columns : {&outputs.air, &outputs.sea, &outputs.water, &outputs.total, &outputs.groups[0],
                                       &outputs.groups[1], &outputs.groups[2]})
      for (std::span<float>& column : *columns) column = numbers[next++];
    return outputs;
  }
  Eigen::Matrix3d Covariance(TotalPart part, std::size_t i) const {
    const auto at = [&](std::size_t entry) { return static_cast<double>(numbers[8 + 6 * part + entry][i]); };
    return (Eigen::Matrix3d() << at(0), at(3), at(4), at(3), at(1), at(5), at(4), at(5), at(2)).finished();
  }

  std::array<std::vector<float>, 8 + 7 * 6> numbers;
  std::vector<std::uint8_t> orders;
};

}  // namespace albtpu::testing
