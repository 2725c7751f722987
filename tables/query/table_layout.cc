#include "tables/query/table_layout.h"

namespace albtpu {
namespace {

std::size_t RecordCount(const NodeRecords& records) {
  std::size_t most = 0;
  for (const NodeRecords::Set& set : records.sets) most = std::max(most, set.numbers.size());
  return most / kRecordSize;
}

}  // namespace

TableLayout::TableLayout(const Table& table)
    : schema(table.schema()),
      grid(table),
      records(table),
      fewest_to_sort(SortedPulses::Fewest(RecordCount(records))) {}

}  // namespace albtpu
