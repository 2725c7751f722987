// A source that queries a table in this process.
#pragma once

#include <string>

#include "service/client/uncertainty_source.h"
#include "tables/uncertainty_table.h"

namespace albtpu::client {

class LocalSource : public UncertaintySource {
 public:
  // `name` is the value of --table-name that selects the table; empty for a table file given by its path.
  // Answers are for water of the index: the table is scaled to it (sea/table/table_at_index.h), unless it is its own.
  LocalSource(std::string name, UncertaintyTable table, double index = kSeaWaterIndex);

  const TableSummary& table() const override { return summary_; }
  bool in_process() const override { return true; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;
  absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                            const BudgetAnswers& answers) override;

 private:
  TableSummary summary_;
  ColumnInterpolator interpolator_;
};

TableSummary Summarize(std::string name, const UncertaintyTable& table, double index = kSeaWaterIndex);

// InvalidArgument if a budget is asked for water of another index than that of the source.
absl::Status CheckIndex(const BudgetOptions& options, const TableSummary& table);

}  // namespace albtpu::client
