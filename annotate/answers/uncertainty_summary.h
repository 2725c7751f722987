// A summary of all answers in a file, accumulated in one pass: outcomes, the interpolation error of the table, and the
// uncertainty by depth band compared with the S-44 limits. It is printed as text and stored as JSON.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "annotate/answers/answer_counts.h"
#include "annotate/answers/batch.h"
#include "service/client/uncertainty_source.h"
#include "tables/schema.h"

namespace albtpu::annotate {

// The minimum, the maximum and the approximate median of many numbers, in one pass and in little memory.

// Does not depend on the order of the numbers, nor on the order of merging.
class CoordinateSpread {
 public:
  void Add(float value);  // Finite.
  void Merge(const CoordinateSpread& other);

  std::uint64_t count() const { return count_; }
  // Of at least one number.
  float least() const { return least_; }
  float greatest() const { return greatest_; }
  // The median to 1/16 of itself; exactly, where all numbers are the same.
  float middle() const;

 private:
  std::uint64_t count_ = 0;
  float least_ = std::numeric_limits<float>::infinity(), greatest_ = -least_;
  std::vector<std::uint64_t> bins_;  // Empty until the first number.
};

// The depth bands of summaries. Their upper ends, m; the last band has none.
inline constexpr std::array<float, 9> kBandEnds = {0.25, 1, 2, 5, 10, 15, 20, 30, 50};
inline constexpr std::size_t kDepthBands = kBandEnds.size() + 1;

std::size_t BandOf(float depth);
double BandBegin(std::size_t band);
std::string BandText(std::size_t band);             // "2 - 5", "50 - "
nlohmann::ordered_json BandJson(std::size_t band);  // {"from": 2, "to": 5}; null without an end

// The interpolation error of a table. It was measured when the table was made, at random pulses all over the table, and
// is in its attributes `interpolation_error_*` (tables/FORMAT.md).

// Of one quantity. Errors are fractions of the directly computed value.
struct InterpolationError {
  Quantity quantity;
  double rms, percentile_99;
};

// Of each quantity for which the table states it. Empty if it is not known, as for published tables.
std::vector<InterpolationError> InterpolationErrors(const client::TableSummary& table);

// "0.28 % rms, 1.1 % at the 99th percentile".
std::string Text(const InterpolationError& error);

// All of them in one line, for a note beside the output of many pulses.
std::string InterpolationErrorNote(const client::TableSummary& table);

// The last bits of the sums depend on how the pulses were divided into batches and on the order in which the
// batches were merged.
class UncertaintySummary {
 public:
  explicit UncertaintySummary(AnswerStyle style) : style_(style) {}

  // Adds the columns that a summary needs to a selection.
  static void Select(AnswerSelection& selection);

  // Pulses that were queried.
  void Add(const PulseBatch& pulses, const AnswerBatch& answers);
  // Chosen points without a query; those above the water by the next function.
  void Add(NoPulse why, std::uint64_t count = 1) { outcomes_.Add(why, count); }
  // A chosen point above the water surface, at this negative depth [m]; `why` is kAboveWater or kDry.
  void AddAboveWater(float depth, NoPulse why = NoPulse::kAboveWater);
  void Merge(const UncertaintySummary& other);

  const OutcomeCounts& outcomes() const { return outcomes_; }
  AnswerTally Tally() const;

  // Several lines: the outcomes, then a table of depth bands.
  std::string Text(std::string_view without_azimuth = kWorseOfTheWind) const;

  // `outcomes`; `outside`, by outcome the least, median (to 1/16) and greatest of the coordinate that caused it, for
  // ABOVE_WATER the depth; `depth`, `s44_best_order` (number of pulses by the strictest order that the sea surface
  // alone leaves open) and `depth_bands` with `thu` and `tvu` in m.
  nlohmann::ordered_json Json() const;

 private:
  struct Range {
    double sum = 0, standard_error_sum = 0;
    float least = std::numeric_limits<float>::infinity(), greatest = -least;

    void Add(float value, float standard_error);
    void Merge(const Range& other);
    nlohmann::ordered_json Json(std::uint64_t count, bool standard_errors) const;
  };

  struct Band {
    std::uint64_t count = 0;
    // By the strictest open order; element 0 counts pulses for which none is open.
    std::array<std::uint64_t, kS44Orders.size() + 1> best_orders = {};
    Range thu, tvu;

    std::uint64_t Within(S44Order order) const;  // Pulses that leave this order open.
    void Merge(const Band& other);
  };

  S44Order order() const { return style_.s44_order.value_or(S44Order::k1b); }
  std::string TextOf(std::size_t band) const;
  nlohmann::ordered_json JsonOf(std::size_t band) const;
  nlohmann::ordered_json OutsideJson() const;

  AnswerStyle style_;
  OutcomeCounts outcomes_;
  std::array<CoordinateSpread, OutcomeCounts::kAskedCount> outside_;  // By OutcomeCounts::Number.
  CoordinateSpread above_water_;                                      // Depths.
  std::array<Band, kDepthBands> bands_ = {};
  float min_depth_ = std::numeric_limits<float>::infinity();  // m, of interpolated pulses.
  float max_depth_ = -std::numeric_limits<float>::infinity();
};

}  // namespace albtpu::annotate
