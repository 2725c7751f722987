#include "tables/query/node_records.h"

#include <algorithm>
#include <cmath>

namespace albtpu {
namespace {

static_assert(Index(Quantity::kRefractionCrossWind) == 1 && Index(Quantity::kThu) == 2);

void Put(const std::vector<float>& numbers, std::size_t place, bool as_logarithms, Records& records) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers[i];
    records[i * kRecordSize + place] = static_cast<float>(as_logarithms ? std::log(number) : number);
  }
}

bool Any(const std::array<bool, kQuantityCount>& flags) {
  return std::any_of(flags.begin(), flags.end(), [](bool flag) { return flag; });
}

}  // namespace

NodeRecords::NodeRecords(const UncertaintyTable& table) {
  for (AxisId axis : kAxes) nodes[Index(axis)] = table.axis(axis).size();
  for (Quantity quantity : kQuantities) {
    const Variable* variable = table.variable(quantity);
    has_values[Index(quantity)] = variable != nullptr;
    has_standard_errors[Index(quantity)] = variable != nullptr && !variable->standard_errors.empty();
    is_log[Index(quantity)] = variable != nullptr && variable->scale == Scale::kLog;
  }
  const auto records = [&](Quantity quantity) {
    return Records((ValueCount(table.axes(), quantity) + 1) * kRecordSize);
  };
  refraction = records(Quantity::kRefractionAlongWind);
  displacement = records(Quantity::kThu);
  if (Any(has_standard_errors)) displacement_errors = records(Quantity::kThu);
  if (Any(is_log)) {
    plain_refraction = refraction;
    plain_displacement = displacement;
  }
  for (Quantity quantity : kQuantities) {
    const std::size_t q = Index(quantity);
    if (!has_values[q]) continue;
    const Variable& variable = *table.variable(quantity);
    const RecordPlace place = PlaceOf(quantity);
    Put(variable.values, place.value, is_log[q], place.is_refraction ? refraction : displacement);
    if (is_log[q]) {
      Put(variable.values, place.value, false, place.is_refraction ? plain_refraction : plain_displacement);
    }
    if (!has_standard_errors[q]) continue;
    Put(variable.standard_errors, place.standard_error, false,
        place.is_refraction ? refraction : displacement_errors);
  }
}

}  // namespace albtpu
