// Answers from a table in this process.
#pragma once

#include <string>

#include "service/client/uncertainty_source.h"
#include "tables/uncertainty_table.h"

namespace albtpu::client {

class LocalSource : public UncertaintySource {
 public:
  // `name` is what --table-name calls the table; empty when a file was named.
  LocalSource(std::string name, UncertaintyTable table);

  const TableSummary& table() const override { return summary_; }
  absl::Status Answer(std::span<const Pulse> pulses, std::span<PulseUncertainty> answers) override;

 private:
  UncertaintyTable table_;
  TableSummary summary_;
};

TableSummary Summarize(std::string name, const UncertaintyTable& table);

}  // namespace albtpu::client
