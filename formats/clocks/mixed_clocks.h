// Times of two clocks in one file, as where files of several programs were merged.
#pragma once

#include <optional>
#include <string>

#include "absl/status/status.h"
#include "formats/clocks/time_tally.h"

namespace albtpu::formats {

// "5000 points have seconds of the GPS week (319998.0 to 320020.0), and 5001 adjusted standard GPS times (330879998.0
// to 330880020.0)". Of the two largest groups of times that lie a month or more apart,
//   * one has seconds of a week and the other dates (as dates, the former are of the days after 14 September 2011), or
//   * both have dates, and by different clocks they are those of one flight.
// nullopt where neither is so, and where so few points are apart from the others that TimeTally::Bulk leaves them out.
std::optional<std::string> MixedClocks(const TimeTally& tally);

// FailedPrecondition where there are two: no trajectory, level or sea belongs to both. `name` is that of the file.
absl::Status CheckOneClock(const std::string& name, const TimeTally& tally);

}  // namespace albtpu::formats
