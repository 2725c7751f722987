#include <gmock/gmock.h>

#include "absl/strings/match.h"
#include "validation/studies/studies.h"

namespace albtpu {
namespace {

using ::testing::HasSubstr;

TEST(AngleMethodStudy, JudgesTheTwentyValuesOfTable5) {
  const absl::StatusOr<Study> study = AngleMethodStudy({.published = PAPER_FOLDER});
  int by_quadrature = 0;
  for (const Comparison& comparison : study->comparisons) {
    if (!absl::StrContains(comparison.quantity, "by quadrature")) continue;
    ++by_quadrature;
    EXPECT_EQ(comparison.verdict, Verdict::kAgrees) << comparison.quantity;
    EXPECT_NEAR(comparison.ours, comparison.published, 0.010) << comparison.quantity;
  }
  EXPECT_EQ(by_quadrature, 20);
}

TEST(AngleMethodStudy, ReportsThatTheLimitOfThePaperIsNotThatOfS44) {
  const Study study = AngleMethodStudy({.published = PAPER_FOLDER}).value();
  const Comparison& limit = study.comparisons.back();
  EXPECT_THAT(limit.quantity, HasSubstr("in S-44 itself"));
  EXPECT_EQ(limit.verdict, Verdict::kDiffers);
  EXPECT_DOUBLE_EQ(limit.ours, 5.5);
}

TEST(AngleMethodStudy, NeedsTheTablesOfThePaper) {
  const absl::Status status = AngleMethodStudy({.published = "/nowhere"}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("/nowhere"));
}

}  // namespace
}  // namespace albtpu
