// A source of answers: a table in this process, or a server. Both give the same numbers, bit for bit.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "absl/status/status.h"
#include "budget/query/budget_query.h"
#include "sea/water_index.h"
#include "service/seas/sea_summary.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"
#include "tables/schema.h"

namespace albtpu::client {

// The range of an axis, in its own unit.
struct AxisRange {
  double first = 0;
  double last = 0;
  std::size_t nodes = 0;
};

// The identity and the axes of a table, as `albtpu-query tables` prints them.
struct TableSummary {
  std::string name;  // The value of --table-name that selects it; empty for a file.
  std::string id, version, title;
  std::string digest;  // 64 hexadecimal digits
  std::array<AxisRange, kAxisCount> axes;
  std::map<std::string, std::string> attributes;  // Further provenance, as text.
  // Of the water that answers are for, whatever the index that the table was made at.
  double refractive_index = kSeaWaterIndex;
  bool is_default = false;        // Used when no table is named.
  std::optional<SeaSummary> sea;  // If it is the table of one sea.
};

class UncertaintySource {
 public:
  virtual ~UncertaintySource() = default;

  // The table that all answers come from. It is fixed when the source is opened.
  virtual const TableSummary& table() const = 0;

  // Queries the table for all pulses, zero or more, and fills the columns of `answers` that are not null. Any number of
  // threads may call this at the same time. Either all pulses are answered, or the call fails and the contents of the
  // columns are unspecified: the columns of the pulses have invalid lengths (InvalidArgument), the server cannot be
  // reached (Unavailable), or the content of its table has changed (Aborted).
  virtual absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) = 0;

  // The same for the whole budget. With a table of one sea, the axis of the sea is that of the table. InvalidArgument
  // also if a number of `options` is out of its range, or their index is not that of the source.
  virtual absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                                    const BudgetAnswers& answers) = 0;
};

}  // namespace albtpu::client
