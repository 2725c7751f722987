// Whether the predicted uncertainty explains the differences between overlapping lines, in two parts: what is drawn
// anew for each pulse (pulse_part.h), and what each line shares (line_part.h). Errors common to all lines (lever arm,
// boresight, clock, index, water level, datum) cancel and are not tested here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/run/file_progress.h"
#include "annotate/seas/sea_timeline.h"
#include "quality/annotated/annotated_points.h"
#include "quality/crosscheck/line_part.h"
#include "quality/crosscheck/overlap_patches.h"
#include "quality/crosscheck/pulse_part.h"
#include "quality/crosscheck/shared_waves.h"

namespace albtpu::quality {

// Pairs of a range of depth, incidence or the fraction of the sea in the predicted variance.
struct CrossBand {
  double from = 0, to = 0;
  std::size_t pairs = 0;
  double chi_square = 0;  // Reduced: the mean of the squared differences in units of their predicted variance.
};

struct CrossCheck {
  std::size_t pairs = 0;
  LeftOutPoints left_out;
  std::size_t outliers = 0;  // Left out: beyond kOutlier standard deviations, estimated by the median.
  double chi_square = 0;
  double chi_square_within_lines = 0;  // Without the mean difference of each two lines.
  double beyond_three_sigma = 0;       // A fraction; 0.0027 of normal errors.
  double median_factor = 0;            // `factor` by the median, which heavy tails do not raise.
  bool sea_known = false;              // Otherwise waves are taken as independent, and no part is named.
  PulsePart pulse;
  LinePart line;
  // The factor that would make the predicted standard deviations of the differences fit: of both parts by their
  // variances. Its interval is that of a sum of variances by the intervals of each (Zou and Donner 2008,
  // doi:10.1002/sim.3095).
  Estimate factor;
  double air_in_variance = 0, line_in_variance = 0;  // Fractions of the predicted variance; the rest is the sea's.
  // The part that differs: "trajectory", "air" (scan angles and ranges), "sea", or "pulse", where sensor and sea cannot
  // be separated; empty: none. A wrong trajectory also has fast errors, which look like a sea: it is named alone.
  std::string guilty;
  std::vector<CrossBand> by_depth, by_incidence, by_sea_share;
};

inline constexpr double kOutlier = 6;
inline constexpr double kRareDifference = 3;  // Of |z|: a larger difference of two lines is more than predicted.

// `pairs` lose their outliers. `patch`: the side of the patches, m. Absent without pairs across lines. The lines of the
// result have their numbers as IDs.
std::optional<CrossCheck> CheckPairs(PatchPairs& pairs, double patch, const SharedWaves& waves);

// Whether the prediction agrees with the overlap; nullopt where too few pairs are close together to test it.
std::optional<bool> Agrees(const CrossCheck& check);

// "prediction and overlap agree: ...": what to conclude, one line without its end.
std::string Conclusion(const CrossCheck& check);

nlohmann::ordered_json CrossCheckJson(const CrossCheck& check);

// For the user, some lines.
std::string CrossCheckText(const CrossCheck& check);

// The differences of overlapping lines in annotated files.

inline constexpr double kDefaultPatch = 5;  // m, the side of the patches in which lines are compared.

// Of one reading of all files.
annotate::FileProgress ProgressOver(const std::vector<AnnotatedLasFile>& files);

// FailedPrecondition: what to do where no file has a point of a bathymetric class.
absl::Status NoBathymetricPoint(const std::vector<AnnotatedLasFile>& files);

// The seas of files.
struct FileSeas {
  SharedWaves waves;
  std::vector<std::uint16_t> of_files;  // PulseOnWater::kNoSea where it is not known.
};

// Where `seas` is null, those of the winds that the files state, as far as they do. Fails if `seas` are not those of
// the files.
absl::StatusOr<FileSeas> SeasOf(const std::vector<AnnotatedLasFile>& files, const annotate::SeaTimeline* seas);

// After `patches` have seen all points once: the second reading. All points are shown to `also`, too, if given; the
// flight lines of `patches` are known then.
absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, const FileSeas& seas, OverlapPatches& patches,
                         const AnnotatedLasFile::Visit& also = {});

// After that. Absent if no lines overlap (FlightLines::NothingToCompare). `patches` has no points then.
std::optional<CrossCheck> CheckPatches(OverlapPatches& patches, const SharedWaves& waves);

// All of it, from files that are not empty. FailedPrecondition if there is no point, or if no lines overlap.
absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch,
                                        const annotate::SeaTimeline* seas);

}  // namespace albtpu::quality
