#include "tables/s44.h"

#include <gtest/gtest.h>

#include <limits>

namespace albtpu {
namespace {

// IHO S-44 edition 6.1.0, Table 1, computed by hand.
TEST(S44, LimitsThuByOrder) {
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::kExclusive, 40), 1);
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::kSpecial, 40), 2);
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::k1a, 40), 7);
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::k1b, 40), 7);
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::k2, 40), 24);
}

TEST(S44, LimitsTvuByOrder) {
  EXPECT_DOUBLE_EQ(TvuLimit(S44Order::kExclusive, 0), 0.15);
  EXPECT_DOUBLE_EQ(TvuLimit(S44Order::kSpecial, 0), 0.25);
  EXPECT_NEAR(TvuLimit(S44Order::kExclusive, 40), 0.335410196625, 1e-12);  // sqrt(0.15^2 + 0.3^2)
  EXPECT_NEAR(TvuLimit(S44Order::kSpecial, 40), 0.390512483795, 1e-12);    // sqrt(0.25^2 + 0.3^2)
  EXPECT_NEAR(TvuLimit(S44Order::k1a, 40), 0.721387551875, 1e-12);         // sqrt(0.5^2 + 0.52^2)
  EXPECT_EQ(TvuLimit(S44Order::k1b, 40), TvuLimit(S44Order::k1a, 40));
  EXPECT_NEAR(TvuLimit(S44Order::k2, 40), 1.358823020117, 1e-12);  // sqrt(1 + 0.92^2)
}

TEST(S44, KeepsTheLimitPrintedInThePaperApart) {
  EXPECT_DOUBLE_EQ(ThuLimitAsPrintedByBirkebak(10), 5.2);
  EXPECT_DOUBLE_EQ(ThuLimit(S44Order::k1b, 10), 5.5);
}

TEST(S44, FindsEveryOrderByItsName) {
  for (S44Order order : kS44Orders) EXPECT_EQ(FindS44Order(Name(order)), order);
  EXPECT_EQ(FindS44Order("1c"), std::nullopt);
  EXPECT_EQ(FindS44Order(""), std::nullopt);
}

TEST(S44, FindsTheStrictestOrderThatBothUncertaintiesMeet) {
  EXPECT_EQ(BestOrder(0, 0, 10), S44Order::kExclusive);
  EXPECT_EQ(BestOrder(1.5, 0.1, 10), S44Order::kSpecial);  // THU decides
  EXPECT_EQ(BestOrder(0.1, 0.2, 10), S44Order::kSpecial);  // TVU decides
  EXPECT_EQ(BestOrder(0.1, 0.3, 10), S44Order::k1a);
  EXPECT_EQ(BestOrder(5.51, 0.1, 10), S44Order::k2);
  EXPECT_EQ(BestOrder(0.1, 1.1, 10), std::nullopt);
  EXPECT_EQ(BestOrder(21.1, 0, 10), std::nullopt);
}

TEST(S44, DoesNotMeetAnOrderExactlyAtItsLimit) {
  EXPECT_EQ(BestOrder(1, 0, 0), S44Order::kSpecial);
  EXPECT_EQ(BestOrder(0, 0.15, 0), S44Order::kSpecial);
}

TEST(S44, FindsNoOrderForNaN) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(BestOrder(nan, 0.1, 10), std::nullopt);
  EXPECT_EQ(BestOrder(0.1, nan, 10), std::nullopt);
}

TEST(S44, HasLooserLimitsFromOrderToOrder) {
  for (double depth : {0.0, 1.0, 20.0, 100.0}) {
    for (std::size_t i = 1; i < kS44Orders.size(); ++i) {
      EXPECT_LE(ThuLimit(kS44Orders[i - 1], depth), ThuLimit(kS44Orders[i], depth));
      EXPECT_LE(TvuLimit(kS44Orders[i - 1], depth), TvuLimit(kS44Orders[i], depth));
    }
  }
}

TEST(S44, SubtractsBudgetsInQuadrature) {
  EXPECT_DOUBLE_EQ(*RemainingBudget(5, 3), 4);
  EXPECT_DOUBLE_EQ(*RemainingBudget(0.5, 0), 0.5);
  EXPECT_EQ(*RemainingBudget(0.5, 0.5), 0);
  EXPECT_EQ(RemainingBudget(0.5, 0.51), std::nullopt);
  EXPECT_EQ(RemainingBudget(0.5, std::numeric_limits<double>::quiet_NaN()), std::nullopt);
}

}  // namespace
}  // namespace albtpu
