#include "budget/query/query_check.h"

#include <array>
#include <cmath>
#include <string_view>

#include "absl/strings/str_cat.h"

namespace albtpu {
namespace {

void CheckSigma(const std::string& field, double sigma, std::vector<OptionError>& errors) {
  if (sigma >= 0 && sigma <= kGreatestBudgetNumber) return;
  errors.push_back(
      {field, absl::StrCat(field, " is ", sigma, ": a standard deviation is 0 to ", kGreatestBudgetNumber)});
}

constexpr std::array<std::string_view, 3> kForwardRightDown = {"forward", "right", "down"};

}  // namespace

std::vector<OptionError> FindErrors(const BudgetOptions& options) {
  std::vector<OptionError> found;
  for (const ErrorSource& source : kErrorSources) {
    const std::span<const double> numbers = source.In(options.errors);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::string part = numbers.size() > 1 ? absl::StrCat(".", std::string(source.parts[i])) : "";
      CheckSigma(absl::StrCat("errors.", std::string(source.name), part), numbers[i], found);
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(options.lever_arm[i]) <= kGreatestBudgetNumber) continue;
    const std::string field = absl::StrCat("lever_arm.", std::string(kForwardRightDown[i]));
    found.push_back({field, absl::StrCat(field, " is ", options.lever_arm[i], ": expected up to ",
                                         kGreatestBudgetNumber, " m in magnitude")});
  }
  if (!(options.index >= 1 && options.index <= 2))
    found.push_back({"refractive_index", absl::StrCat("refractive_index is ", options.index, ": expected 1 to 2")});
  CheckSigma("datum", options.datum, found);
  CheckSigma("extra_horizontal", options.extra_horizontal, found);
  CheckSigma("extra_vertical", options.extra_vertical, found);
  return found;
}

absl::Status CheckQuery(const TableSchema& schema, const BudgetPulses& pulses, const BudgetOptions& options) {
  const std::vector<OptionError> errors = FindErrors(options);
  if (!errors.empty()) return absl::InvalidArgumentError(errors.front().problem);
  if (pulses.sea_axis.has_value() && !(std::abs(*pulses.sea_axis) <= kGreatestBudgetNumber)) {
    return absl::InvalidArgumentError(
        absl::StrCat("sea_axis is ", *pulses.sea_axis, ": expected degrees, or leave it out"));
  }
  if (absl::Status status = CheckLengths(schema, pulses.pulses); !status.ok()) return status;
  const std::size_t count = pulses.pulses.size;
  if (pulses.aircraft.size != count) {
    return absl::InvalidArgumentError(absl::StrCat("there are ", count, " pulses and ", pulses.aircraft.size,
                                                   " of the aircraft; give the same number"));
  }
  if (count == 0) return absl::OkStatus();
  for (const BudgetInput input : kAircraftInputs) {
    const std::string_view name = kBudgetInputNames[static_cast<std::size_t>(input)];
    const std::size_t length = pulses.aircraft[input].size();
    if (length == 0 && IsRequired(input)) {
      return absl::InvalidArgumentError(
          absl::StrCat("column '", std::string(name), "' is empty; give one number for each pulse, or one for all"));
    }
    if (length > 1 && length != count) {
      return absl::InvalidArgumentError(absl::StrCat("column '", std::string(name), "' has ", length, " numbers for ",
                                                     count, " pulses; give one number for each pulse, or one for all"));
    }
  }
  return absl::OkStatus();
}

}  // namespace albtpu
