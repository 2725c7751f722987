// What requests need and takes long to make: made once, on threads of its own, and kept.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "service/server/observe/metric_collectors.h"
#include "tables/digest.h"

namespace albtpu::server {

// So that neither the threads of gRPC nor the workers ever wait for it. Keeps the values that were used last; a value
// lives as long as a call uses it. `Wanted` is copyable and has a member `key`: equal keys have equal values.
// Thread-safe.
template <typename Wanted, typename Value>
class CompileQueue {
 public:
  using Result = absl::StatusOr<std::shared_ptr<const Value>>;
  using Listener = std::function<void(const Result&)>;

  struct Limits {
    std::size_t threads;
    std::size_t values, bytes;  // kept; one always is
    std::size_t waiting;
  };

  // `refusal` is the message where too many wait. `make` may throw. `metrics` must outlive this object.
  CompileQueue(CompileMetrics& metrics, const Limits& limits, const char* refusal,
               std::function<Result(const Wanted&)> make, std::function<std::size_t(const Value&)> bytes_of)
      : limits_(limits), refusal_(refusal), make_(std::move(make)), bytes_of_(std::move(bytes_of)), metrics_(metrics) {
    for (std::size_t i = 0; i < limits_.threads; ++i) threads_.emplace_back([this] { Run(); });
  }

  // Finishes what is being made; the listeners of what waits get CANCELLED.
  ~CompileQueue() {
    Asked left;
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      for (const Wanted& wanted : std::exchange(waiting_, {})) left.insert(asked_.extract(wanted.key));
    }
    changed_.notify_all();
    for (const auto& [key, listeners] : left)
      for (const Listener& done : listeners) done(absl::CancelledError("the server is shutting down"));
    for (std::thread& thread : threads_) thread.join();
  }

  CompileQueue(const CompileQueue&) = delete;
  CompileQueue& operator=(const CompileQueue&) = delete;

  // The value of this key, if it is kept; else null.
  std::shared_ptr<const Value> Find(const Sha256Digest& key) {
    const std::lock_guard lock(mutex_);
    return FindKept(key);
  }

  // Calls `done` with the value: at once if it is kept or cannot wait, else from a thread that made it. One that is
  // waiting or being made is not made again. RESOURCE_EXHAUSTED: too many wait.
  void Compile(const Wanted& wanted, Listener done) {
    const Sha256Digest& key = wanted.key;
    Result result = absl::ResourceExhaustedError(refusal_);
    {
      const std::lock_guard lock(mutex_);
      if (std::shared_ptr<const Value> kept = FindKept(key)) {
        result = std::move(kept);
      } else if (const auto asked = asked_.find(key); asked != asked_.end()) {
        metrics_.CountJoined();
        return asked->second.push_back(std::move(done));
      } else if (waiting_.size() < limits_.waiting) {
        asked_[key].push_back(std::move(done));
        waiting_.push_back(wanted);
        return changed_.notify_one();
      } else {
        metrics_.CountRefused();
      }
    }
    done(result);
  }

 private:
  struct Kept {
    Sha256Digest key;
    std::shared_ptr<const Value> value;
    std::size_t bytes;
  };
  using KeptList = std::list<Kept>;
  // What waits or is being made, with those who asked for it.
  using Asked = std::map<Sha256Digest, std::vector<Listener>>;

  void Run() {
    while (true) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !waiting_.empty(); });
      if (stopping_) return;
      const Wanted next = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      const Result result = Make(next);
      lock.lock();
      if (result.ok()) Keep(next.key, *result);
      const std::vector<Listener> listeners = std::move(asked_.extract(next.key).mapped());
      lock.unlock();
      for (const Listener& done : listeners) done(result);
    }
  }

  Result Make(const Wanted& wanted) try { return make_(wanted); } catch (const std::exception& error) {
    metrics_.CountFailed();
    return absl::InternalError(error.what());
  }

  // With the mutex held.
  std::shared_ptr<const Value> FindKept(const Sha256Digest& key) {
    const auto place = places_.find(key);
    if (place == places_.end()) return nullptr;
    metrics_.CountFound();
    kept_.splice(kept_.begin(), kept_, place->second);
    return place->second->value;
  }

  void Keep(const Sha256Digest& key, const std::shared_ptr<const Value>& value) {
    kept_.push_front({key, value, bytes_of_(*value)});
    places_[key] = kept_.begin();
    kept_bytes_ += kept_.front().bytes;
    while (kept_.size() > 1 && (kept_.size() > limits_.values || kept_bytes_ > limits_.bytes)) {
      kept_bytes_ -= kept_.back().bytes;
      places_.erase(kept_.back().key);
      kept_.pop_back();
      metrics_.CountEvicted();
    }
    metrics_.SetKept(kept_.size(), kept_bytes_);
  }

  const Limits limits_;
  const char* const refusal_;
  const std::function<Result(const Wanted&)> make_;
  const std::function<std::size_t(const Value&)> bytes_of_;
  CompileMetrics& metrics_;

  std::mutex mutex_;  // Guards the members up to the blank line.
  KeptList kept_;     // The one used last first.
  std::map<Sha256Digest, typename KeptList::iterator> places_;
  std::size_t kept_bytes_ = 0;
  Asked asked_;
  std::deque<Wanted> waiting_;  // The one that waits longest first.
  bool stopping_ = false;
  std::condition_variable changed_;

  std::vector<std::thread> threads_;  // Last, because they use all other members.
};

}  // namespace albtpu::server
