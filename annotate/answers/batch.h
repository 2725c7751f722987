// A query about a batch of pulses: how its answers are stated, the pulses and their coordinates, the memory for the
// answers, which is reused from batch to batch, and the source that gives them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "service/client/uncertainty_source.h"
#include "tables/coverage.h"
#include "tables/query/column_query.h"
#include "tables/query/pulse_columns.h"
#include "tables/s44.h"

namespace albtpu::annotate {

// How answers are stated: the flags that all commands have.
struct AnswerStyle {
  Coverage coverage = Coverage::kTwoSigma;
  std::optional<S44Order> s44_order;  // Also states what this order leaves for all other error sources.
  bool standard_errors = false;       // Also states the standard errors.

  Query query() const { return {.coverage = coverage, .s44_order = s44_order}; }
};

// "2 sigma" or "95 %".
constexpr const char* CoverageText(Coverage coverage) {
  return coverage == Coverage::kTwoSigma ? "2 sigma" : coverage == Coverage::kOneSigma ? "1 sigma" : "95 %";
}

// As flags, survey files and JSON name it: "2sigma", "p95", "1sigma".
constexpr const char* CoverageName(Coverage coverage) {
  return coverage == Coverage::kTwoSigma ? "2sigma" : coverage == Coverage::kOneSigma ? "1sigma" : "p95";
}
constexpr std::optional<Coverage> FindCoverage(std::string_view name) {
  for (const Coverage coverage : {Coverage::kTwoSigma, Coverage::kP95, Coverage::kOneSigma})
    if (name == CoverageName(coverage)) return coverage;
  return std::nullopt;
}

// Each axis has one number per pulse, one number for all pulses, or none (PulseColumns).
struct PulseBatch {
  std::size_t size = 0;
  std::array<std::vector<float>, kAxisCount> axis;
  // For a sea that varies in time or has its own axis: the instants [s since 1970, UTC], one per pulse or none, and
  // whether azimuths count clockwise from true north, rather than from downwind.
  std::vector<double> times = {};
  bool azimuths_from_north = false;

  std::vector<float>& operator[](AxisId id) { return axis[Index(id)]; }
  PulseColumns columns() const;
  // The coordinate of a pulse. Requires a number on this axis.
  float coordinate(AxisId id, std::size_t i) const {
    const std::vector<float>& column = axis[Index(id)];
    return column[column.size() == 1 ? 0 : i];
  }
};

// The ranges of the axes of a table.
using TableAxes = decltype(client::TableSummary::axes);

// Which columns are queried; the outcomes always are.
struct AnswerSelection {
  std::array<bool, kQuantityCount> quantities = {};
  bool standard_errors = false;  // Of those quantities.
  bool best_s44_orders = false;
  bool s44_remaining = false;
  bool sea_frame = false;  // Of a sea other than that of a table of winds.
};

// The outcome of a pulse that has an answer for the sea, but none for the water column.
inline constexpr std::uint8_t kNoWater = 4;

// Element i of each column belongs to pulse i. Columns that are not selected are empty.
struct AnswerBatch {
  std::vector<std::uint8_t> outcomes, outcome_axes;  // outcomes: Outcome plus 1, or kNoWater
  std::vector<std::uint8_t> sides;  // Side + 1 of a pulse out of domain; 0 of any other, and on the azimuth.
  std::array<std::vector<float>, kQuantityCount> values, standard_errors;
  std::vector<std::uint8_t> best_s44_orders;
  std::vector<float> remaining_thu, remaining_tvu;
  // The compass direction of the x axis of the sea [degree], and the standard deviation of its elevation [m].
  std::vector<float> sea_axes, wave_heights;

  // Makes room for `count` answers and discards the previous ones.
  AnswerColumns Resize(std::size_t count, const AnswerSelection& selection);

  // Fills `sides` from the outcomes. `pulses` are those that were answered, `axes` those of the table that answered.
  void FindSides(const PulseBatch& pulses, const TableAxes& axes);

  bool interpolated(std::size_t i) const { return outcomes[i] == 1; }
  std::span<const float> operator[](Quantity quantity) const { return values[Index(quantity)]; }
};

// A source of answers for batches: a table, or the sea at the time of each pulse (annotate/seas). Thread-safe.
class AnswerSource {
 public:
  using Answer = std::function<absl::Status(const Query&, const PulseBatch&, const AnswerSelection&, AnswerBatch&)>;

  AnswerSource(client::UncertaintySource& source);  // NOLINT: each table answers. Must outlive it.
  AnswerSource(const client::TableSummary& table, Answer answer, bool in_process = true)
      : table_(&table), answer_(std::move(answer)), in_process_(in_process) {}

  // The table, or the one of a sea, whose axes all seas share.
  const client::TableSummary& table() const { return *table_; }
  bool in_process() const { return in_process_; }

 private:
  friend absl::Status AnswerPulses(const AnswerSource&, const Query&, const PulseBatch&, const AnswerSelection&,
                                   AnswerBatch&);

  const client::TableSummary* table_;
  Answer answer_;
  bool in_process_;
};

// Queries `source` for all pulses and replaces the contents of `answers`, sides included.
absl::Status AnswerPulses(const AnswerSource& source, const Query& query, const PulseBatch& pulses,
                          const AnswerSelection& selection, AnswerBatch& answers);

// Coordinates that follow from the directions of beam and wind, and from the size of the beam.

// The diameter [m], across its axis, of a beam with full divergence `divergence` [mrad] where it meets the mean
// surface, `altitude` [m] below the aircraft: H / cos(incidence) * divergence. `incidence` is in degrees.
double FootprintAtIncidence(double altitude, double divergence, double incidence);

// The azimuth [degree], from downwind, of a beam that travels towards `beam_azimuth`, in a wind that comes from
// `wind_from`: both in degrees, true, clockwise from north. Downwind is where the wind blows to.
double DegreesFromDownwind(double beam_azimuth, double wind_from);

}  // namespace albtpu::annotate
