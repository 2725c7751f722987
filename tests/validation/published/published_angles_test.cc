#include "validation/published/published_angles.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(PublishedAngles, HoldTheTablesOfThePaper) {
  const absl::StatusOr<PublishedAngles> table_3 = ReadTable3(PAPER_FOLDER);
  EXPECT_THAT(table_3->wind_speeds, ElementsAre(2, 2.5, 3, 3.5, 4, 5.25));
  EXPECT_THAT(table_3->incidences, ElementsAre(0, 5, 10, 15, 20));
  EXPECT_EQ(table_3->At(0, 1).along, 2.49);
  EXPECT_EQ(table_3->At(4, 0).cross, 2.25);
  int doubtful = 0;
  for (const PublishedAngles::Cell& cell : table_3->cells) doubtful += !cell.along_is_clean + !cell.cross_is_clean;
  EXPECT_EQ(doubtful, 3);
  EXPECT_FALSE(table_3->At(5, 1).along_is_clean);

  const absl::StatusOr<PublishedAngles> table_4 = ReadTable4(PAPER_FOLDER);
  EXPECT_THAT(table_4->incidences, ElementsAre(0, 10, 15, 20));
  EXPECT_EQ(table_4->At(5, 3).along, 4.58);
}

TEST(PublishedAngles, RequireEveryWindWithEveryIncidence) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder / "table4_empirical.csv")
      << "wind_speed_m_s,incidence_deg,along_wind_deg,cross_wind_deg\n2,0,3,3\n2,10,3,3\n3,0,3,3\n";
  const absl::Status status = ReadTable4(folder.path()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), HasSubstr("expected every wind with every incidence"));
}

}  // namespace
}  // namespace albtpu
