// The effect of the choice of spectrum on a beam: the uncertainty of the model itself.
#pragma once

#include "validation/report/study.h"

namespace albtpu {

// A ratio over many points of the survey domain.
struct RatioSummary {
  double median, low, high, least, greatest;  // low and high: 5 % and 95 % of the points
};

// The ratio of Elfouhaily's sea to Apel's: in closed form over the survey domain and by Monte Carlo at a few of its
// points. Adds tables and comparisons to `study`; returns the summary of THU.
RatioSummary CompareSpectra(const StudyOptions& options, Study& study);

}  // namespace albtpu
