// Where answers come from: a table file in this process, or a server. Both give the same numbers, bit by bit.
#pragma once

#include <array>
#include <map>
#include <string>

#include "absl/status/status.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"
#include "tables/schema.h"

namespace albtpu::client {

// The reach of an axis, in its own units.
struct AxisRange {
  double first = 0;
  double last = 0;
  std::size_t nodes = 0;
};

// A table as it presents itself: what stamps answers, and what `albtpu-query tables` prints.
struct TableSummary {
  std::string name;  // What to ask for: the value of --table-name. Empty for a file.
  std::string id, version, title;
  std::string digest;  // 64 hexadecimal digits
  std::array<AxisRange, kAxisCount> axes;
  std::map<std::string, std::string> attributes;  // Further provenance, as text.
  bool is_default = false;                        // Answers when no table is named.
};

class UncertaintySource {
 public:
  virtual ~UncertaintySource() = default;

  // The one table that all answers come from, fixed when the source was opened.
  virtual const TableSummary& table() const = 0;

  // Answers all pulses, of any number, none too, into the columns of `answers` that are not null. Any number
  // of threads may ask at a time. Fails only as a whole, and then the columns may hold anything: columns of
  // pulses have lengths that they may not have (InvalidArgument), the server cannot be reached (Unavailable),
  // or gave its table another content (Aborted).
  virtual absl::Status Answer(const Query& query, const PulseColumns& pulses,
                              const AnswerColumns& answers) = 0;
};

}  // namespace albtpu::client
