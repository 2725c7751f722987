#include "service/server/ground/periodic_task.h"

#include <gtest/gtest.h>

#include <future>
#include <optional>
#include <utility>

namespace albtpu::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::chrono::hours kLong{1};

TEST(PeriodicTask, RunsRepeatedly) {
  std::promise<void> third;
  int times = 0;
  const PeriodicTask task(milliseconds(1), [&] {
    if (++times == 3) third.set_value();
  });
  third.get_future().wait();
}

TEST(PeriodicTask, StopsAtOnceHoweverLongItsInterval) {
  bool worked = false;
  {
    const PeriodicTask task(kLong, [&] { worked = true; });
  }
  EXPECT_FALSE(worked);
}

TEST(PeriodicTask, WaitsForItsWorkToEnd) {
  std::promise<void> begun;
  bool done = false;
  {
    const PeriodicTask task(milliseconds(1), [&, first = true]() mutable {
      if (!std::exchange(first, false)) return;
      begun.set_value();
      done = true;
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(done);
}

TEST(IdleWatch, NoticesInactivity) {
  std::promise<void> idle;
  const auto begin = steady_clock::now();
  const IdleWatch watch(milliseconds(20), [&] { idle.set_value(); });
  idle.get_future().wait();
  EXPECT_GE(steady_clock::now() - begin, milliseconds(20));
}

TEST(IdleWatch, StartsAgainAfterActivity) {
  // On a busy machine the activity may come too late: then the test repeats with a longer limit.
  bool active_in_time = false;
  for (milliseconds limit(50); !active_in_time; limit *= 2) {
    std::promise<void> idle;
    const auto begin = steady_clock::now();
    IdleWatch watch(limit, [&] { idle.set_value(); });
    watch.NoteActivity();
    active_in_time = steady_clock::now() - begin < limit;
    idle.get_future().wait();
    if (active_in_time) {
      EXPECT_GE(steady_clock::now() - begin, 2 * limit);
    }
  }
}

TEST(IdleWatch, NoticesNothingAfterItsDestruction) {
  bool noticed = false;
  {
    const IdleWatch watch(kLong, [&] { noticed = true; });
  }
  EXPECT_FALSE(noticed);
}

TEST(IdleWatch, MayBeDestroyedByItsCallback) {
  std::promise<void> ended;
  std::optional<IdleWatch> watch;
  std::promise<void> made;
  watch.emplace(milliseconds(1), [&, is_made = made.get_future().share()] {
    is_made.wait();
    watch.reset();
    ended.set_value();
  });
  made.set_value();
  ended.get_future().wait();
  EXPECT_FALSE(watch.has_value());
}

}  // namespace
}  // namespace albtpu::server
