// The seas over which the points of a survey were measured.
#pragma once

#include "absl/status/statusor.h"
#include "annotate/seas/sea_timeline.h"
#include "quality/annotated/annotated_points.h"
#include "sea/spectra/harmonic_spectrum.h"

namespace albtpu::quality {

// A sea at the time of a file.
struct SeaOfSource {
  HarmonicSpectrum spectrum;
  double x_azimuth = 0;    // rad: the compass direction of the spectrum's axis x
  double water_index = 0;  // The refractive index that the points were computed with.

  bool operator==(const SeaOfSource&) const = default;
};

// The sea over which a file was measured: that of `seas` at the time of the file, or, where that is null, the one of
// the wind and the fetch of its summary. InvalidArgument: what is missing or does not agree with the summary.
absl::StatusOr<SeaOfSource> SeaOfFile(const AnnotatedLasFile& file, const annotate::SeaTimeline* seas);

}  // namespace albtpu::quality
