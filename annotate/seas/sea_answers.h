// The compiled seas of a timeline, and the answers of pulses by the sea at their times.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "annotate/answers/batch.h"
#include "annotate/seas/sea_timeline.h"
#include "service/client/sea_sources.h"

namespace albtpu::annotate {

// The seas of a timeline, compiled as they are needed: a table in memory each, of which the last used ones are kept.

// Any number of threads may use it at a time.
class OpenSeas {
 public:
  // As many as chunks of points worked on at a time need, twice over.
  static constexpr std::size_t kMost = 40;

  // `seas` must outlive it.
  OpenSeas(const SeaTimeline& seas, std::unique_ptr<client::SeaSources> sources, std::size_t most = kMost)
      : seas_(seas), sources_(std::move(sources)), most_(most) {}

  // The source of record `i`. One thread compiles it. Others that ask for it meanwhile compile the record after it,
  // which pulses in order of time need next, and then wait.
  absl::StatusOr<std::shared_ptr<client::UncertaintySource>> Get(std::size_t i);

 private:
  struct Sea {
    explicit Sea(std::size_t number) : record(number) {}

    const std::size_t record;
    absl::Mutex opening;
    absl::StatusOr<std::shared_ptr<client::UncertaintySource>> source =
        std::shared_ptr<client::UncertaintySource>();  // null: not yet
  };
  using Order = std::list<std::shared_ptr<Sea>>;  // The last used one first.

  std::shared_ptr<Sea> Find(std::size_t i);
  void Compile(Sea& sea) ABSL_EXCLUSIVE_LOCKS_REQUIRED(sea.opening);

  const SeaTimeline& seas_;
  std::unique_ptr<client::SeaSources> sources_;
  const std::size_t most_;
  absl::Mutex mutex_;
  Order order_ ABSL_GUARDED_BY(mutex_);
  std::map<std::size_t, Order::iterator> by_record_ ABSL_GUARDED_BY(mutex_);
};

// Between two records each value is interpolated in variance: its square is linear in time, as the energy of the waves
// is. So are the standard errors, as relative errors common to the two records; biases are linear. Each value at 95 %
// is interpolated so, too: where the axes of the two seas differ, THU is at most 3 % more than that of the mean
// covariance. Directions count from each record's own wind.
class SeaAnswers {
 public:
  // Opens the first sea that is needed, so that a sea that cannot be compiled, and a server that does not answer, fail
  // before any work.
  static absl::StatusOr<std::unique_ptr<SeaAnswers>> Open(std::shared_ptr<const SeaTimeline> seas,
                                                          std::unique_ptr<client::SeaSources> sources);

  // Pulses need `times` where the timeline goes by time, each of which has a sea. Must outlive what it returns.
  AnswerSource source();

  const SeaTimeline& timeline() const { return *seas_; }
  // Of a record, by which its table is known.
  absl::StatusOr<client::TableSummary> Summary(std::size_t record);

 private:
  SeaAnswers(std::shared_ptr<const SeaTimeline> seas, std::unique_ptr<client::SeaSources> sources)
      : seas_(std::move(seas)), open_(*seas_, std::move(sources)) {}

  absl::Status Answer(const Query& query, const PulseBatch& pulses, const AnswerSelection& selection,
                      AnswerBatch& answers);
  // Of pulses between the same two records; the weights are those of the second.
  absl::Status AnswerBetween(const Query& query, const PulseBatch& pulses, const BetweenRecords& between,
                             const std::vector<float>& weights, const AnswerSelection& selection, AnswerBatch& answers);

  std::shared_ptr<const SeaTimeline> seas_;
  OpenSeas open_;
  client::TableSummary first_;
};

}  // namespace albtpu::annotate
