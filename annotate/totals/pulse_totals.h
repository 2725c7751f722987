// The total uncertainty of batches of pulses, from the share of the sea and the motion of the aircraft.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "annotate/answers/batch.h"
#include "annotate/totals/plan_total.h"
#include "budget/query/budget_query.h"

namespace albtpu::annotate {

// Element i of each column belongs to pulse i; NaN where the sea has no answer.
struct TotalBatch {
  std::vector<float> thu, tvu;                                                  // m, at the coverage of the plan.
  std::vector<float> thu_air, tvu_air, thu_sea, tvu_sea, thu_water, tvu_water;  // The same of shares.
  ExtraUncertainty extra;  // The same of what the surveyor adds to every pulse, and its variances, m^2.
  float extra_horizontal_variance = 0, extra_vertical_variance = 0;
  // m^2, 1 sigma, the entries kCovarianceNames: of the total, of shares and of groups. Of shares and groups only the
  // variances (NN EE DD), unless they are wanted whole.
  using Covariance = std::array<std::vector<float>, 6>;
  Covariance covariance, air, sea, of_water;
  std::array<Covariance, kErrorGroups> groups;
  bool whole = false;
  std::vector<std::uint8_t> best_orders;
  WaterBatch water;                  // By AddWater, before all else. Empty: the water column is left out.
  std::uint64_t sigmas_assumed = 0;  // Pulses at whose time no error file states how well the trajectory is known.

  std::size_t size() const { return thu.size(); }
};

// What the answers of the sea must have, at 2 sigma.
void SelectForTotals(AnswerSelection& selection);

// `aircraft` has altitudes, azimuths (none: not known) and motions. It is changed: sigmas that are not known, or not
// wanted by pulse, become those of the plan. `totals.water` is taken, and `sea` has its biases.
void ComputeTotals(const TotalPlan& plan, const PulseBatch& pulses, const AnswerBatch& sea, AircraftColumns& aircraft,
                   TotalBatch& totals);

// The same of dry points, whose beams met neither a sea nor water: all but surface, index and water column, and the
// range to a hard target (TotalPlan::hard_range). `incidence` in degrees, in air; altitudes are heights of the sensor
// above the points. Of `totals` the columns of sea and water stay empty.
//
// The formulas are those of a pulse in water of the index 1 and no depth: nothing refracts, so that the height of a
// surface moves no point.
void ComputeDryTotals(const TotalPlan& plan, std::span<const float> incidence, AircraftColumns& aircraft,
                      TotalBatch& totals);

// The covariance of pulse i, whose columns are NN EE DD NE ND ED, on the axes of a map grid: XX YY ZZ XY XZ YZ, z up.
// `convergence` [rad] is the true azimuth of its y axis.
std::array<float, 6> OnGridAxes(const TotalBatch::Covariance& covariance, std::size_t i, float convergence);

}  // namespace albtpu::annotate
