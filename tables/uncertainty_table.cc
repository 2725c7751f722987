#include "tables/uncertainty_table.h"

#include <cassert>
#include <iterator>
#include <utility>

namespace albtpu {

absl::StatusOr<UncertaintyTable> UncertaintyTable::Create(Axes axes, Variables variables,
                                                          Provenance provenance) {
  absl::StatusOr<Table> table =
      Table::Create(kSeaSurface, {std::make_move_iterator(axes.begin()), std::make_move_iterator(axes.end())},
                    {std::make_move_iterator(variables.begin()), std::make_move_iterator(variables.end())},
                    std::move(provenance));
  if (!table.ok()) return table.status();
  return UncertaintyTable(*std::move(table));
}

UncertaintyTable::UncertaintyTable(Table table)
    : table_(std::move(table)), axes_{table_.axes()[0], table_.axes()[1], table_.axes()[2],
                                      table_.axes()[3], table_.axes()[4], table_.axes()[5]} {
  assert(&table_.schema() == &kSeaSurface);
}

std::size_t ValueCount(const UncertaintyTable::Axes& axes, Quantity quantity) {
  return ValueCount(axes, Describe(quantity));
}

}  // namespace albtpu
