#include <gtest/gtest.h>

#include <optional>

#include "service/server/calls/uncertainty_service.h"
#include "service/server/ground/limits.h"
#include "service/server/observe/metrics.h"

namespace albtpu::server {
namespace {

class UnreadAnswersTest : public ::testing::Test {
 protected:
  ServerMetrics metrics_;
  UnreadAnswers unread_{metrics_.calls, kMaxStreamIdle};
  grpc::CallbackServerContext context_;  // Belongs to no call.
};

TEST_F(UnreadAnswersTest, HaveRoomUpToTheLimit) {
  EXPECT_TRUE(unread_.HasRoomFor(kMaxUnreadBytes));
  EXPECT_FALSE(unread_.HasRoomFor(kMaxUnreadBytes + 1));
}

TEST_F(UnreadAnswersTest, TakeRoomUntilTheyAreDestroyed) {
  std::optional<UnreadAnswers::Entry> first;
  first.emplace(unread_, context_, 1000);
  {
    const UnreadAnswers::Entry second(unread_, context_, kMaxUnreadBytes - 1000);
    EXPECT_FALSE(unread_.HasRoomFor(1));
    first.reset();
    EXPECT_TRUE(unread_.HasRoomFor(1000));
    EXPECT_FALSE(unread_.HasRoomFor(1001));
  }
  EXPECT_TRUE(unread_.HasRoomFor(kMaxUnreadBytes));
}

TEST_F(UnreadAnswersTest, AreKeptUntilTheirTimeIsUp) {
  const UnreadAnswers::Entry answer(unread_, context_, 1000);
  unread_.DropUnread(UnreadAnswers::Clock::now());
  EXPECT_FALSE(unread_.HasRoomFor(kMaxUnreadBytes));
}

}  // namespace
}  // namespace albtpu::server
