#include "service/server/calls/budget_request.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "budget/query/query_check.h"
#include "service/error_message.h"
#include "service/server/ground/errors.h"
#include "service/server/tables/wire_enums.h"

namespace albtpu::server {
namespace {

std::array<double, 3> Read(const v1::ForwardRightDown& v) { return {v.forward(), v.right(), v.down()}; }

}  // namespace

absl::StatusOr<BudgetOptions> ReadBudgetOptions(const v1::BudgetOptions& options) {
  const absl::StatusOr<Coverage> coverage = FromWire(options.coverage());
  if (!coverage.ok()) return coverage.status();
  const absl::StatusOr<SurfaceLocation> located = FromWire(options.located());
  if (!located.ok()) return located.status();
  BudgetOptions read{.errors = FromMessage(options.errors()),
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
  static const std::string* const kScratch = new std::string();
  std::array<RequestColumn, kAircraftInputs.size()> columns;
  for (std::size_t i = 0; i < columns.size(); ++i) {  // Field i + 1 is input i.
    const BudgetInput input = kAircraftInputs[i];
    const std::string& bytes = aircraft.GetReflection()->GetStringReference(
        aircraft, v1::AircraftColumns::descriptor()->FindFieldByNumber(static_cast<int>(i) + 1),
        const_cast<std::string*>(kScratch));
    columns[i] = {"aircraft", kBudgetInputNames[static_cast<std::size_t>(input)], &bytes, IsRequired(input)};
  }
  return columns;
}

}  // namespace albtpu::server
