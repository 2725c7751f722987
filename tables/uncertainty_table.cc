#include "tables/uncertainty_table.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "status/status_macros.h"

namespace albtpu {
namespace {

[[maybe_unused]] bool IsOfSea(const TableSchema& kind) {
  const auto& kinds = UncertaintyTable::kKinds;
  return std::find(kinds.begin(), kinds.end(), &kind) != kinds.end();
}

}  // namespace

absl::StatusOr<UncertaintyTable> UncertaintyTable::Create(Axes axes, Variables variables, Provenance provenance) {
  return Create(kSeaSurface, std::move(axes), std::move(variables), std::move(provenance));
}

absl::StatusOr<UncertaintyTable> UncertaintyTable::Create(const TableSchema& kind, Axes axes, Variables variables,
                                                          Provenance provenance) {
  assert(IsOfSea(kind));
  ASSIGN_OR_RETURN(Table table,
                   Table::Create(kind, {std::make_move_iterator(axes.begin()), std::make_move_iterator(axes.end())},
                                 {std::make_move_iterator(variables.begin()), std::make_move_iterator(variables.end())},
                                 std::move(provenance)));
  return UncertaintyTable(std::move(table));
}

UncertaintyTable::UncertaintyTable(Table table)
    : table_(std::move(table)), axes_{table_.axes()[0], table_.axes()[1], table_.axes()[2],
                                      table_.axes()[3], table_.axes()[4], table_.axes()[5]} {
  assert(IsOfSea(schema()));
}

UncertaintyTable::Variables UncertaintyTable::ReleaseVariables() && {
  Table::Variables released = std::move(table_).ReleaseVariables();
  Variables variables;
  std::move(released.begin(), released.end(), variables.begin());
  return variables;
}

std::size_t ValueCount(const UncertaintyTable::Axes& axes, Quantity quantity) {
  return ValueCount(axes, Describe(quantity));
}

}  // namespace albtpu
