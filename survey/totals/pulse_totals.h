// The total uncertainty of batches of pulses, from the share of the sea and the motion of the aircraft.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "budget/total/budget_columns.h"
#include "survey/answers/batch.h"
#include "survey/totals/total_plan.h"

namespace albtpu::client {

// One element for each pulse, or one for all, or none (BudgetInput).
struct AircraftColumns {
  std::vector<float> altitude;      // m, of the sensor above the water.
  std::vector<float> beam_azimuth;  // degree from true north. None: not known.
  // From kRoll to kHeadingSigma. NaN in a sigma: not known.
  static constexpr std::size_t kMotions = 15;
  std::array<std::vector<float>, kMotions> motion;

  std::vector<float>& operator[](BudgetInput input) {
    return motion[static_cast<std::size_t>(input) - static_cast<std::size_t>(BudgetInput::kRoll)];
  }
};
static_assert(static_cast<std::size_t>(BudgetInput::kHeadingSigma) ==
              static_cast<std::size_t>(BudgetInput::kRoll) + AircraftColumns::kMotions - 1);

// Element i of each column belongs to pulse i; NaN where the sea has no answer.
struct TotalBatch {
  std::vector<float> thu, tvu;  // m, at the coverage of the plan.
  std::vector<float> thu_air, tvu_air, thu_sea, tvu_sea, thu_water, tvu_water;  // The same of shares.
  std::array<std::vector<float>, 6> covariance;  // m^2: kCovarianceNames, of the total.
  // Variances, m^2: horizontal (north and east) and vertical.
  struct Variances {
    std::vector<float> north, east, down;
  };
  Variances air, sea, of_water;
  std::array<Variances, kErrorGroups> groups;
  std::vector<std::uint8_t> best_orders;
  WaterBatch water;  // By AddWater, before all else. Empty: the water column is left out.
  std::uint64_t sigmas_assumed =
      0;  // Pulses at whose time no error file states how well the trajectory is known.

  std::size_t size() const { return thu.size(); }
};

// What the answers of the sea must have, at 2 sigma.
void SelectForTotals(AnswerSelection& selection);

// The columns of a budget, which refer to this and to the arguments.
class TotalInputs {
 public:
  // `aircraft` is changed: sigmas that are not known, or not wanted by pulse, become those of the plan.
  TotalInputs(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea,
              const WaterBatch& water, AircraftColumns& aircraft);
  TotalInputs(const TotalInputs&) = delete;
  TotalInputs& operator=(const TotalInputs&) = delete;

  const BudgetInputs& columns() const { return columns_; }
  bool directed() const { return directed_; }  // The direction of the beam is known.
  std::uint64_t sigmas_assumed() const { return sigmas_assumed_; }

 private:
  BudgetInputs columns_;
  std::vector<float> bias_along_, bias_vertical_;
  float sea_axis_, wave_height_;
  bool directed_;
  std::uint64_t sigmas_assumed_ = 0;
};

// `aircraft` is changed: sigmas that are not known, or not wanted by pulse, become those of the plan. `totals.water` is
// taken, and `sea` has its biases.
void ComputeTotals(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea,
                   AircraftColumns& aircraft, TotalBatch& totals);

// The covariance of pulse i, whose columns are NN EE DD NE ND ED, on the axes of a map grid: XX YY ZZ XY XZ YZ, z up.
// `convergence` [rad] is the true azimuth of its y axis.
std::array<float, 6> OnGridAxes(const std::array<std::vector<float>, 6>& covariance, std::size_t i,
                                float convergence);

}  // namespace albtpu::client
