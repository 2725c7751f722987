#include "validation/published/published_table.h"

#include <gmock/gmock.h>

#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class PublishedTableTest : public ::testing::Test {
 protected:
  std::filesystem::path File(const std::string& text) { return folder_.Write("table.csv", text); }
  testing::TemporaryFolder folder_;
};

TEST_F(PublishedTableTest, ReadsItsColumnsAsNumbersAndWords) {
  const auto table = PublishedTable::Read(File("# attribution\nwind_m_s,reading\n2.5,clean\n5.25,doubtful\n"));
  EXPECT_EQ(table->size(), 2);
  EXPECT_THAT(*table->Numbers("wind_m_s"), ElementsAre(2.5, 5.25));
  EXPECT_THAT(*table->Words("reading"), ElementsAre("clean", "doubtful"));
}

TEST_F(PublishedTableTest, NamesFileLineAndColumnOfAnError) {
  EXPECT_THAT(std::string(PublishedTable::Read(folder_ / "none.csv").status().message()),
              HasSubstr("none.csv: cannot be read"));
  EXPECT_THAT(std::string(PublishedTable::Read(File("a,b\n1\n")).status().message()),
              HasSubstr("line 2 has 1 cells: there are 2 columns"));
  EXPECT_THAT(std::string(PublishedTable::Read(File("a,b\n")).status().message()), HasSubstr("no rows"));
  const auto table = PublishedTable::Read(File("a,b\n1,two\n"));
  EXPECT_THAT(std::string(table->Numbers("b").status().message()),
              HasSubstr("line 2, column 'b': 'two' is not a number"));
  EXPECT_THAT(std::string(table->Words("c").status().message()), HasSubstr("no column 'c': there are a, b"));
}

}  // namespace
}  // namespace albtpu
