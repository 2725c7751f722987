#include "service/server/ground/repeated.h"

#include <gtest/gtest.h>

#include <future>
#include <utility>

namespace albtpu::server {
namespace {

TEST(Repeated, WorksAgainAndAgain) {
  std::promise<void> third;
  int times = 0;
  const Repeated repeated(std::chrono::milliseconds(1), [&] {
    if (++times == 3) third.set_value();
  });
  third.get_future().wait();
}

TEST(Repeated, EndsAtOnceHoweverLongItsInterval) {
  bool worked = false;
  {
    const Repeated repeated(std::chrono::hours(1), [&] { worked = true; });
  }
  EXPECT_FALSE(worked);
}

TEST(Repeated, EndsWhenItsWorkIsDone) {
  std::promise<void> begun;
  bool done = false;
  {
    const Repeated repeated(std::chrono::milliseconds(1), [&, first = true]() mutable {
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
