// The total uncertainty of one pulse: every share and source, to see what decides.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "annotate/answers/batch.h"
#include "annotate/totals/plan_total.h"

namespace albtpu::annotate {

// The aircraft at the pulse; absent: level flight at rest to the north, which counts as assumed.
struct PulseMotion {
  std::optional<std::array<double, 3>> attitude;  // degree; roll, pitch, heading
  std::optional<std::array<double, 3>> velocity;  // m/s; north, east, down
  std::optional<std::array<double, 3>> rates;     // degree/s; forward, right, down
};

struct PulseTotal {
  TotalPlan plan;
  PulseBatch pulse;                   // One pulse, at the axes of the table.
  float altitude = 0;                 // m above the water
  std::optional<float> beam_azimuth;  // degree, true
  PulseMotion motion;
};

// One object: `thu`, `tvu` at the coverage asked for, `coverage`; `covariance_air`, `covariance_sea`,
// `covariance_water`, `covariance_total` (m^2, 1 sigma: NN EE DD NE ND ED; null where not known or left out); `sources`
// (the variances of each, horizontal and vertical, m^2, and its group); `groups`; `semi_major`, `semi_minor` (m, 1
// sigma), `major_azimuth` (degree from north); `bias_along_beam`, `bias_vertical` (m); `s44_order_met`; `outcome`;
// `plan` with its numbers and their sources; `assumed`. Fails where the source does.
absl::StatusOr<nlohmann::ordered_json> TotalJson(const PulseTotal& total, const AnswerSource& source);

// The same for people.
std::string TotalText(const nlohmann::ordered_json& total);

}  // namespace albtpu::annotate
