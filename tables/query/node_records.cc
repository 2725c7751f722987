#include "tables/query/node_records.h"

#include <cassert>
#include <cmath>

namespace albtpu {
namespace {

void Put(const std::vector<float>& numbers, std::size_t lane, bool as_logarithms, Records& records) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double number = numbers[i];
    records[i * kRecordSize + lane] = static_cast<float>(as_logarithms ? std::log(number) : number);
  }
}

// Chooses the places of `quantities`, which are all over the last axis or all not. Returns the number of sets in use
// afterwards.
std::size_t Place(const std::vector<std::size_t>& quantities, bool any_standard_errors, std::size_t first_set,
                  NodeRecords& records) {
  const std::size_t count = quantities.size();
  const std::size_t value_sets = (count + kRecordSize - 1) / kRecordSize;
  const bool together = count <= kRecordSize / 2;
  for (std::size_t i = 0; i < count; ++i) {
    records.values[quantities[i]] = {first_set + i / kRecordSize, i % kRecordSize};
    records.standard_errors[quantities[i]] =
        together ? RecordPlace{first_set, i + kRecordSize / 2}
                 : RecordPlace{first_set + value_sets + i / kRecordSize, i % kRecordSize};
  }
  return first_set + (together || !any_standard_errors ? value_sets : 2 * value_sets);
}

}  // namespace

NodeRecords::NodeRecords(const Table& table) : quantity_count(table.schema().quantities.size()) {
  const auto& quantities = table.schema().quantities;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    const Variable* variable = table.variable(q);
    has_values[q] = variable != nullptr;
    has_standard_errors[q] = variable != nullptr && !variable->standard_errors.empty();
    is_log[q] = variable != nullptr && variable->scale == Scale::kLog;
  }
  for (const bool over_last_axis : {false, true}) {
    std::vector<std::size_t> members;
    bool any_errors = false;
    for (std::size_t q = 0; q < quantity_count; ++q) {
      if (quantities[q].over_last_axis != over_last_axis) continue;
      members.push_back(q);
      any_errors = any_errors || has_standard_errors[q];
    }
    if (members.empty()) continue;
    const std::size_t first = sets.size(), last = Place(members, any_errors, first, *this);
    const Records zeros((ValueCount(table.axes(), quantities[members[0]]) + 1) * kRecordSize);
    for (std::size_t set = first; set < last; ++set) sets.push_back({over_last_axis, zeros, {}});
    for (const std::size_t q : members) {
      if (is_log[q]) sets[values[q].set].plain = zeros;
    }
  }
  assert(sets.size() <= kMaxSets);
  for (std::size_t q = 0; q < quantity_count; ++q) {
    if (!has_values[q]) continue;
    const Variable& variable = *table.variable(q);
    Set& set = sets[values[q].set];
    Put(variable.values, values[q].lane, is_log[q], set.numbers);
    if (is_log[q]) Put(variable.values, values[q].lane, false, set.plain);
    if (!has_standard_errors[q]) continue;
    Put(variable.standard_errors, standard_errors[q].lane, false, sets[standard_errors[q].set].numbers);
  }
}

}  // namespace albtpu
