// The form of the laboratory studies. tests/validation/physics tests their results.
#include "validation/laboratory/laboratory_studies.h"

#include <gtest/gtest.h>

#include <string>

namespace albtpu {
namespace {

TEST(LaboratoryStudy, NamesAMissingPublishedTable) {
  StudyOptions options;
  options.published = "nowhere";
  EXPECT_EQ(LaboratoryStudy(options).status().code(), absl::StatusCode::kNotFound);
  EXPECT_NE(std::string(LaboratoryStudy(options).status().message()).find("nowhere/table4_empirical.csv"),
            std::string::npos);
}

TEST(WaveStaffStudy, NamesAMissingPublishedTable) {
  StudyOptions options;
  options.published = "nowhere";
  EXPECT_NE(std::string(WaveStaffStudy(options).status().message()).find("nowhere/table2_wave_staff.csv"),
            std::string::npos);
}

TEST(WaveStaffStudy, ComparesEveryPublishedNumber) {
  StudyOptions options;
  options.published = PAPER_FOLDER;
  options.quick = true;
  const auto study = WaveStaffStudy(options);
  EXPECT_EQ(study->comparisons.size(), 18u);  // six fetches, three quantities
  for (const DataTable& table : study->tables) {
    ASSERT_FALSE(table.rows.empty()) << table.name;
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
  }
}

}  // namespace
}  // namespace albtpu
