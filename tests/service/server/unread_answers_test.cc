#include "service/server/calls/unread_answers.h"

#include <gtest/gtest.h>

#include <optional>

#include "service/server/ground/limits.h"
#include "service/server/observe/server_metrics.h"

namespace albtpu::server {
namespace {

class UnreadAnswersTest : public ::testing::Test {
 protected:
  ServerMetrics metrics_;
  UnreadAnswers unread_{metrics_.calls};
  grpc::CallbackServerContext context_;  // Of no call.
};

TEST_F(UnreadAnswersTest, HaveRoomUpToTheLimit) {
  EXPECT_TRUE(unread_.HaveRoomFor(kMaxUnreadBytes));
  EXPECT_FALSE(unread_.HaveRoomFor(kMaxUnreadBytes + 1));
}

TEST_F(UnreadAnswersTest, TakeRoomUntilTheyHaveGone) {
  std::optional<UnreadAnswers::Answer> first;
  first.emplace(unread_, context_, 1000);
  {
    const UnreadAnswers::Answer second(unread_, context_, kMaxUnreadBytes - 1000);
    EXPECT_FALSE(unread_.HaveRoomFor(1));
    first.reset();
    EXPECT_TRUE(unread_.HaveRoomFor(1000));
    EXPECT_FALSE(unread_.HaveRoomFor(1001));
  }
  EXPECT_TRUE(unread_.HaveRoomFor(kMaxUnreadBytes));
}

TEST_F(UnreadAnswersTest, StayUntilTheyAreDue) {
  const UnreadAnswers::Answer answer(unread_, context_, 1000);
  unread_.DropUnread(UnreadAnswers::Clock::now());
  EXPECT_FALSE(unread_.HaveRoomFor(kMaxUnreadBytes));
}

}  // namespace
}  // namespace albtpu::server
