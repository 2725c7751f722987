// Compiles a sea into a table of its effect on every beam, by the response theory (sea/response/sea_response.h).
#pragma once

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "sea/response/closed_form.h"
#include "sea/response/footprint_kernel.h"
#include "sea/spectra/described_sea.h"
#include "sea/table/beam_directions.h"
#include "tables/uncertainty_table.h"

namespace albtpu {

// The nodes of the axes, which increase: degrees from 0 on, azimuths up to 180, and metres. They are rounded to single
// precision. With these, interpolation errors are at most 1 %; "The table of one sea" in docs/physics.md lists the
// exceptions.
struct SeaTableNodes {
  std::vector<double> incidences = {0,   0.25, 0.5, 0.75, 1,  1.375, 1.875, 2.5, 3.25, 4.25,
                                    5.5, 7.5,  10,  13,   16, 19,    22,    25,  27.5, 30};
  std::vector<double> azimuths = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130, 140, 150, 160, 170, 180};
  std::vector<double> footprints = {0.1,  0.19, 0.33, 0.5, 0.7,  0.95, 1.2,  1.45, 1.7,  1.95, 2.25,
                                    2.55, 2.9,  3.25, 3.6, 3.95, 4.3,  4.65, 5,    5.35, 5.7,  6};
  std::vector<double> depths = {0, 0.1, 0.3, 60};
};

struct SeaTableOptions {
  double refractive_index = kSeaWaterIndex;
  BeamProfile profile = BeamProfile::kUniform;
  SeaTableNodes nodes = {};
};

// No sea is steeper: its rms slope is 35 degrees, and the law of Cox and Munk (1954), 0.003 + 0.00512 U, reaches it at
// 97 m/s. The terms that the theory leaves out, in proportion to the square, take 1.6 % off TVU there.
inline constexpr double kMaxMeanSquareSlope = 0.5;

// Immutable; one serves all seas and threads. Making one costs about as much as compiling a sea: keep it.
class SeaCompiler {
 public:
  // Requires valid nodes.
  explicit SeaCompiler(const SeaTableOptions& options = {});

  // The table of a sea, of kind kOneSea. `record_length` [s] is that of the measurement; infinity for waves that were
  // not measured. Standard errors are those of the sea (sea_error.h) at the footprint. Quantities in proportion to
  // the slopes have half the relative error of the slope variance, those of second order in slope all of it, and biases
  // that of the mean square slope of the whole sea. Without waves, all numbers are 0.
  //
  // Fails with InvalidArgument if the mean square slope is above kMaxMeanSquareSlope, or if a table cannot hold a
  // number, which it names: one that is not finite or above 1e6.
  absl::StatusOr<UncertaintyTable> Compile(const SeaDescription& sea, double record_length) const {
    return Compile(sea, record_length, options_.refractive_index);
  }
  // In water of another index than that of the options.
  absl::StatusOr<UncertaintyTable> Compile(const SeaDescription& sea, double record_length, double index) const;

  // Of a sea whose uncertainty is not known: without standard errors.
  absl::StatusOr<UncertaintyTable> Compile(const DescribedSea& sea) const {
    return Compile(sea, options_.refractive_index);
  }
  absl::StatusOr<UncertaintyTable> Compile(const DescribedSea& sea, double index) const;

 private:
  // The relative errors of V for each footprint, then that of the mean square slope.
  using RelativeErrors = std::vector<double>;

  absl::StatusOr<UncertaintyTable> Compile(const DescribedSea& sea, std::optional<TailRule> tail,
                                           const std::optional<RelativeErrors>& errors, double index) const;
  // By (incidence, azimuth without the last, footprint).
  std::vector<BeamResponse> ResponsesOf(const HarmonicSpectrum& spectrum, double index) const;
  absl::StatusOr<UncertaintyTable::Axes> AxesFor(double wind_speed) const;
  Provenance ProvenanceOf(const DescribedSea& sea, std::optional<TailRule> tail, double index) const;

  SeaTableOptions options_;
  BeamDirections directions_;
  std::vector<FootprintKernel> footprints_;
};

}  // namespace albtpu
