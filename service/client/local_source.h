// A source that queries a table in this process.
#pragma once

#include <string>

#include "service/client/uncertainty_source.h"
#include "tables/uncertainty_table.h"

namespace albtpu::client {

class LocalSource : public UncertaintySource {
 public:
  // `name` is the value of --table-name that selects the table; empty for a table file given by its path.
  LocalSource(std::string name, const UncertaintyTable& table);

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;
  absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                            const BudgetAnswers& answers) override;

 private:
  TableSummary summary_;
  ColumnInterpolator interpolator_;
};

TableSummary Summarize(std::string name, const UncertaintyTable& table);

}  // namespace albtpu::client
