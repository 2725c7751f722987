// The differences of overlapping lines in annotated files.
#pragma once

#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "annotate/run/file_progress.h"
#include "quality/annotated/annotated_points.h"
#include "quality/crosscheck/cross_check.h"
#include "quality/crosscheck/overlap_patches.h"

namespace albtpu::quality {

inline constexpr double kDefaultPatch = 5;  // m, the side of the patches in which lines are compared.

// Of one reading of all files.
annotate::FileProgress ProgressOver(const std::vector<AnnotatedLasFile>& files);

// FailedPrecondition: what to do where no file has a point of a bathymetric class.
absl::Status NoBathymetricPoint(const std::vector<AnnotatedLasFile>& files);

// After `patches` have seen all points once: the second reading.
absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, OverlapPatches& patches);

// After that. Absent if no lines overlap. `patches` is empty then.
std::optional<CrossCheck> CheckPatches(OverlapPatches& patches);

// All of it, from files that are not empty. FailedPrecondition if there is no point, or if no lines overlap.
absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch);

}  // namespace albtpu::quality
