// What one spectrum in place of the other does to a beam: the uncertainty of the model itself.
#pragma once

#include "validation/report/study.h"

namespace albtpu {

// A ratio over many points of the survey domain.
struct RatioSummary {
  double median, low, high, least, greatest;  // low and high: 5 % and 95 % of the points
};

// Elfouhaily's sea over Apel's: in closed form over the survey domain and by Monte Carlo at a few points of
// it. Adds tables and comparisons to `study`; returns the summary of THU.
RatioSummary CompareSpectra(const StudyOptions& options, Study& study);

}  // namespace albtpu
