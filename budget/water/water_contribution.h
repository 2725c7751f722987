// The contribution of the water column: the bias of the bottom by scattering, over all waters that are possible.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "budget/water/water_optics.h"
#include "budget/water/water_receiver.h"
#include "tables/water/water_column_table.h"

namespace albtpu {

// At one incidence and depth. Lengths in m; reported minus true.
struct WaterAnswerOfSurvey {
  // Of the bias before any treatment, over the possible waters.
  double mean_vertical = 0, sigma_vertical = 0;  // positive: too shallow
  double low_vertical = 0, high_vertical = 0;    // its 2.5 and 97.5 % points
  double mean_along = 0, sigma_along = 0;        // positive: too far along the beam
  double spot = 0, stretch = 0, energy = 0;      // means; no uncertainties
  // After the treatment: the bias that remains in the points, and its uncertainty.
  double bias_vertical = 0, bias_along = 0;
  double left_vertical = 0, left_along = 0;  // 1 sigma
  double correlation = 0;                    // of the two
};

// Where to write the contribution for each pulse; an empty column is not written. NaN where there is no answer.
struct WaterColumns {
  std::span<float> bias_along, bias_vertical;    // m, remaining in the points
  std::span<float> sigma_along, sigma_vertical;  // m, 1 sigma; common to all pulses of a survey
  std::span<float> correlation;                  // of the two errors
  std::span<float> stretch;                      // of the echo
};

class WaterContribution {
 public:
  // Draws waters (Guide to the Expression of Uncertainty in Measurement, Supplement 1: JCGM 101:2008), looks each up in
  // the table, and keeps mean and spread over incidence and depth. About half a second of one core.
  //
  // InvalidArgument with what would be right: a water outside the table, a receiver beyond the table at all depths, a
  // residual fraction outside 0 to 1, a calibration beyond the table or at a depth where the waters do not agree on the
  // sign of the bias.
  static absl::StatusOr<WaterContribution> Create(const WaterColumnTable& table, const WaterOptics& optics,
                                                  const WaterReceiver& receiver, const BiasTreatment& treatment);

  // Largest incidence [degree], and depth [m] down to which the contribution is known: where the median water reaches
  // the largest optical depth of the table less one standard deviation (more turbid draws are extrapolated in
  // proportion), or where half of the draws return an echo (kMinEchoEnergy). Draws without an echo are left out at
  // their depth.
  double greatest_incidence() const { return max_incidence_; }
  double greatest_depth() const { return max_depth_; }
  // The share of the waters that scatter more, for what they absorb, than those of the table: none of these is drawn.
  double beyond_table() const { return beyond_table_; }
  // m; a wider beam would be cut by the field of view, which the table does not know.
  double greatest_footprint() const { return max_footprint_; }

  // Bytes that it holds.
  std::size_t memory() const { return nodes_.size() * sizeof(Node); }

  // nullopt if the pulse is beyond; incidence in degree, depth in m, 0 or more.
  std::optional<WaterAnswerOfSurvey> At(double incidence, double depth) const;

  // The same for many pulses. A column of one number holds for all pulses.
  void Compute(std::span<const float> incidence, std::span<const float> depth, const WaterColumns& columns) const;

  // m, 1 sigma: the vertical error by the noise of an echo of `photons` photons and this stretch: cos(refracted) c
  // sigma_t / (2 n_group sqrt(photons)).
  double PhotonNoise(double photons, double stretch, double cosine_refracted) const;

  // Enough in the sense of JCGM 101: twice as many draws change u by less than 2 %.
  static constexpr std::size_t kDraws = 256;

 private:
  // Over the depth. In the order of kNumbers.
  enum Number {
    kMeanVertical,
    kMeanAlong,
    kVarianceVertical,
    kVarianceAlong,
    kCovariance,
    kLow,
    kHigh,
    kSpot,
    kStretch,
    kEnergy,
    kBiasVertical,
    kBiasAlong,
    kLeftVertical,
    kLeftAlong,
    kLeftCovariance
  };
  static constexpr std::size_t kNumbers = 15;
  using Node = std::array<float, kNumbers>;

  WaterContribution() = default;
  Node Blend(double incidence, double depth) const;

  WaterReceiver receiver_;
  double max_incidence_ = 0, max_depth_ = 0, max_footprint_ = 0, beyond_table_ = 0;
  double incidence_step_ = 1;
  std::size_t incidences_ = 0;
  std::vector<Node> nodes_;  // by incidence, then by the root of the depth
};

}  // namespace albtpu
