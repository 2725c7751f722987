#include "service/server/calls/budget_request.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "budget/query/query_check.h"
#include "service/server/ground/errors.h"
#include "service/server/tables/wire_enums.h"

namespace albtpu::server {
namespace {

std::array<double, 3> Read(const v1::NorthEastDown& v) { return {v.north(), v.east(), v.down()}; }
std::array<double, 3> Read(const v1::RollPitchHeading& v) { return {v.roll(), v.pitch(), v.heading()}; }
std::array<double, 3> Read(const v1::ForwardRightDown& v) { return {v.forward(), v.right(), v.down()}; }

AirErrors Read(const v1::AirErrors& errors) {
  return {.position = Read(errors.position()),
          .attitude = Read(errors.attitude()),
          .boresight = Read(errors.boresight()),
          .lever_arm = errors.lever_arm(),
          .scan = errors.scan(),
          .time = errors.time(),
          .range_offset = errors.range_offset(),
          .bottom_range = errors.bottom_range(),
          .surface_range = errors.surface_range(),
          .surface_height = errors.surface_height(),
          .index = errors.index()};
}

}  // namespace

absl::StatusOr<BudgetOptions> ReadBudgetOptions(const v1::BudgetOptions& options) {
  const absl::StatusOr<Coverage> coverage = FromWire(options.coverage());
  if (!coverage.ok()) return coverage.status();
  const absl::StatusOr<SurfaceLocation> located = FromWire(options.located());
  if (!located.ok()) return located.status();
  BudgetOptions read{.errors = Read(options.errors()),
                     .located = *located,
                     .lever_arm = Read(options.lever_arm()),
                     .datum = options.datum(),
                     .coverage = *coverage};
  if (options.has_refractive_index()) read.index = options.refractive_index();
  FieldViolations violations;
  for (const OptionError& error : FindErrors(read)) {
    violations.Add(absl::StrCat("options.", error.field), absl::StrCat("options.", error.problem));
  }
  if (!(std::abs(options.sea_axis()) <= kGreatestBudgetNumber)) {
    violations.Add("options.sea_axis", absl::StrCat("options.sea_axis is ", options.sea_axis(),
                                                    ": expected degrees, or leave it out"));
  }
  if (absl::Status status = violations.ToStatus(); !status.ok()) return status;
  return read;
}

std::array<RequestColumn, kAircraftInputs.size()> ColumnsOf(const v1::AircraftColumns& aircraft) {
  const std::array<const std::string*, kAircraftInputs.size()> bytes = {&aircraft.altitude(),
                                                                        &aircraft.beam_azimuth(),
                                                                        &aircraft.roll(),
                                                                        &aircraft.pitch(),
                                                                        &aircraft.heading(),
                                                                        &aircraft.velocity_north(),
                                                                        &aircraft.velocity_east(),
                                                                        &aircraft.velocity_down(),
                                                                        &aircraft.roll_rate(),
                                                                        &aircraft.pitch_rate(),
                                                                        &aircraft.yaw_rate(),
                                                                        &aircraft.position_sigma_north(),
                                                                        &aircraft.position_sigma_east(),
                                                                        &aircraft.position_sigma_down(),
                                                                        &aircraft.roll_sigma(),
                                                                        &aircraft.pitch_sigma(),
                                                                        &aircraft.heading_sigma(),
                                                                        &aircraft.wave_height(),
                                                                        &aircraft.water_sigma_along(),
                                                                        &aircraft.water_sigma_vertical(),
                                                                        &aircraft.water_correlation(),
                                                                        &aircraft.water_noise(),
                                                                        &aircraft.water_bias_along(),
                                                                        &aircraft.water_bias_vertical()};
  std::array<RequestColumn, kAircraftInputs.size()> columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const BudgetInput input = kAircraftInputs[i];
    columns[i] = {"aircraft", kBudgetInputNames[static_cast<std::size_t>(input)], bytes[i],
                  IsRequired(input)};
  }
  return columns;
}

}  // namespace albtpu::server
