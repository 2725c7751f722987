#include <gtest/gtest.h>

#include "formats/text/text.h"

namespace albtpu::formats {
namespace {

TEST(PercentText, HasTwoSignificantDigitsAndAllBeforeThePoint) {
  EXPECT_EQ(PercentText(0.002761), "0.28 %");
  EXPECT_EQ(PercentText(0.0104), "1 %");
  EXPECT_EQ(PercentText(0.0112), "1.1 %");
  EXPECT_EQ(PercentText(0.18), "18 %");
  EXPECT_EQ(PercentText(1.234), "123 %");
  EXPECT_EQ(PercentText(0), "0 %");
}

}  // namespace
}  // namespace albtpu::formats
