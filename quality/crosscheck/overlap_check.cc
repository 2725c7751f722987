#include "quality/crosscheck/overlap_check.h"

#include <cstdint>
#include <span>
#include <utility>

#include "absl/strings/str_cat.h"

namespace albtpu::quality {

annotate::FileProgress ProgressOver(const std::vector<AnnotatedLasFile>& files) {
  std::uint64_t bytes = 0;
  for (const AnnotatedLasFile& file : files) bytes += file.reader().file_size();
  return annotate::FileProgress("points", files.size(), bytes);
}

absl::Status NoBathymetricPoint(const std::vector<AnnotatedLasFile>& files) {
  return absl::FailedPreconditionError(
      absl::StrCat(files.front().path().parent_path().string(),
                   ": no file has a point of the bathymetric classes; give the outputs of albtpu-query las"));
}

absl::Status FillPatches(const std::vector<AnnotatedLasFile>& files, OverlapPatches& patches) {
  patches.Choose();
  annotate::FileProgress progress = ProgressOver(files);
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    absl::Status status =
        file.ForEach(progress, [&](std::span<const AnnotatedPoint> points) { patches.Fill(points); });
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

std::optional<CrossCheck> CheckPatches(OverlapPatches& patches) {
  std::vector<Patch> taken = patches.Take();
  std::vector<CrossPair> pairs;
  for (Patch& patch : taken) AppendPairs(patch, pairs);
  return CheckPairs(pairs);
}

absl::StatusOr<CrossCheck> CrossCheckOf(const std::vector<AnnotatedLasFile>& files, double patch) {
  OverlapPatches patches(patch, files.front().metres_per_unit(), files.front().coverage());
  annotate::FileProgress progress = ProgressOver(files);
  std::uint64_t points = 0;
  for (const AnnotatedLasFile& file : files) {
    progress.NextFile();
    absl::Status status = file.ForEach(progress, [&](std::span<const AnnotatedPoint> some) {
      points += some.size();
      patches.Find(some);
    });
    if (!status.ok()) return status;
  }
  if (points == 0) return NoBathymetricPoint(files);
  if (absl::Status status = FillPatches(files, patches); !status.ok()) return status;
  std::optional<CrossCheck> check = CheckPatches(patches);
  if (check.has_value()) return *std::move(check);
  return absl::FailedPreconditionError(
      "no lines overlap (lines are distinguished by the point source ID); give files of several lines over "
      "the "
      "same bottom");
}

}  // namespace albtpu::quality
