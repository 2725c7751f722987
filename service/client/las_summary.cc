#include "service/client/las_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace albtpu::client {
namespace {

std::string CoverageText(Coverage coverage) { return coverage == Coverage::kTwoSigma ? "2 sigma" : "95 %"; }

}  // namespace

void LasSummary::AddPulse(const Pulse& pulse, const PulseUncertainty& two_sigma,
                          const PulseUncertainty& stated) {
  outcomes_.Add(two_sigma);
  if (two_sigma.outcome != Outcome::kInterpolated) return;
  const double depth = pulse.depth;
  least_depth_ = outcomes_.interpolated() == 1 ? depth : std::min(least_depth_, depth);
  greatest_depth_ = outcomes_.interpolated() == 1 ? depth : std::max(greatest_depth_, depth);
  Band& band = bands_[std::upper_bound(kBandEnds.begin(), kBandEnds.end(), depth) - kBandEnds.begin()];
  ++band.count;
  const double thu = stated[Quantity::kThu], tvu = stated[Quantity::kTvu];
  band.thu_sum += thu;
  band.thu_max = std::max(band.thu_max, thu);
  band.tvu_sum += tvu;
  band.tvu_max = std::max(band.tvu_max, tvu);
  band.thu_error_sum += stated.standard_errors[Index(Quantity::kThu)];
  band.tvu_error_sum += stated.standard_errors[Index(Quantity::kTvu)];
  const PulseUncertainty p95 = WithCoverage(two_sigma, Coverage::kP95);
  if (p95[Quantity::kThu] <= ThuLimit(order(), depth) && p95[Quantity::kTvu] <= TvuLimit(order(), depth)) {
    ++band.within_order;
  }
}

std::uint64_t LasSummary::points() const {
  return std::accumulate(class_counts_.begin(), class_counts_.end(), std::uint64_t{0});
}

std::string LasSummary::ClassesText() const {
  std::string text;
  for (int i = 0; i < kClassCount; ++i) {
    if (class_counts_[i] == 0) continue;
    absl::StrAppend(&text, text.empty() ? "" : ", ", "class ", i, ": ", class_counts_[i], " points");
  }
  return text;
}

std::string LasSummary::BandText(std::size_t index) const {
  const Band& band = bands_[index];
  const double begin = index == 0 ? 0 : kBandEnds[index - 1];
  const std::string end = index < kBandEnds.size() ? absl::StrFormat("%g", kBandEnds[index]) : "";
  const auto count = static_cast<double>(band.count);
  std::string text =
      absl::StrFormat("  %11s %9d %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %7.1f %%",
                      absl::StrFormat("%g - %s", begin, end), band.count, band.thu_sum / count, band.thu_max,
                      band.tvu_sum / count, band.tvu_max, ThuLimit(order(), begin), TvuLimit(order(), begin),
                      100 * static_cast<double>(band.within_order) / count);
  if (style_.standard_errors) {
    absl::StrAppend(&text,
                    absl::StrFormat(" %9.2g %9.2g", band.thu_error_sum / count, band.tvu_error_sum / count));
  }
  return text;
}

std::string LasSummary::Text() const {
  std::string text = absl::StrCat("  ", points(), " points; bathymetric: ", outcomes_.Text());
  if (outcomes_.interpolated() == 0) return text;
  absl::StrAppend(
      &text,
      absl::StrFormat("\n  depth %.3f m to %.3f m; sea surface only; limits are those at the shallow end",
                      least_depth_, greatest_depth_));
  const std::string coverage = CoverageText(style_.coverage);
  const std::string order_name = std::string(Name(order()));
  absl::StrAppend(&text, absl::StrFormat("\n  %11s %9s %17s %17s %27s", "depth", "points", "THU, " + coverage,
                                         "TVU, " + coverage, "S-44 " + order_name + " limits, 95 %"));
  absl::StrAppend(&text, absl::StrFormat("\n  %11s %9s %8s %8s %8s %8s %8s %8s %9s%s", "m", "", "mean m",
                                         "max m", "mean m", "max m", "THU m", "TVU m", "within",
                                         style_.standard_errors ? "  s.e. THU  s.e. TVU" : ""));
  for (std::size_t i = 0; i < bands_.size(); ++i) {
    if (bands_[i].count > 0) absl::StrAppend(&text, "\n", BandText(i));
  }
  return text;
}

}  // namespace albtpu::client
