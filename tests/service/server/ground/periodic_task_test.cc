#include "service/server/ground/periodic_task.h"

#include <gtest/gtest.h>

#include <future>
#include <utility>

namespace albtpu::server {
namespace {

TEST(PeriodicTask, RunsRepeatedly) {
  std::promise<void> third;
  int times = 0;
  const PeriodicTask task(std::chrono::milliseconds(1), [&] {
    if (++times == 3) third.set_value();
  });
  third.get_future().wait();
}

TEST(PeriodicTask, StopsAtOnceHoweverLongItsInterval) {
  bool worked = false;
  {
    const PeriodicTask task(std::chrono::hours(1), [&] { worked = true; });
  }
  EXPECT_FALSE(worked);
}

TEST(PeriodicTask, WaitsForItsWorkToEnd) {
  std::promise<void> begun;
  bool done = false;
  {
    const PeriodicTask task(std::chrono::milliseconds(1), [&, first = true]() mutable {
      if (!std::exchange(first, false)) return;
      begun.set_value();
      done = true;
    });
    begun.get_future().wait();
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace albtpu::server
