#include "tables/file/table_folder.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class TableFolder : public ::testing::Test {
 protected:
  void Touch(const std::string& name) {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream stream(path);
  }

  std::vector<std::string> FullNames() {
    const absl::StatusOr<std::vector<TableFile>> tables = FindTables(folder_.path());
    std::vector<std::string> names;
    for (const TableFile& table : *tables) names.push_back(table.FullName());
    return names;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(TableFolder, HoldsTablesByNameAndVersion) {
  Touch("quick.h5");
  Touch("survey/1.9.h5");
  Touch("survey/1.10.h5");
  EXPECT_THAT(FullNames(), ElementsAre("quick", "survey/1.10", "survey/1.9"));
}

TEST_F(TableFolder, MayHoldOtherFiles) {
  for (const char* name : {"README", "quick.h5.bak", ".hidden.h5", ".albtpu-1-0.tmp", "two words.h5", "notes/README",
                           ".git/x.h5", "deep/er/1.h5", "empty/.keep"})
    Touch(name);
  std::filesystem::create_directories(folder_ / "sub" / "2.h5");  // A folder is not a table, whatever its name.
  EXPECT_THAT(FullNames(), IsEmpty());
}

TEST_F(TableFolder, StatesTheDigestsOfItsTables) {
  EXPECT_THAT(DigestsText(folder_ / "absent"), HasSubstr("no tables: there is no folder"));
  EXPECT_THAT(DigestsText(folder_.path()), HasSubstr("no tables: no .h5 file in "));
  Touch("quick.h5");  // Empty, and so no table.
  EXPECT_THAT(DigestsText(folder_.path()), AllOf(HasSubstr("table quick "), HasSubstr("quick.h5: ")));
}

TEST_F(TableFolder, ListsWhatHasTheNameOfATableWhateverItHolds) {
  std::filesystem::create_symlink("nowhere", folder_ / "broken.h5");
  EXPECT_THAT(FullNames(), ElementsAre("broken"));
}

TEST_F(TableFolder, MustExist) {
  const absl::Status status = FindTables(folder_ / "nowhere").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("nowhere"));
}

TEST_F(TableFolder, MayNotGiveOneNameToTwoTables) {
  Touch("quick.h5");
  Touch("quick/1.h5");
  const absl::Status status = FindTables(folder_.path()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), AllOf(HasSubstr("quick.h5'"), HasSubstr("quick/1.h5'")));
}

TEST(Version, IsOrderedByNumbers) {
  const std::vector<std::string> from_the_oldest = {"",           "1",        "1.0",  "1.0-rc1", "1.2",
                                                    "1.10",       "2",        "10",   "010.1",   "2024-05-01",
                                                    "2024-12-01", "20240501", "beta", "v9",      "v10"};
  for (std::size_t i = 0; i < from_the_oldest.size(); ++i) {
    for (std::size_t j = 0; j < from_the_oldest.size(); ++j) {
      EXPECT_EQ(IsOlder(from_the_oldest[i], from_the_oldest[j]), i < j)
          << from_the_oldest[i] << " and " << from_the_oldest[j];
    }
  }
}

TEST(Version, DistinguishesLeadingZeros) {
  EXPECT_TRUE(IsOlder("1.01", "1.1") || IsOlder("1.1", "1.01"));
  EXPECT_FALSE(IsOlder("1.01", "1.1") && IsOlder("1.1", "1.01"));
}

std::vector<TableFile> Named(const std::vector<std::pair<std::string, std::string>>& names) {
  std::vector<TableFile> tables;
  for (const auto& [name, version] : names) tables.push_back({name, version, {}});
  return tables;
}

TEST(FindTable, TakesTheNewestVersionUnlessOneIsNamed) {
  const auto tables = Named({{"quick", ""}, {"survey", "2"}, {"survey", "1"}});
  EXPECT_EQ(*FindTable(tables, "quick"), 0u);
  EXPECT_EQ(*FindTable(tables, "survey"), 1u);
  EXPECT_EQ(*FindTable(tables, "survey/2"), 1u);
  EXPECT_EQ(*FindTable(tables, "survey/1"), 2u);
}

TEST(FindTable, ListsTheTablesThatThereAre) {
  const auto tables = Named({{"quick", ""}, {"survey", "2"}});
  for (const char* name : {"slow", "survey/3", "quick/", "/quick", "2", "Quick"}) {
    const absl::Status status = FindTable(tables, name).status();
    EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
    EXPECT_THAT(std::string(status.message()),
                AllOf(HasSubstr(std::string("'") + name + "'"), HasSubstr("quick, survey/2")));
  }
}

TEST(FindTable, KeepsItsMessagesShort) {
  std::vector<std::pair<std::string, std::string>> names;
  for (int i = 0; i < 1000; ++i) names.push_back({"table-" + std::to_string(i), ""});
  const absl::Status status = FindTable(Named(names), std::string(100000, '\n')).status();
  EXPECT_LT(status.message().size(), 4000u);
  EXPECT_THAT(std::string(status.message()), AllOf(HasSubstr("...'"), HasSubstr(" more")));
}

TEST(FindTable, PrefersTheGivenDefault) {
  const auto tables = Named({{"quick", ""}, {"survey", ""}});
  EXPECT_EQ(*FindTable(tables, "", "quick"), 0u);
  EXPECT_EQ(*FindTable(tables, "survey", "quick"), 1u);
}

TEST(FindTable, PrefersSurveyNext) {
  EXPECT_EQ(*FindTable(Named({{"a", ""}, {"survey", "2"}, {"survey", "1"}}), ""), 1u);
}

TEST(FindTable, TakesTheOnlyNameNext) {
  EXPECT_EQ(*FindTable(Named({{"a", ""}}), ""), 0u);
  EXPECT_EQ(*FindTable(Named({{"a", "2"}, {"a", "1"}}), ""), 0u);
}

TEST(FindTable, TakesTheOnlyNameThatIsNotPublishedNext) {
  auto tables = Named({{"a", ""}, {"b", "2"}, {"b", "1"}, {"c", ""}});
  tables[0].published = tables[3].published = true;
  EXPECT_EQ(*FindTable(tables, ""), 1u);
  EXPECT_EQ(*FindTable(tables, "c"), 3u);
  tables[1].published = tables[2].published = true;
  EXPECT_EQ(FindTable(tables, "").status().code(), absl::StatusCode::kFailedPrecondition);
}

TEST(FindTable, AsksForANameOtherwise) {
  const absl::Status status = FindTable(Named({{"a", ""}, {"b", ""}}), "").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), HasSubstr("a, b"));
  EXPECT_EQ(FindTable({}, "").status().code(), absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace albtpu
