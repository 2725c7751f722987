#include <gtest/gtest.h>

#include "formats/text/text.h"

namespace albtpu::formats {
namespace {

TEST(OneLine, ReplacesControlCharactersOnly) {
  EXPECT_EQ(OneLine("expected 'nan', saw 'n\n'\t\x7f"), "expected 'nan', saw 'n?'??");
  EXPECT_EQ(OneLine("4 °C"), "4 °C");
}

}  // namespace
}  // namespace albtpu::formats
