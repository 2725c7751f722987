#include "annotate/seas/open_seas.h"

#include <utility>

namespace albtpu::annotate {

std::shared_ptr<OpenSeas::Sea> OpenSeas::Find(std::size_t i) {
  const absl::MutexLock lock(&mutex_);
  if (const auto found = by_record_.find(i); found != by_record_.end()) {
    order_.splice(order_.begin(), order_, found->second);
    return order_.front();
  }
  order_.push_front(std::make_shared<Sea>(i));
  by_record_[i] = order_.begin();
  if (order_.size() > most_) {
    by_record_.erase(order_.back()->record);
    order_.pop_back();  // Users of the source keep it alive.
  }
  return order_.front();
}

absl::StatusOr<std::shared_ptr<client::UncertaintySource>> OpenSeas::Get(std::size_t i) {
  const std::shared_ptr<Sea> sea = Find(i);
  if (!sea->opening.TryLock()) {
    if (i + 1 < seas_.size()) {
      const std::shared_ptr<Sea> next = Find(i + 1);
      if (next->opening.TryLock()) {
        Compile(*next);
        next->opening.Unlock();
      }
    }
    sea->opening.Lock();
  }
  Compile(*sea);
  const absl::StatusOr<std::shared_ptr<client::UncertaintySource>> source = sea->source;
  sea->opening.Unlock();
  return source;
}

void OpenSeas::Compile(Sea& sea) {
  if (!sea.source.ok() || *sea.source != nullptr) return;
  absl::StatusOr<std::unique_ptr<client::UncertaintySource>> source = sources_->Open(seas_.sea(sea.record));
  if (source.ok()) {
    sea.source = std::shared_ptr<client::UncertaintySource>(*std::move(source));
  } else {
    sea.source = source.status();
  }
}

}  // namespace albtpu::annotate
