#include "generator/campaign/unit_work.h"

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <mutex>
#include <thread>

#include "generator/campaign/table_maker.h"
#include "tests/generator/campaign/two_seas.h"

namespace albtpu {
namespace {

// The messages between ranks that are threads of this process.
class Post {
 public:
  void Put(int to, Ranks::Message message) {
    const std::lock_guard lock(mutex_);
    boxes_[to].push_back(std::move(message));
  }
  std::optional<Ranks::Message> Take(int rank) {
    const std::lock_guard lock(mutex_);
    std::deque<Ranks::Message>& box = boxes_[rank];
    if (box.empty()) return std::nullopt;
    Ranks::Message message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::map<int, std::deque<Ranks::Message>> boxes_;
};

class ThreadRank final : public Ranks {
 public:
  ThreadRank(Post& post, int rank, int size) : post_(post), rank_(rank), size_(size) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void Send(int to, int tag, const std::string& bytes) override { post_.Put(to, {rank_, tag, bytes}); }
  std::optional<Message> Poll() override { return post_.Take(rank_); }
  [[noreturn]] void EndAll() override { std::abort(); }

 private:
  Post& post_;
  int rank_, size_;
};

using Units = std::map<UnitId, std::string>;

// The units of TwoSeas(), computed on `size` ranks.
Units ComputedOn(int size) {
  Post post;
  std::vector<std::thread> others;
  for (int rank = 1; rank < size; ++rank) {
    others.emplace_back([&post, rank, size] {
      ThreadRank ranks(post, rank, size);
      EXPECT_TRUE(FollowRankZero(ranks).ok());
    });
  }
  ThreadRank ranks(post, 0, size);
  Units units;
  const absl::Status status = ComputeUnits(TwoSeas(), UnitsOf(TwoSeas()), ranks,
                                           [&](UnitId unit, const std::string& bytes, const std::string&) {
                                             EXPECT_TRUE(units.emplace(unit, bytes).second) << Name(unit);
                                             return absl::OkStatus();
                                           });
  EXPECT_TRUE(status.ok()) << status;
  Dismiss(ranks);
  for (std::thread& other : others) other.join();
  return units;
}

TEST(UnitWork, ComputesEachUnitOnceAndTheSameOnAnyNumberOfRanks) {
  const Units alone = ComputedOn(1);
  EXPECT_EQ(alone.size(), UnitsOf(TwoSeas()).size());
  EXPECT_EQ(ComputedOn(3), alone);
}

TEST(UnitWork, EndsAtTheFirstFailureOfTheSink) {
  int calls = 0;
  const absl::Status status =
      ComputeUnits(TwoSeas(), UnitsOf(TwoSeas()), *OneRank(), [&](UnitId, const std::string&, const std::string&) {
        ++calls;
        return absl::ResourceExhaustedError("full");
      });
  EXPECT_EQ(status.message(), "full");
  EXPECT_EQ(calls, 1);
}

TEST(UnitWork, SucceedsWithoutUnits) {
  const auto never = [](UnitId, const std::string&, const std::string&) { return absl::InternalError("called"); };
  EXPECT_TRUE(ComputeUnits(TwoSeas(), {}, *OneRank(), never).ok());
}

}  // namespace
}  // namespace albtpu
