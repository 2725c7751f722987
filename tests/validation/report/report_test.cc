#include "validation/report/report.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tables/file/output_folder.h"
#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

Study Example() {
  Study study;
  study.id = "table_9";
  study.title = "Table 9: <slopes> & angles";
  study.paragraphs = {"It is less than 1 < 2."};
  study.comparisons = {{"THU", "m", 1.0, 1.5, 0.125, Verdict::kDiffers, "beyond, by far"}};
  study.tables = {{"table_9", "Angles", {"wind_m_s", "reading"}, {{2.5, "a \"clean\", one"}, {kNoNumber, "b"}}}};
  study.figures = {{"figure_9", "Wind and angle"}};
  return study;
}

TEST(Csv, QuotesTextAndLeavesMissingNumbersEmpty) {
  EXPECT_EQ(CsvOf(Example().tables[0]), "wind_m_s,reading\n2.5,\"a \"\"clean\"\", one\"\n,b\n");
}

TEST(Csv, SummarizesEveryComparison) {
  EXPECT_EQ(CsvOf(SummaryOf({Example()})),
            "study,quantity,unit,published,ours,standard_error,difference,verdict,basis\n"
            "table_9,THU,m,1,1.5,0.125,0.5,differs,\"beyond, by far\"\n");
}

class ReportTest : public ::testing::Test {
 protected:
  // A folder with this text as its draw.py.
  ReportOptions Options(const std::string& drawing) {
    folder_.Write("draw.py", drawing);
    return {folder_ / "report", folder_.path(), "Made by a test."};
  }
  std::string Page() { return testing::ReadFile(folder_ / "report" / "report.html"); }

  testing::TemporaryFolder folder_;
};

constexpr const char* kDraws =
    "import sys\nfor f in sys.argv[3:]: open(f'{sys.argv[2]}/{f}.svg', 'w').write('<svg/>')\n";
constexpr const char* kDrawsNothing = "import sys\nsys.exit('no matplotlib')\n";

TEST_F(ReportTest, WritesPageTablesAndFigures) {
  const ReportOptions options = Options(kDraws);
  ASSERT_TRUE(PrepareFolder(options.folder, Existing::kReplace).ok());
  const auto missing = WriteReport({Example()}, options);
  EXPECT_THAT(*missing, IsEmpty());
  EXPECT_THAT(Page(), AllOf(HasSubstr("Table 9: &lt;slopes&gt; &amp; angles"), HasSubstr("1 &lt; 2"),
                            HasSubstr("data:image/svg+xml;base64,PHN2Zy8+"), HasSubstr("1 differ"),
                            HasSubstr("Made by a test."), Not(HasSubstr("http"))));
  EXPECT_EQ(testing::ReadFile(options.folder / "table_9.csv"), CsvOf(Example().tables[0]));
  EXPECT_EQ(testing::ReadFile(options.folder / "summary.csv"), CsvOf(SummaryOf({Example()})));
  EXPECT_EQ(testing::ReadFile(options.folder / "figure_9.svg"), "<svg/>");
  for (const auto& entry : std::filesystem::directory_iterator(options.folder))
    EXPECT_NE(entry.path().filename().string()[0], '.') << "temporary file left behind: " << entry.path();
}

TEST_F(ReportTest, KeepsItsTablesIfNoFigureCanBeDrawn) {
  const ReportOptions options = Options(kDrawsNothing);
  ASSERT_TRUE(PrepareFolder(options.folder, Existing::kReplace).ok());
  const auto missing = WriteReport({Example()}, options);
  EXPECT_EQ(*missing, "no matplotlib");
  EXPECT_THAT(Page(), AllOf(HasSubstr("Figures are missing:</strong> no matplotlib"), HasSubstr("figure_9 is missing"),
                            HasSubstr("a &quot;clean&quot;, one")));
}

TEST_F(ReportTest, ReplacesFilesOnlyIfTold) {
  const ReportOptions options = Options(kDraws);
  std::filesystem::create_directory(options.folder);
  std::ofstream(options.folder / "table_9.csv") << "mine";
  EXPECT_TRUE(absl::IsAlreadyExists(PrepareFolder(options.folder, Existing::kKeep)));
  EXPECT_EQ(testing::ReadFile(options.folder / "table_9.csv"), "mine");
  ASSERT_TRUE(PrepareFolder(options.folder, Existing::kReplace).ok());
  ASSERT_TRUE(WriteReport({Example()}, options).ok());
  EXPECT_THAT(Page(), HasSubstr("Table 9"));
  EXPECT_TRUE(std::filesystem::exists(options.folder / "figure_9.svg"));

  folder_.Write("draw.py", kDrawsNothing);
  ASSERT_TRUE(WriteReport({Example()}, options).ok());
  EXPECT_FALSE(std::filesystem::exists(options.folder / "figure_9.svg")) << "drawn from other numbers";
}

TEST_F(ReportTest, RefusesAFolderThatCannotBeCreated) {
  ReportOptions options = Options(kDraws);
  options.folder = folder_ / "none" / "report";
  EXPECT_TRUE(absl::IsNotFound(PrepareFolder(options.folder, Existing::kKeep)));
  options.folder = folder_ / "draw.py";
  EXPECT_TRUE(absl::IsNotFound(PrepareFolder(options.folder, Existing::kKeep)));
}

}  // namespace
}  // namespace albtpu
