// The seas of a timeline, compiled as they are needed: a table in memory each, of which the last used ones are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "annotate/seas/sea_timeline.h"
#include "service/client/sea_sources.h"

namespace albtpu::annotate {

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

}  // namespace albtpu::annotate
