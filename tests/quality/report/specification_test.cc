#include "quality/report/specification.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "tests/temporary_folder.h"

namespace albtpu::quality {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The folder of the specifications that ship.
class ShippedSpecifications : public ::testing::Test {
 protected:
  void SetUp() override { setenv("ALBTPU_SPECIFICATIONS", SHIPPED_SPECIFICATIONS, 1); }
  void TearDown() override { unsetenv("ALBTPU_SPECIFICATIONS"); }

  static const SpecificationClass& Class(const Specification& specification, std::string_view name) {
    for (const SpecificationClass& each : specification.classes)
      if (each.name == name) return each;
    ADD_FAILURE() << name;
    return specification.classes.front();
  }

  struct Expected {
    const char *specification, *of_class;
    Coverage coverage;
    double depth;
    double thu, tvu;  // m; NaN: no limit.
  };
  static void Check(const Expected& expected) {
    const auto specification = FindSpecification(expected.specification);
    EXPECT_FALSE(specification->source.empty());
    const SpecificationClass& of = Class(*specification, expected.of_class);
    EXPECT_EQ(of.coverage, expected.coverage);
    for (const auto& [limit, value] : {std::pair{of.horizontal, expected.thu}, {of.vertical, expected.tvu}}) {
      ASSERT_EQ(limit.has_value(), !std::isnan(value)) << expected.of_class;
      if (limit.has_value()) {
        EXPECT_NEAR(limit->At(expected.depth), value, 1e-9) << expected.of_class;
      }
    }
  }
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// IHO S-44 edition 6.1.0 (2022), table 1: THU; a and b of TVU = sqrt(a^2 + (b d)^2), both at 95 %.
TEST_F(ShippedSpecifications, HaveTheLimitsOfS44) {
  for (const double d : {0.0, 10.0, 40.0}) {
    Check({"s44", "exclusive", Coverage::kP95, d, 1, std::hypot(0.15, 0.0075 * d)});
    Check({"s44", "special", Coverage::kP95, d, 2, std::hypot(0.25, 0.0075 * d)});
    Check({"s44", "1a", Coverage::kP95, d, 5 + 0.05 * d, std::hypot(0.5, 0.013 * d)});
    Check({"s44", "1b", Coverage::kP95, d, 5 + 0.05 * d, std::hypot(0.5, 0.013 * d)});
    Check({"s44", "2", Coverage::kP95, d, 20 + 0.1 * d, std::hypot(1.0, 0.023 * d)});
  }
}

// IHO S-57 edition 3.1, supplement 3, table of zones of confidence. It also states depth accuracies at some depths: A1
// 0.6 m at 10 m, 0.8 at 30, 1.5 at 100; A2 and B 1.2, 1.6, 3.0; C 2.5, 3.5, 7.0.
TEST_F(ShippedSpecifications, HaveTheLimitsOfZonesOfConfidence) {
  Check({"catzoc", "A1", Coverage::kP95, 10, 5.5, 0.6});
  Check({"catzoc", "A1", Coverage::kP95, 30, 6.5, 0.8});
  Check({"catzoc", "A1", Coverage::kP95, 100, 10, 1.5});
  for (const char* const of : {"A2", "B"}) {
    const double thu = of[0] == 'A' ? 20 : 50;
    Check({"catzoc", of, Coverage::kP95, 10, thu, 1.2});
    Check({"catzoc", of, Coverage::kP95, 30, thu, 1.6});
    Check({"catzoc", of, Coverage::kP95, 100, thu, 3});
  }
  Check({"catzoc", "C", Coverage::kP95, 10, 500, 2.5});
  Check({"catzoc", "C", Coverage::kP95, 30, 500, 3.5});
  Check({"catzoc", "C", Coverage::kP95, 100, 500, 7});
}

// NOAA Hydrographic Surveys Specifications and Deliverables: 5 m + 5 % of the depth; S-44 order 1a to 100 m, then 2.
TEST_F(ShippedSpecifications, HaveTheLimitsOfNoaa) {
  Check({"noaa", "to 100 m", Coverage::kP95, 40, 7, std::hypot(0.5, 0.52)});
  Check({"noaa", "below 100 m", Coverage::kP95, 200, 15, std::hypot(1.0, 4.6)});
}

// National Coastal Mapping Strategy 1.0, quality levels of bathymetric lidar: a and b at 95 %.
TEST_F(ShippedSpecifications, HaveTheLimitsOfBathymetricQualityLevels) {
  for (const char* const level : {"QL0B", "QL1B"})
    Check({"usgs", level, Coverage::kP95, 20, kNone, std::hypot(0.25, 0.15)});
  for (const char* const level : {"QL2B", "QL3B"})
    Check({"usgs", level, Coverage::kP95, 20, kNone, std::hypot(0.3, 0.26)});
  Check({"usgs", "QL4B", Coverage::kP95, 20, kNone, std::hypot(0.5, 0.26)});
}

// ASPRS Positional Accuracy Standards, edition 2: a class is its RMSEz.
TEST_F(ShippedSpecifications, HaveTheClassesOfAsprs) {
  Check({"asprs", "5 cm", Coverage::kOneSigma, 20, kNone, 0.05});
  Check({"asprs", "10 cm", Coverage::kOneSigma, 20, kNone, 0.1});
  Check({"asprs", "15 cm", Coverage::kOneSigma, 20, kNone, 0.15});
  Check({"asprs", "20 cm", Coverage::kOneSigma, 20, kNone, 0.2});
  Check({"asprs", "33.3 cm", Coverage::kOneSigma, 20, kNone, 0.333});
}

TEST_F(ShippedSpecifications, NameTheEditionThatWasRead) {
  const auto all = ListSpecifications();
  for (const Specification& each : *all) {
    EXPECT_FALSE(each.edition.empty()) << each.name;
    EXPECT_EQ(each.land, each.name == "asprs") << each.name;
  }
  EXPECT_EQ(FindSpecification("s44")->edition, "6.1.0 (2022)");
}

TEST_F(ShippedSpecifications, AreListedWithS44First) {
  const auto all = ListSpecifications();
  std::vector<std::string> names;
  for (const Specification& each : *all) names.push_back(each.name);
  EXPECT_THAT(names, ::testing::ElementsAre("s44", "asprs", "catzoc", "noaa", "usgs"));
  EXPECT_EQ(FindSpecification("S-44")->name, "s44");
  EXPECT_THAT(FindSpecification("nooa").status().message(), HasSubstr("did you mean noaa?"));
}

std::string ProblemOf(const std::string& text) { return std::string(ParseSpecification(text).status().message()); }

constexpr char kGood[] =
    "title = 'T'\nsource = 'S'\n[[class]]\nname = 'a'\ncoverage = 'p95'\nvertical = {constant = 1}\n";

TEST(Specifications, AreReadFromFilesOfTheUser) {
  const auto read = ParseSpecification(kGood);
  EXPECT_EQ(read->classes.front().vertical->At(30), 1);
  EXPECT_FALSE(read->classes.front().horizontal.has_value());
}

TEST(Specifications, OfLandHaveRootMeanSquareErrors) {
  const std::string land = "edition = '3'\nland = 'rmse'\n", of_class = "[[class]]\nname = 'a'\n";
  const std::string begin = "title = 'T'\nsource = 'S'\n" + land + of_class;
  const auto read = ParseSpecification(begin + "coverage = '1sigma'\nvertical = {constant = 0.1}\n");
  EXPECT_TRUE(read->land);
  EXPECT_EQ(read->edition, "3");
  EXPECT_FALSE(ParseSpecification(kGood)->land);
  EXPECT_TRUE(ParseSpecification(kGood)->edition.empty());
  EXPECT_THAT(ProblemOf(begin + "coverage = 'p95'\nvertical = {constant = 0.1}\n"),
              HasSubstr("give it coverage = \"1sigma\""));
  EXPECT_THAT(ProblemOf(begin + "coverage = '1sigma'\nhorizontal = {constant = 1, of_depth = 0.1, combined = 'sum'}\n"),
              HasSubstr("class a is none of root mean square errors"));
}

TEST(Specifications, SayWhatIsWrongWithThem) {
  EXPECT_THAT(ProblemOf("title = 'T'\n"), HasSubstr("source is missing"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "[[class]]\nname = 'b'\ncoverage = 'p95'\n"), HasSubstr("has no limit"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "[[class]]\nname = 'a'\ncoverage = 'p95'\nvertical = {constant = 1}\n"),
              HasSubstr("another class"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "horizontal = {constant = 1, of_depth = 0.1}\n"),
              HasSubstr("combined is missing"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "horizontal = {of_depth = 0.1, combined = 'sum'}\n"),
              HasSubstr("constant is missing"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "horizontal = {constant = -1}\n"), HasSubstr("constant"));
  EXPECT_THAT(ProblemOf(std::string(kGood) + "vertikal = {constant = 1}\n"),
              AllOf(HasSubstr("'class.vertikal' is no key"), HasSubstr("did you mean vertical?")));
}

TEST_F(ShippedSpecifications, InAFolderOfTheUserNeedTheOrdersOfS44) {
  const albtpu::testing::TemporaryFolder folder;
  std::filesystem::copy_file(std::filesystem::path(SHIPPED_SPECIFICATIONS) / "usgs.toml", folder / "harbour.toml");
  setenv("ALBTPU_SPECIFICATIONS", folder.path().c_str(), 1);
  EXPECT_THAT(std::string(ListSpecifications().status().message()), HasSubstr("has no s44.toml"));
}

}  // namespace
}  // namespace albtpu::quality
