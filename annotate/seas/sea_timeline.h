// The states of the given sea at one place, in order of time, and the two of them between which an instant lies.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "config/sea_settings.h"
#include "sea/files/sea_series.h"
#include "service/seas/known_sea.h"

namespace albtpu::annotate {

// Between two records, in proportion: (1 - weight) of `first` and weight of `second`. With weight 0 `first` alone.
struct BetweenRecords {
  std::size_t first = 0, second = 0;
  double weight = 0;
};

// Immutable.
class SeaTimeline {
 public:
  // Reads the given file, or takes the given waves. `settings` has passed CheckSea and has waves. Errors begin with the
  // path of the file: it cannot be read, its place is missing or unknown, or it does not have the time.
  static absl::StatusOr<SeaTimeline> Open(const config::SeaSettings& settings);

  // The records of one place.
  std::size_t size() const { return records_.size(); }
  const SeaRecord& record(std::size_t i) const { return records_[i]; }
  KnownSea sea(std::size_t i) const { return KnownSeaOf(records_[i], settings_.description(), series_.record_length); }

  // Whether the sea depends on the time of a pulse. If not, fixed() holds for all.
  bool by_time() const { return !fixed_.has_value(); }
  const BetweenRecords& fixed() const { return *fixed_; }
  // s since 1970, UTC: of the only record, which holds for all although nobody chose its time. Else nullopt.
  std::optional<double> unchosen_time() const {
    return by_time() || settings_.time.has_value() || times_.empty() ? std::nullopt : std::optional(times_.front());
  }

  // The two records around an instant [s since 1970, UTC]. nullopt before the first, after the last, and in a gap that
  // is longer than longest_gap(). Quicker where `guess` is the first of the two. Requires by_time().
  std::optional<BetweenRecords> At(double time, std::size_t guess = 0) const;
  // The first and the last record that sea states between two instants are made of. Requires by_time().
  std::pair<std::size_t, std::size_t> RecordsWithin(double first, double last) const;
  double start() const { return times_.front(); }
  double end() const { return times_.back(); }
  double longest_gap() const { return longest_gap_; }  // s

  const config::SeaSettings& settings() const { return settings_; }
  const SeaSeries& series() const { return series_; }  // what the file states, without its records
  const std::string& place() const { return place_; }  // empty if the file has but one without a name

 private:
  SeaTimeline() = default;
  absl::Status TakePlace(std::vector<SeaRecord> records);
  absl::Status TakeTime();

  config::SeaSettings settings_;
  SeaSeries series_;
  std::string place_;
  std::vector<SeaRecord> records_;
  std::vector<double> times_;  // of records that have a time, s since 1970
  double longest_gap_ = 0;
  std::optional<BetweenRecords> fixed_;
};

// That points of `name` were not measured at the time of the only record. Requires seas.unchosen_time().
absl::Status NotOfOnlyRecord(const std::string& name, const std::string& times, const SeaTimeline& seas);

// "from 2020-06-01T00:50Z to 2020-06-08T03:50Z"
std::string SpanText(const SeaTimeline& seas);

}  // namespace albtpu::annotate
