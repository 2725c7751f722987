#include "quality/checkpoints/check_points_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/temporary_folder.h"

namespace albtpu::quality {
namespace {

using ::testing::HasSubstr;

class CheckPointsFile : public ::testing::Test {
 protected:
  absl::StatusOr<CheckPointList> Read(const std::string& text, const CheckPointUnits& units = {},
                                      const GivenSigma& given = {}) {
    return ReadCheckPoints(folder_.Write("points.csv", text), units, given);
  }
  void ExpectRefused(const std::string& text, const std::string& why) {
    const auto points = Read(text);
    ASSERT_FALSE(points.ok()) << text;
    EXPECT_THAT(std::string(points.status().message()), HasSubstr(why));
    EXPECT_THAT(std::string(points.status().message()), HasSubstr("points.csv"));
  }
  albtpu::testing::TemporaryFolder folder_;
};

TEST_F(CheckPointsFile, HasColumnsByNameInAnyOrder) {
  const auto list = Read("Class,Z,Northing,Easting,id\nNVA,1.5,4000,500,A1\nVVA,-2,4001,501,\n");
  ASSERT_TRUE(list.ok()) << list.status();
  ASSERT_EQ(list->points.size(), 2U);
  EXPECT_EQ(list->points[0].id, "A1");
  EXPECT_EQ(list->points[1].id, "line 3");
  EXPECT_EQ(list->points[0].kind, "NVA");
  EXPECT_EQ(list->points[1].x, 501);
  EXPECT_EQ(list->points[1].y, 4001);
  EXPECT_EQ(list->points[1].elevation, -2);
  EXPECT_FALSE(list->vertical_stated);
}

TEST_F(CheckPointsFile, IsReadWithSemicolonsTabsAndDecimalCommas) {
  for (const std::string text : {"x;y;elevation\n1,5;2,25;-3,125\n", "x\ty\televation\n1.5\t2.25\t-3.125\n",
                                 "\xEF\xBB\xBFx,y,elevation\r\n\"1.5\",2.25,-3.125\r\n"}) {
    const auto list = Read(text);
    ASSERT_TRUE(list.ok()) << list.status();
    EXPECT_EQ(list->points.front().x, 1.5);
    EXPECT_EQ(list->points.front().y, 2.25);
    EXPECT_EQ(list->points.front().elevation, -3.125);
  }
}

TEST_F(CheckPointsFile, HasErrorsOfItsOwnBeforeThoseOfAll) {
  const auto list =
      Read("x,y,z,sigma_vertical\n0,0,10,0.1\n0,0,10,\n", {.metres_per_unit = 1, .metres_per_height_unit = 0.3048},
           {.horizontal = 0.02, .vertical = 0.05});
  ASSERT_TRUE(list.ok()) << list.status();
  EXPECT_NEAR(list->points[0].elevation, 3.048, 1e-12);
  EXPECT_NEAR(list->points[0].sigma.vertical, 0.03048, 1e-12);
  EXPECT_EQ(list->points[1].sigma.vertical, 0.05);
  EXPECT_EQ(list->points[1].sigma.horizontal, 0.02);
  EXPECT_TRUE(list->vertical_stated);
  // One point without an error of its own, and none for all.
  EXPECT_FALSE(Read("x,y,z,sigma_vertical\n0,0,10,0.1\n0,0,10,\n")->vertical_stated);
  EXPECT_TRUE(Read("x,y,z,sigma_vertical\n0,0,10,0.1\n0,0,10,0\n")->vertical_stated);
}

TEST_F(CheckPointsFile, SaysWhatIsWrong) {
  ExpectRefused("", "has no header");
  ExpectRefused("x,y,elevation\n", "has no check point");
  ExpectRefused("y,elevation\n1,2\n", "no column 'x' (columns found: y, elevation); name it x or easting or east");
  ExpectRefused("lat,lon,elevation\n1,2,3\n", "have to be projected");
  ExpectRefused("x,y,depth\n1,2,3\n", "an elevation in the datum");
  ExpectRefused("x,easting,y,z\n1,2,3,4\n", "'x' and 'easting' both are 'x'");
  ExpectRefused("x,y,z\n1,2,a\n", "line 2, column 'z': 'a' is no number");
  ExpectRefused("x,y,z\n1,2,\n", "line 2, column 'z': '' is no number");
  ExpectRefused("x,y,z\n1,2,nan\n", "is no number");
  ExpectRefused("x,y,z\n1,2\n", "line 2: has 2 cells, the header 3");
  ExpectRefused("x,y,z,sigma_vertical\n1,2,3,-0.1\n", "is no standard deviation");
}

}  // namespace
}  // namespace albtpu::quality
