#include "service/server/tables/table_catalog.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/service/server/served_tables.h"

namespace albtpu::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Catalog : public ::testing::Test {
 protected:
  void Add(const std::string& file) { WriteOrDie(table_, folder_ / file); }
  absl::StatusOr<TableCatalog> Load(std::string_view default_table = "") {
    return TableCatalog::Load(folder_.path(), default_table);
  }

  const UncertaintyTable table_ = testing::TinyTable();
  testing::TemporaryFolder folder_;
};

TEST_F(Catalog, FindsTablesByName) {
  Add("quick.h5");
  Add("survey/2.h5");
  Add("survey/10.h5");
  const TableCatalog catalog = OrDie(Load());
  EXPECT_EQ(OrDie(catalog.Find("quick"))->name, "quick");
  EXPECT_EQ(OrDie(catalog.Find("survey"))->name, "survey/10");
  EXPECT_EQ(OrDie(catalog.Find("survey/2"))->name, "survey/2");
  EXPECT_EQ(OrDie(catalog.Find(""))->name, "survey/10");
  EXPECT_EQ(OrDie(catalog.Find("quick"))->table.digest(), table_.digest());
}

// tests/tables/file/table_folder_test.cc has all ways to a default.
TEST_F(Catalog, HasADefaultThatExistsAndIsNotPublished) {
  WriteOrDie(testing::SyntheticTable({.published = true}), folder_ / "article.h5");
  Add("b.h5");
  EXPECT_EQ(OrDie(OrDie(Load()).Find(""))->name, "b");
  EXPECT_EQ(OrDie(OrDie(Load()).Find("article"))->name, "article");
  Add("a.h5");
  EXPECT_EQ(OrDie(Load()).Find("").status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(OrDie(OrDie(Load("b")).Find(""))->name, "b");
  const absl::Status status = Load("survey").status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), AllOf(HasSubstr("'survey'"), HasSubstr("b")));
}

TEST_F(Catalog, RejectsAnEmptyFolder) {
  const absl::Status status = Load().status();
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("NAME.h5"));
}

TEST_F(Catalog, RejectsADamagedTableAndNamesItsFile) {
  Add("quick.h5");
  std::ofstream(folder_ / "survey.h5") << "not a table";
  EXPECT_THAT(std::string(Load().status().message()), HasSubstr((folder_ / "survey.h5").string()));
  std::filesystem::resize_file(folder_ / "quick.h5", 2000);
  std::filesystem::remove(folder_ / "survey.h5");
  EXPECT_THAT(std::string(Load().status().message()), HasSubstr((folder_ / "quick.h5").string()));
}

}  // namespace
}  // namespace albtpu::server
