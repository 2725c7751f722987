#include "service/server/pulse_rows.h"

#include <cmath>
#include <limits>
#include <optional>

#include "absl/strings/str_cat.h"
#include "service/server/limits.h"
#include "service/server/wire_enums.h"

namespace albtpu::server {
namespace {

// A coordinate that is missing is not a number, and makes the pulse invalid.
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

Pulse ReadPulse(const v1::Pulse& pulse) {
  return {.wind_speed = pulse.has_wind_speed() ? pulse.wind_speed() : kMissing,
          .fetch = pulse.has_fetch() ? pulse.fetch() : std::numeric_limits<float>::infinity(),
          .incidence = pulse.has_incidence() ? pulse.incidence() : kMissing,
          .azimuth = pulse.has_azimuth() ? std::optional(pulse.azimuth()) : std::nullopt,
          .footprint = pulse.has_footprint() ? pulse.footprint() : kMissing,
          .depth = pulse.has_depth() ? pulse.depth() : kMissing};
}

v1::SeaSurface WriteSeaSurface(const std::array<float, kQuantityCount>& values) {
  using Setter = void (v1::SeaSurface::*)(float);
  constexpr std::array<Setter, kQuantityCount> kSetters = {&v1::SeaSurface::set_refraction_along_wind,
                                                           &v1::SeaSurface::set_refraction_cross_wind,
                                                           &v1::SeaSurface::set_thu,
                                                           &v1::SeaSurface::set_tvu,
                                                           &v1::SeaSurface::set_bias_along_beam,
                                                           &v1::SeaSurface::set_bias_vertical};
  v1::SeaSurface sea_surface;
  for (std::size_t i = 0; i < kQuantityCount; ++i) {
    if (!std::isnan(values[i])) (sea_surface.*kSetters[i])(values[i]);
  }
  return sea_surface;
}

v1::S44 WriteS44(const S44Answer& answer) {
  v1::S44 s44;
  s44.set_best_order(ToWire(answer.best_order));
  if (answer.remaining_thu.has_value()) s44.set_remaining_thu(*answer.remaining_thu);
  if (answer.remaining_tvu.has_value()) s44.set_remaining_tvu(*answer.remaining_tvu);
  return s44;
}

}  // namespace

absl::Status CheckRows(const Query& query, const v1::QueryPulsesRequest& request) {
  const auto count = static_cast<std::size_t>(request.pulses_size());
  if (count == 0) return absl::InvalidArgumentError("there is no pulse: send at least one");
  const std::size_t limit = query.standard_errors ? kMaxPulsesWithStandardErrors : kMaxPulses;
  if (count <= limit) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("there are ", count, " pulses: a message takes ", limit,
                   query.standard_errors ? " with standard errors, or use QueryColumns" : ", send several"));
}

v1::PulseUncertainty AnswerRow(const Query& query, const v1::Pulse& pulse) {
  const PulseAnswer answer = AnswerPulse(query, ReadPulse(pulse));
  const PulseUncertainty& uncertainty = answer.uncertainty;
  v1::PulseUncertainty row;
  row.set_outcome(ToWire(uncertainty.outcome));
  row.set_axis(ToWire(uncertainty.axis));
  row.set_azimuth_absent(uncertainty.azimuth_absent);
  if (uncertainty.outcome != Outcome::kInterpolated) return row;
  *row.mutable_sea_surface() = WriteSeaSurface(uncertainty.values);
  if (query.standard_errors) {
    *row.mutable_sea_surface_standard_error() = WriteSeaSurface(uncertainty.standard_errors);
  }
  if (query.asks_s44()) *row.mutable_s44() = WriteS44(answer.s44);
  return row;
}

}  // namespace albtpu::server
