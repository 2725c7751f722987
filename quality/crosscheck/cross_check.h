// Whether the predicted uncertainty explains the differences between overlapping lines.
//
// The difference of two neighbouring points of different lines contains the errors that do not cancel between lines:
// those that are independent from pulse to pulse and from line to line. Errors common to all lines (offsets, index,
// datum) cancel and are not tested here.
#pragma once

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/run/file_progress.h"
#include "quality/annotated/annotated_points.h"
#include "quality/crosscheck/overlap_patches.h"
#include "quality/crosscheck/variance_fit.h"

namespace albtpu::quality {

// Pairs of a range of depth, incidence or the fraction of the sea in the predicted variance.
struct CrossBand {
  double from = 0, to = 0;
  std::size_t pairs = 0;
  double chi_square = 0;  // Reduced: the mean of the squared differences in units of their predicted variance.
};

// The height difference between two lines.
struct LineDifference {
  int line_a = 0, line_b = 0;                                                    // Point source IDs.
  double begin_a = std::numeric_limits<double>::quiet_NaN(), begin_b = begin_a;  // As FlightLine::begin.
  std::size_t pairs = 0;
  double mean = 0;            // m, line a less line b.
  double standard_error = 0;  // m, from differences between places of the overlap; NaN of a single one.
};

struct CrossCheck {
  std::size_t pairs = 0;
  LeftOutPoints left_out;
  std::size_t outliers = 0;  // Left out: beyond kOutlier standard deviations, estimated by the median.
  double chi_square = 0;
  double chi_square_within_lines = 0;  // Without the mean difference of each two lines.
  double beyond_three_sigma = 0;       // A fraction; 0.0027 of normal errors.
  double median_factor = 0;            // The factor below by the median, which heavy tails do not raise.
  Estimate factor;                     // The factor that would make the predicted standard deviations fit.
  Estimate factor_air,
      factor_sea;              // The same for air side and sea, from how differences depend on their contributions.
  std::string interval_units;  // The units left out in turn by the jackknife: "lines" or "places".
  double air_in_variance = 0;  // The fraction of the air side in the predicted variance.
  double roughness = 0;        // m in a metre of distance, of the bottom around its plane; 0: not significant.
  // "air" or "sea": the contribution whose factor differs from 1 by kMinDifference and beyond an interval of 99 %,
  // and that explains most; empty: none.
  std::string guilty;
  std::vector<CrossBand> by_depth, by_incidence, by_sea_share;
  std::vector<LineDifference> lines;  // The largest difference first.
};

inline constexpr double kOutlier = 6;
inline constexpr double kMinDifference = 0.1;  // No decision depends on a tenth of a standard deviation.

// Factors and roughness are those of FitVariance. `pairs` is reordered and loses its outliers. Absent without pairs.
// The lines of the result have their numbers as IDs.
std::optional<CrossCheck> CheckPairs(std::vector<CrossPair>& pairs);

nlohmann::ordered_json CrossCheckJson(const CrossCheck& check);

// For the user, some lines.
std::string CrossCheckText(const CrossCheck& check);

// The differences of overlapping lines in annotated files.

inline constexpr double kDefaultPatch = 5;  // m, the side of the patches in which lines are compared.

// Of one reading of all files.
annotate::FileProgress ProgressOver(const std::vector<AnnotatedLasFile>& files);

// FailedPrecondition: what to do where no file has a point of a bathymetric class.
absl::Status NoBathymetricPoint(const std::vector<AnnotatedLasFile>& files);

// After `patches` have seen all points once: the second reading.
absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, OverlapPatches& patches);

// After that. Absent if no lines overlap (FlightLines::NothingToCompare). `patches` has no points then.
std::optional<CrossCheck> CheckPatches(OverlapPatches& patches);

// All of it, from files that are not empty. FailedPrecondition if there is no point, or if no lines overlap.
absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch);

}  // namespace albtpu::quality
