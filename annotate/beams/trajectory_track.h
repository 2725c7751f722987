// The track of the sensor from the files of its trajectory, by the clock of the points.
#pragma once

#include "absl/status/statusor.h"
#include "annotate/beams/beam_plan.h"
#include "annotate/beams/file_track.h"

namespace albtpu::annotate {

// From the trajectory files of the plan that overlap the points in time and lie near them. Fails when they do not, and
// when the rays disagree with the track; the message names the cause as far as it can be found.
absl::StatusOr<FileTrack> TrackFromFiles(const TrackedFile& file, const BeamPlan& plan);

}  // namespace albtpu::annotate
