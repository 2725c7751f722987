#include "service/client/outcome_counts.h"

#include "absl/strings/str_cat.h"

namespace albtpu::client {

void OutcomeCounts::Add(const PulseUncertainty& uncertainty) {
  ++total_;
  without_azimuth_ += uncertainty.azimuth_absent;
  if (uncertainty.outcome == Outcome::kInterpolated) {
    ++interpolated_;
  } else {
    ++others_[OutcomeText(uncertainty)];
  }
}

std::string OutcomeCounts::Text() const {
  std::string text =
      absl::StrCat(total_, total_ == 1 ? " pulse: " : " pulses: ", interpolated_, " interpolated");
  for (const auto& [outcome, count] : others_) absl::StrAppend(&text, ", ", count, " ", outcome);
  if (without_azimuth_ > 0) {
    absl::StrAppend(&text, "; ", without_azimuth_ == total_ ? "all" : absl::StrCat(without_azimuth_),
                    " without azimuth: each value is the larger of those along and across the wind");
  }
  return text;
}

}  // namespace albtpu::client
