// Where answers come from: a table file in this process, or a server. Both give the same numbers, bit by bit.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "tables/interpolation.h"
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

  // Answers `pulses[i]` in `answers[i]`, at 2 sigma (coverage.h restates them); the spans have one length,
  // any length. Fails only as a whole: the server cannot be reached, or gave its table another content.
  virtual absl::Status Answer(std::span<const Pulse> pulses, std::span<PulseUncertainty> answers) = 0;
};

}  // namespace albtpu::client
