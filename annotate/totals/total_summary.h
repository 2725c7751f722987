// A summary of all totals in a file or a line: by depth, THU and TVU, the shares of the variance, and the orders of
// S-44.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "annotate/answers/uncertainty_summary.h"
#include "annotate/totals/pulse_totals.h"
#include "annotate/totals/source_sums.h"

namespace albtpu::annotate {

// Mean, median, 95th percentile and maximum of many lengths, in one pass. Percentiles are right to 1 %.
class LengthSpread {
 public:
  void Add(float metres);  // Finite, 0 or more.
  void Merge(const LengthSpread& other);

  std::uint64_t count() const { return count_; }
  double mean() const { return sum_ / static_cast<double>(count_); }  // Of at least one.
  double quantile(double fraction) const;                             // The same; at most the maximum.
  float greatest() const { return greatest_; }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0;
  float greatest_ = 0;
  std::vector<std::uint64_t> bins_;  // Empty until the first length.
};

class TotalSummary {
 public:
  // Pulses that have a total; others are not counted here.
  void Add(const PulseBatch& pulses, const AnswerBatch& sea, const TotalBatch& totals);
  // One pulse of a batch.
  void Add(const PulseBatch& pulses, const AnswerBatch& sea, const TotalBatch& totals, std::size_t i);
  // What the sources of error contribute to pulses that are added.
  void Add(const SourceSums& sources) { sources_.Merge(sources); }
  void Merge(const TotalSummary& other);

  std::uint64_t count() const;
  // "THU 0.673 m, TVU 0.222 m in the median": of at least one pulse.
  std::string Medians() const;
  std::uint64_t meeting(S44Order order) const { return All().Meeting(order); }

  // A table of depth bands with totals, contributions to both variances, biases, and how many meet `order`.
  std::string Text(Coverage coverage, S44Order order) const;
  // `depth_bands`, and `all` with the same members: points, thu, tvu, shares, orders.
  nlohmann::ordered_json Json() const;

 private:
  // Sums of variances, m^2.
  struct Sums {
    double horizontal = 0, vertical = 0;

    void Add(const TotalBatch::Covariance& covariance, std::size_t i) {
      horizontal += static_cast<double>(covariance[0][i]) + covariance[1][i];
      vertical += covariance[2][i];
    }
    void Merge(const Sums& other) {
      horizontal += other.horizontal;
      vertical += other.vertical;
    }
  };

  struct Band {
    LengthSpread thu, tvu;
    Sums air, sea, water, extra, total;
    std::array<Sums, kErrorGroups> groups;
    double bias_along_beam = 0, bias_vertical = 0;  // Sums, m, with their signs.
    std::array<std::uint64_t, kS44Orders.size() + 1> best_orders = {};

    std::uint64_t Meeting(S44Order order) const;
    void Merge(const Band& other);
    nlohmann::ordered_json Json() const;
  };

  Band All() const;

  std::array<Band, kDepthBands> bands_;
  SourceSums sources_;
};

// The totals of all dry points in a file or a line, which S-44 does not judge.
class DrySummary {
 public:
  void Add(const TotalBatch& totals, std::size_t i);
  void Merge(const DrySummary& other);
  std::uint64_t count() const { return thu_.count(); }

  // "12 dry points: total THU, 2 sigma, 0.1 m in the median ...; empty without points.
  std::string Text(Coverage coverage) const;
  // `points`, `total_thu`, `total_tvu`; `rmse_horizontal` and `rmse_vertical` [m], the roots of the mean variances, as
  // standards of topographic lidar count; `groups_horizontal`, the shares of the groups of errors.
  nlohmann::ordered_json Json() const;

 private:
  double horizontal() const;  // Of all groups.

  LengthSpread thu_, tvu_;
  std::array<double, kErrorGroups> horizontal_{};  // Sums of variances, m^2.
  double vertical_ = 0;
};

// `answers`, which are those of the sea alone (UncertaintySummary), with the total beside them. What the sea has by
// depth moves to `sea_surface`. `total` has TotalSummary::Json(), `coverage`, `assumed` and, of each line, the same.
nlohmann::ordered_json WithTotal(nlohmann::ordered_json answers, const TotalPlan& plan, const TotalSummary& totals,
                                 const std::map<int, TotalSummary>& lines = {});

}  // namespace albtpu::annotate
