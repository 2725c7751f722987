#include "validation/studies/closed_form_ratio.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sea/angle.h"
#include "sea/response/closed_form.h"
#include "sea/sea_state.h"
#include "validation/report/study.h"

namespace albtpu {
namespace {

Estimate Over(const Estimate& ours, double theory) {
  if (theory == 0) return {kNoNumber, kNoNumber};
  return {ours.value / theory, ours.standard_error / theory};
}

}  // namespace

SeaCaseRatios CompareWithClosedForm(const SeaCase& sea_case, int realizations, std::uint64_t seed, std::uint32_t cell) {
  assert(sea_case.depths.size() == 1 && sea_case.depths[0] > 0);
  const SeaCaseResult result =
      Simulate(sea_case, {.realizations = realizations, .most_realizations = realizations}, seed, cell);
  const SeaState sea(sea_case.sea);
  SeaCaseRatios ratios{{}, SlopeCovariance(sea).trace(), 1};
  for (std::size_t b = 0; b < sea_case.beams.size(); ++b) {
    const BeamOptions& beam = sea_case.beams[b];
    const BeamUncertainty& ours = result.beams[b];
    const SmallSlopeUncertainty theory = ClosedForm(sea, beam, sea_case.refractive_index);
    const double depth = sea_case.depths[0];
    const double tvu = beam.incidence == 0 ? 0 : depth * theory.tvu_per_depth;
    ratios.beams.push_back({Over(ours.refraction_along_wind, theory.refraction_along_wind),
                            Over(ours.refraction_cross_wind, theory.refraction_cross_wind),
                            Over(ours.thu[0], depth * theory.thu_per_depth), Over(ours.tvu[0], tvu),
                            AllowedDeparture(ratios.mean_square_slope, DegreesOfRadians(beam.incidence))});
    const double seen =
        SlopeCovariance(sea, [&](double k, double psi) { return FootprintPower(beam, k, psi); }).trace();
    ratios.seen_fraction = std::min(ratios.seen_fraction, seen / ratios.mean_square_slope);
  }
  return ratios;
}

double AllowedDeparture(double mean_square_slope, double incidence_degrees) {
  return 0.015 + 0.3 * mean_square_slope + 0.02 * incidence_degrees / 20;
}

double StandardErrorsFor(int comparisons) {
  assert(comparisons > 0);
  // Each exceeds k with the probability erfc(k / sqrt 2) = 0.05 / comparisons (Bonferroni, which also holds if they
  // are not independent).
  double low = 0, high = 10;
  while (high - low > 1e-6) {
    const double k = (low + high) / 2;
    (std::erfc(k / std::sqrt(2.0)) * comparisons > 0.05 ? low : high) = k;
  }
  return high;
}

double ExcessInStandardErrors(const Estimate& ratio, double allowed) {
  const double departure = ratio.value - 1;
  return std::max(-allowed - departure, departure - kDiscretizationError) / ratio.standard_error;
}

}  // namespace albtpu
