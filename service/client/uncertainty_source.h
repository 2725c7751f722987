// A source of answers: a table in this process, or a server. Both give the same numbers, bit for bit.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "budget/query/budget_query.h"
#include "budget/water/known_water.h"
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

// A water as it was computed, to albtpu.v1.WaterSummary.
struct WaterSummary {
  std::string table_id, table_version, table_digest;  // Of the water column; empty where its share is left out.
  double attenuation = 0, attenuation_log_sigma = 0;  // 1/m: the median of K; 1 sigma of its logarithm
  std::string derivation;                             // How the attenuation follows from what was given.
  double greatest_depth = 0, greatest_incidence = 0, greatest_footprint = 0;  // m, degree, m: out of domain beyond
  double green_surface_range = 0;                                             // m
  std::vector<std::string> assumptions;                                       // one sentence each
};

class UncertaintySource {
 public:
  virtual ~UncertaintySource() = default;

  // The table that all answers come from. It is fixed when the source is opened.
  virtual const TableSummary& table() const = 0;

  // Whether calls are cheap, as in this process; where each is a message, fewer and larger ones take less time.
  virtual bool in_process() const { return false; }

  // Queries the table for all pulses, zero or more, and fills the columns of `answers` that are not null. Any number of
  // threads may call this at the same time. Either all pulses are answered, or the call fails and the contents of the
  // columns are unspecified: the columns of the pulses have invalid lengths (InvalidArgument), the server cannot be
  // reached (Unavailable), or the content of its table has changed (Aborted).
  virtual absl::Status Answer(const Query& query, const PulseColumns& pulses, const AnswerColumns& answers) = 0;

  // The same for the whole budget. With a table of one sea, the axis of the sea is that of the table. InvalidArgument
  // also if a number of `options` is out of its range, or their index is not that of the source.
  virtual absl::Status AnswerBudget(const BudgetOptions& options, const BudgetPulses& pulses,
                                    const BudgetAnswers& answers) = 0;

  // The same in a water that the server compiles, half a second at first: the columns of a water in `pulses` must be
  // empty. The index is that of `options`, also where the water has a temperature and a salinity. Pulses beyond the
  // water are out of domain. Sets `summary`, if it is not null. InvalidArgument also if the server refuses the water
  // (water.proto); FailedPrecondition if it has no table of the water column, or is of a version without waters.
  // Unimplemented by sources in this process: compile the water and give its columns (budget/water/water_columns.h),
  // which have the same bits.
  virtual absl::Status AnswerBudgetInWater(const BudgetOptions& options, const KnownWater& water,
                                           const BudgetPulses& pulses, const BudgetAnswers& answers,
                                           WaterSummary* summary = nullptr);
};

}  // namespace albtpu::client
