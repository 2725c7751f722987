// Answers from a table in this process.
#pragma once

#include <string>

#include "service/client/uncertainty_source.h"
#include "tables/uncertainty_table.h"

namespace albtpu::client {

class LocalSource : public UncertaintySource {
 public:
  // `name` is what --table-name calls the table; empty when a file was named.
  LocalSource(std::string name, const UncertaintyTable& table);

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) override;

 private:
  TableSummary summary_;
  ColumnInterpolator interpolator_;
};

TableSummary Summarize(std::string name, const UncertaintyTable& table);

}  // namespace albtpu::client
