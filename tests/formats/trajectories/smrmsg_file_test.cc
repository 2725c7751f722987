#include <gmock/gmock.h>

#include <limits>
#include <numbers>
#include <string>

#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_text.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::Bytes;
using albtpu::testing::SmrmsgBytes;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

constexpr double kArcMinute = std::numbers::pi / 10800;

std::string ErrorOf(const std::string& bytes) {
  return std::string(SmrmsgFile::Parse("errors.out", bytes).status().message());
}

TEST(Smrmsg, StatesMetresAndArcMinutes) {
  const std::string bytes = Bytes({7, 0.01, 0.02, 0.03, 0.1, 0.2, 0.3, 0.5, 1, 6});
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("errors.out", bytes);
  EXPECT_EQ(file->size(), 1u);
  EXPECT_EQ(file->TimeAt(0), 7);
  const TrajectorySigma sigma = file->SigmaOf(0);
  EXPECT_EQ(sigma.north, 0.01);
  EXPECT_EQ(sigma.east, 0.02);
  EXPECT_EQ(sigma.down, 0.03);
  EXPECT_EQ(sigma.velocity_north, 0.1);
  EXPECT_EQ(sigma.velocity_east, 0.2);
  EXPECT_EQ(sigma.velocity_down, 0.3);
  // One rounding of the constant and one of the product.
  EXPECT_DOUBLE_EQ(sigma.roll, 0.5 * kArcMinute);
  EXPECT_DOUBLE_EQ(sigma.pitch, kArcMinute);
  EXPECT_DOUBLE_EQ(sigma.heading, 0.1 * std::numbers::pi / 180);
}

TEST(Smrmsg, BlendsBetweenRecords) {
  const std::string bytes = SmrmsgBytes(100, 3);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("errors.out", bytes);
  EXPECT_EQ(file->SigmaAt(101)->north, 0.02 * 1.1);
  EXPECT_DOUBLE_EQ(file->SigmaAt(100.25)->north, 0.02 * 1.025);
  EXPECT_DOUBLE_EQ(file->SigmaAt(101.5)->heading, 0.10 * 1.15 * kArcMinute);
  EXPECT_DOUBLE_EQ(file->SigmaAt(101.5)->velocity_down, 0.07 * 1.15);
}

TEST(Smrmsg, HasNoSigmaOutsideOfItsTimes) {
  const std::string bytes = SmrmsgBytes(100, 3);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("errors.out", bytes);
  EXPECT_TRUE(file->SigmaAt(100).has_value());
  EXPECT_TRUE(file->SigmaAt(102).has_value());
  EXPECT_FALSE(file->SigmaAt(99.999).has_value());
  EXPECT_FALSE(file->SigmaAt(102.001).has_value());
  EXPECT_FALSE(file->SigmaAt(std::numeric_limits<double>::quiet_NaN()).has_value());
}

TEST(Smrmsg, HasNoSigmaInAGap) {
  const std::string bytes = SmrmsgBytes(100, 2) + SmrmsgBytes(101 + SmrmsgFile::kLongestGap + 0.5, 2);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("errors.out", bytes);
  EXPECT_TRUE(file->SigmaAt(101).has_value());
  EXPECT_FALSE(file->SigmaAt(105).has_value());
  EXPECT_TRUE(file->SigmaAt(111.5).has_value());
}

TEST(Smrmsg, GoesOnWhereTheWeekEnds) {
  const std::string bytes = SmrmsgBytes(604798, 2) + SmrmsgBytes(0, 3);
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Parse("errors.out", bytes);
  EXPECT_EQ(file->TimeAt(4), 604802);
  EXPECT_TRUE(file->SigmaAt(604799.5).has_value());
  EXPECT_THAT(ErrorOf(SmrmsgBytes(604798, 2) + SmrmsgBytes(0, 3) + SmrmsgBytes(0, 1)),
              HasSubstr("times must increase"));
}

TEST(Smrmsg, RefusesWhatIsNoSmrmsg) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("errors.out: is empty"));
  EXPECT_THAT(ErrorOf(SmrmsgBytes(100, 3).substr(0, 3 * 80 - 1)), HasSubstr("239 bytes are not a multiple of 80"));
  EXPECT_THAT(ErrorOf(std::string(3 * 136, '\1')), HasSubstr("its size fits an SBET"));
  EXPECT_THAT(ErrorOf(SmrmsgBytes(100, 3) + SmrmsgBytes(101, 1)),
              HasSubstr("record 4: time 101.000000 s follows 102.000000 s: times must increase"));
  EXPECT_THAT(ErrorOf(SmrmsgBytes(100, 1) + SmrmsgBytes(100, 1)), HasSubstr("record 2"));
  EXPECT_THAT(ErrorOf(SmrmsgBytes(100, 1) + Bytes({101, 1, 1, NAN, 1, 1, 1, 1, 1, 1})),
              HasSubstr("record 2, sigma down: not a finite number"));
  EXPECT_THAT(ErrorOf(Bytes({101, 1, 1, 1, 1, -0.1, 1, 1, 1, 1})),
              HasSubstr("record 1, sigma of the velocity east: -0.1 m/s is negative"));
  EXPECT_THAT(ErrorOf(Bytes({101, 1, 1, 1, 1, 1, 1, 1, 1, 20000})),
              HasSubstr("record 1, sigma of heading: 20000 arc-minutes is implausibly large"));
  EXPECT_THAT(ErrorOf(std::string(160, 'x')), HasSubstr("give an SMRMSG"));
}

TEST(Smrmsg, IsReadFromAFile) {
  const TemporaryFolder folder;
  const absl::StatusOr<SmrmsgFile> file = SmrmsgFile::Open(folder.Write("errors.out", SmrmsgBytes(100, 3)));
  EXPECT_EQ(file->SigmaAt(101)->north, 0.02 * 1.1);
  EXPECT_THAT(std::string(SmrmsgFile::Open(folder / "no").status().message()), HasSubstr("No such file"));
  EXPECT_THAT(std::string(SmrmsgFile::Open(folder.path()).status().message()),
              HasSubstr("is a folder; give an SMRMSG"));
  EXPECT_THAT(std::string(SmrmsgFile::Open(folder.Write("empty", "")).status().message()), HasSubstr("is empty"));
}

TEST(Smrmsg, IsToldFromOtherFormats) {
  EXPECT_TRUE(SmrmsgFile::Recognizes(SmrmsgBytes(100, 30)));
  EXPECT_TRUE(SmrmsgFile::Recognizes(SmrmsgBytes(100, 30).substr(0, 30 * 80 - 11)));  // To report that it is cut short.
  EXPECT_FALSE(SmrmsgFile::Recognizes(std::string(800, '1')));
  std::string sbet;
  for (int i = 0; i < 20; ++i)
    sbet += Bytes({100 + i / 200.0, 0.43, -1.4, 400, 50, 1, 0, 0.01, 0.01, 1, 0.2, 0, 0, 0, 0, 0, 0});
  EXPECT_FALSE(SmrmsgFile::Recognizes(sbet));
}

}  // namespace
}  // namespace albtpu::formats
