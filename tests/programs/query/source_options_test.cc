#include "programs/query/source_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "annotate/run/file_progress.h"
#include "tables/file/table_io.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::programs {
namespace {

using ::testing::HasSubstr;

// A folder of tables in the place of the installed ones.
class SourceOptionsTest : public ::testing::Test {
 protected:
  SourceOptionsTest() { setenv("ALBTPU_TABLES", (folder_ / "").c_str(), 1); }
  ~SourceOptionsTest() override { unsetenv("ALBTPU_TABLES"); }

  void Install(const std::string& name, const std::string& version, double factor, bool published = false) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    const absl::Status status =
        WriteTable(albtpu::testing::SyntheticTable({.version = version, .factor = factor, .published = published}),
                   folder_ / name, Existing::kKeep);
    ASSERT_TRUE(status.ok()) << status;
  }

  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(SourceOptionsTest, AnswersFromTheOnlyInstalledTable) {
  Install("quick.h5", "1", 1);
  EXPECT_EQ(OpenSource({}).value()->table().name, "quick");
}

TEST_F(SourceOptionsTest, PrefersSurveyAndTheNewestVersion) {
  Install("quick.h5", "1", 1);
  EXPECT_TRUE(OpenSource({}).ok());
  Install("survey/9.h5", "9", 1);
  Install("survey/10.h5", "10", 2);
  EXPECT_EQ(OpenSource({}).value()->table().name, "survey/10");
  EXPECT_EQ(OpenSource({.name = "survey/9"}).value()->table().version, "9");
  EXPECT_EQ(OpenSource({.name = "quick"}).value()->table().name, "quick");
  const std::vector<client::TableSummary> tables = ListTables({}).value();
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[1].name, "survey/10");
  EXPECT_TRUE(tables[1].is_default);
  EXPECT_FALSE(tables[2].is_default);
  EXPECT_EQ(ListTables({.name = "survey"}).value().size(), 2u);
}

TEST_F(SourceOptionsTest, TakesAPublishedTableOnlyWhenNamed) {
  Install("bay.h5", "1", 1);
  Install("article.h5", "1", 2, true);
  Install("book.h5", "1", 2, true);
  EXPECT_EQ(OpenSource({}).value()->table().name, "bay");
  EXPECT_EQ(OpenSource({.name = "book"}).value()->table().name, "book");
  const std::vector<client::TableSummary> tables = ListTables({}).value();
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_FALSE(tables[0].is_default);
  EXPECT_TRUE(tables[1].is_default);
}

TEST_F(SourceOptionsTest, ListsTheNamesWhereNoneIsTheDefault) {
  Install("a.h5", "1", 1);
  Install("b.h5", "1", 1);
  const absl::Status status = OpenSource({}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()), HasSubstr("a, b"));
  EXPECT_EQ(OpenSource({.name = "c"}).status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(ListTables({.name = "c"}).status().code(), absl::StatusCode::kNotFound);
}

TEST_F(SourceOptionsTest, SaysHowElseToFindATable) {
  setenv("ALBTPU_TABLES", (folder_ / "no").c_str(), 1);
  EXPECT_THAT(std::string(OpenSource({}).status().message()), HasSubstr("a service with --server"));
}

TEST_F(SourceOptionsTest, TakesNoNameBesideAFile) {
  EXPECT_TRUE(formats::IsUsageError(OpenSource({.file = "x.h5", .name = "x"}).status()));
}

TEST_F(SourceOptionsTest, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(std::string(OpenSource({.file = folder_ / "no.h5"}).status().message()), HasSubstr("no.h5"));
  const std::string foreign = folder_.Write("foreign.h5", "\x89HDF\r\n\x1a\n and more").string();
  EXPECT_EQ(OpenSource({.file = foreign}).status().code(), absl::StatusCode::kDataLoss);
}

}  // namespace
}  // namespace albtpu::programs
