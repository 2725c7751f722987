#include "formats/trajectories/sbet_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "formats/trajectories/ascii_motion.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using namespace albtpu::testing;  // SbetRow and its fields.
using ::testing::HasSubstr;

class SbetFileTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::unique_ptr<SbetFile>> Open(const std::string& bytes) {
    return SbetFile::Open(folder_.Write(std::to_string(++files_) + ".sbet", bytes));
  }
  absl::StatusOr<std::unique_ptr<SbetFile>> Open(const std::vector<SbetRow>& rows) { return Open(SbetBytes(rows)); }
  std::string Refusal(const std::string& bytes) { return std::string(Open(bytes).status().message()); }
  std::string Refusal(const std::vector<SbetRow>& rows) { return Refusal(SbetBytes(rows)); }
  std::string RefusalOf(const std::function<void(SbetRow&)>& mistake) {
    return Refusal(Changed(Fly(Flight()), mistake));
  }

  const TemporaryFolder folder_;
  int files_ = 0;  // A mapped file must not be overwritten.
};

TEST_F(SbetFileTest, GivesPositionVelocityAndTrueHeading) {
  const auto file = Open(Fly({.course = 90, .weave = 0, .climb = 0}));
  EXPECT_EQ((*file)->size(), 12001);
  const TrajectoryRecord record = (*file)->Record(0);
  EXPECT_EQ(record.time, 300000);
  EXPECT_EQ((*file)->TimeAt(200), 300001);
  EXPECT_DOUBLE_EQ(record.latitude, 26 * kDegree);
  EXPECT_DOUBLE_EQ(record.longitude, -81.8 * kDegree);
  EXPECT_EQ(record.height, 400);
  // Products of numbers up to 60, rounded a few times; 60 m/s hold at the ellipsoid, and 400 m above it are 6e-5 more.
  EXPECT_NEAR(record.velocity_north, 0, 1e-12);
  EXPECT_NEAR(record.velocity_east, 60 * (1 + 400 / 6.38e6), 1e-4);
  EXPECT_EQ(record.velocity_up, 0);
  EXPECT_NEAR(record.heading, 90 * kDegree, 1e-15);
  EXPECT_EQ((*file)->records()[7].rate_z, 0.01 * 16);
}

TEST_F(SbetFileTest, StatesVelocitiesThatAgreeWithPositions) {
  const auto file = Open(Fly(Flight()));
  ASSERT_TRUE(file.ok()) << file.status();
  // Over 0.1 s the mean of two velocities differs from that of the positions by v'' t^2 / 12; v'' of the weave is
  // 20 m (2 pi / 30 s)^3 = 0.18 m/s^3 and of the climb 10 m (2 pi / 20 s)^3 = 0.31 m/s^3.
  EXPECT_LT(VelocityDifference(**file).value(), 0.36 * 0.1 * 0.1 / 12 + 1e-6);
}

TEST_F(SbetFileTest, AcceptsTheEndOfTheWeek) {
  const std::vector<SbetRow> beyond = Fly({.start = 604770});
  const auto restarted = Open(Changed(beyond, [](SbetRow& row) { row[kTime] -= row[kTime] >= 604800 ? 604800 : 0; }));
  const auto continued = Open(beyond);
  for (const std::size_t i : {0, 5999, 6000, 6001, 12000}) {
    EXPECT_DOUBLE_EQ((*restarted)->TimeAt(i), (*continued)->TimeAt(i)) << i;
    EXPECT_DOUBLE_EQ((*restarted)->Record(i).time, (*continued)->Record(i).time) << i;
  }
}

TEST_F(SbetFileTest, AcceptsFlightsOfEveryKind) {
  const std::vector<std::pair<const char*, Flight>> flights = {
      {"southern", {.latitude = -33, .longitude = 151}},
      {"high latitude", {.latitude = 78, .longitude = 15}},
      {"across 180 degrees", {.latitude = -17, .longitude = 179.999, .course = 90}},
      {"standing", {.speed = 0, .weave = 0, .climb = 0}},
      {"5 Hz", {.rate = 5}},
      {"1 Hz", {.rate = 1}},
      {"two records", {.duration = 0.005}},
      {"in a cross wind", {.crab = 14, .wander = 0}},
      {"mounted sideways", {.crab = 90}},
      {"mounted backwards", {.crab = 180}},
      {"level", {.climb = 0}},
  };
  for (const auto& [name, flight] : flights) {
    const auto file = Open(Fly(flight));
    EXPECT_TRUE(file.ok()) << name << ": " << file.status();
  }
  // Longitudes from 0 to 360 degrees.
  EXPECT_TRUE(Open(Changed(Fly(Flight()), [](SbetRow& row) { row[kLongitude] += 2 * std::numbers::pi; })).ok());
  // Crab of 17 degrees on the way out and of -17 degrees on the way back.
  std::vector<SbetRow> rows = Fly({.course = 0, .crab = 17});
  for (const SbetRow& row : Fly({.start = 300100, .course = 180, .crab = -17})) rows.push_back(row);
  EXPECT_TRUE(Open(rows).ok());
}

TEST_F(SbetFileTest, ToleratesAJumpBetweenTwoSolutions) {
  std::vector<SbetRow> rows = Fly(Flight());
  for (std::size_t i = rows.size() / 2; i < rows.size(); ++i) rows[i][kHeight] += 5;
  EXPECT_TRUE(Open(rows).ok());
}

TEST_F(SbetFileTest, RefusesRecordsThatJumpFartherThanAnAircraftFlies) {
  const std::vector<SbetRow> sound = Fly(Flight());
  for (const auto& [field, jump] : {std::pair(kHeight, 50.0), {kLatitude, 1e-5}, {kLongitude, -1e-4}}) {
    std::vector<SbetRow> rows = sound;
    rows[rows.size() / 2][field] += jump;
    EXPECT_THAT(Refusal(rows), HasSubstr(absl::StrCat("record ", rows.size() / 2 + 1, " of ", rows.size())));
    EXPECT_THAT(Refusal(rows), HasSubstr("farther than an aircraft flies"));
  }
}

TEST_F(SbetFileTest, RefusesDamagedFiles) {
  const std::vector<SbetRow> rows = Fly({.duration = 1});
  EXPECT_THAT(Refusal(""), HasSubstr("has 0 records, but a trajectory needs 2 or more"));
  EXPECT_THAT(Refusal(SbetBytes({rows[0]})), HasSubstr("has 1 record, but"));
  EXPECT_THAT(Refusal(SbetBytes(rows).substr(0, 1000)), HasSubstr("1000 bytes, which is not a multiple of 136"));
  EXPECT_THAT(Refusal(std::string(3 * 80, '\1')), HasSubstr("its size fits an SMRMSG"));
  EXPECT_FALSE(SbetFile::Open(folder_ / "absent").ok());
  EXPECT_FALSE(SbetFile::Open(folder_.path()).ok());
  for (int field = 0; field < kSbetFields; ++field) {
    for (const double number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      std::vector<SbetRow> damaged = rows;
      damaged[100][static_cast<std::size_t>(field)] = number;
      EXPECT_THAT(Refusal(damaged), HasSubstr("record 101 of 201 has a number that is not finite")) << field;
    }
  }
  const auto with = [&](SbetField field, double number) {
    std::vector<SbetRow> damaged = rows;
    damaged[100][field] = number;
    return Refusal(damaged);
  };
  EXPECT_THAT(with(kTime, -1), HasSubstr("negative"));
  EXPECT_THAT(with(kLatitude, 1.6), HasSubstr("latitude 1.6 rad, beyond pi/2"));
  EXPECT_THAT(with(kLongitude, -7), HasSubstr("longitude -7 rad, beyond 2 pi"));
  EXPECT_THAT(with(kHeight, 1e6), HasSubstr("height 1e+06 m"));
  EXPECT_THAT(with(kRoll, 2), HasSubstr("roll"));
  EXPECT_THAT(with(kPitch, -2), HasSubstr("pitch"));
  EXPECT_THAT(with(kTime, 300000), HasSubstr("record 101 of 201 is at 300000.000000 s, not after the one before"));
  std::vector<SbetRow> disordered = rows;
  std::swap(disordered[50], disordered[51]);
  EXPECT_THAT(Refusal(disordered), HasSubstr("times must increase"));
  EXPECT_THAT(Refusal(std::string(136 * 5000, '\0')), HasSubstr("times must increase"));
}

TEST_F(SbetFileTest, NamesTheWrongByteOrder) {
  std::string bytes = SbetBytes(Fly(Flight()));
  for (std::size_t i = 0; i < bytes.size(); i += 8) std::reverse(bytes.begin() + i, bytes.begin() + i + 8);
  EXPECT_THAT(Refusal(bytes), HasSubstr("big-endian"));
}

TEST_F(SbetFileTest, NamesDegreesForRadians) {
  const auto in_degrees = [](SbetRow& row) {
    row[kLatitude] /= kDegree;
    row[kLongitude] /= kDegree;
  };
  EXPECT_THAT(RefusalOf(in_degrees), HasSubstr("latitude and longitude are in degrees"));
  // Within a degree of the origin the numbers could be radians; the velocities tell.
  EXPECT_THAT(Refusal(Changed(Fly({.latitude = 0.5, .longitude = 0.7}), in_degrees)),
              HasSubstr("latitude and longitude are in degrees"));
  EXPECT_THAT(RefusalOf([&](SbetRow& row) {
                in_degrees(row);
                for (const int angle : {kRoll, kPitch, kPlatformHeading, kWander}) row[angle] /= kDegree;
              }),
              HasSubstr("its angles are in degrees"));
}

TEST_F(SbetFileTest, NamesExchangedCoordinates) {
  const auto exchange = [](SbetRow& row) { std::swap(row[kLatitude], row[kLongitude]); };
  EXPECT_THAT(RefusalOf(exchange), HasSubstr("latitude and longitude are exchanged"));
  EXPECT_THAT(Refusal(Changed(Fly({.latitude = -33, .longitude = 151}), exchange)),
              HasSubstr("latitude and longitude are exchanged"));
}

TEST_F(SbetFileTest, NamesAWanderAngleThatWasLost) {
  EXPECT_THAT(RefusalOf([](SbetRow& row) { row[kWander] = 0; }), HasSubstr("turned by -20.0 degrees"));
  EXPECT_THAT(RefusalOf([](SbetRow& row) { row[kWander] = -row[kWander]; }), HasSubstr("wrong sign"));
  EXPECT_THAT(RefusalOf([](SbetRow& row) { row[kWander] /= kDegree; }), HasSubstr("wander angle is in degrees"));
  EXPECT_THAT(Refusal(Changed(Fly({.wander = 0}), [](SbetRow& row) { row[kWander] = 20 * kDegree; })),
              HasSubstr("along north and west already"));
}

TEST_F(SbetFileTest, NamesAHeadingWithoutItsWander) {
  const auto without = [](SbetRow& row) { row[kPlatformHeading] -= row[kWander]; };
  EXPECT_THAT(RefusalOf(without), HasSubstr("wander angle, 20.0 degrees, was applied twice or not at all"));
  std::vector<SbetRow> rows = Fly({.course = 0, .crab = 12});
  for (const SbetRow& row : Fly({.start = 300100, .course = 180, .crab = -12})) rows.push_back(row);
  EXPECT_TRUE(Open(rows).ok());
  EXPECT_THAT(Refusal(Changed(rows, without)), HasSubstr("on opposite courses, which wind does not do"));
}

TEST_F(SbetFileTest, NamesFeet) {
  EXPECT_THAT(RefusalOf([](SbetRow& row) { row[kHeight] /= 0.3048; }), HasSubstr("heights are in feet"));
  EXPECT_THAT(RefusalOf([](SbetRow& row) {
                for (const SbetField field : {kVelocityX, kVelocityY, kVelocityZ}) row[field] /= 0.3048;
              }),
              HasSubstr("feet per second"));
}

TEST_F(SbetFileTest, NamesVerticalVelocitiesOfTheWrongSign) {
  const auto turn = [](SbetRow& row) { row[kVelocityZ] = -row[kVelocityZ]; };
  EXPECT_THAT(RefusalOf(turn), HasSubstr("m/s (its vertical velocities are positive downwards); give"));
  // Climbs of 0.3 m in 20 s, at 0.07 m/s rms, are far below the limit of differences.
  EXPECT_THAT(Refusal(Changed(Fly({.climb = 0.3}), turn)),
              HasSubstr("its vertical velocities are positive downwards:"));
  EXPECT_TRUE(Open(Changed(Fly({.climb = 0}), turn)).ok());
}

TEST_F(SbetFileTest, NamesTheOrderOfVelocities) {
  const Flight straight = {.wander = 0};
  EXPECT_THAT(Refusal(Changed(Fly(straight),
                              [](SbetRow& row) {
                                row[kVelocityY] = -row[kVelocityY];
                                row[kVelocityZ] = -row[kVelocityZ];
                              })),
              HasSubstr("in the order north, east, down"));
}

TEST_F(SbetFileTest, SaysHowMuchDisagreesWhereNoCauseIsKnown) {
  EXPECT_THAT(RefusalOf([](SbetRow& row) { row[kVelocityX] = 7 * row[kVelocityZ]; }),
              HasSubstr("no exchange of fields or units and no wander angle explains it"));
}

constexpr double kArcMinute = std::numbers::pi / 10800;

std::string ErrorOfSmrmsg(const std::string& bytes) {
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
  EXPECT_THAT(ErrorOfSmrmsg(SmrmsgBytes(604798, 2) + SmrmsgBytes(0, 3) + SmrmsgBytes(0, 1)),
              HasSubstr("times must increase"));
}

TEST(Smrmsg, RefusesWhatIsNoSmrmsg) {
  EXPECT_THAT(ErrorOfSmrmsg(""), HasSubstr("errors.out: is empty"));
  EXPECT_THAT(ErrorOfSmrmsg(SmrmsgBytes(100, 3).substr(0, 3 * 80 - 1)),
              HasSubstr("239 bytes are not a multiple of 80"));
  EXPECT_THAT(ErrorOfSmrmsg(std::string(3 * 136, '\1')), HasSubstr("its size fits an SBET"));
  EXPECT_THAT(ErrorOfSmrmsg(SmrmsgBytes(100, 3) + SmrmsgBytes(101, 1)),
              HasSubstr("record 4: time 101.000000 s follows 102.000000 s: times must increase"));
  EXPECT_THAT(ErrorOfSmrmsg(SmrmsgBytes(100, 1) + SmrmsgBytes(100, 1)), HasSubstr("record 2"));
  EXPECT_THAT(ErrorOfSmrmsg(SmrmsgBytes(100, 1) + Bytes({101, 1, 1, NAN, 1, 1, 1, 1, 1, 1})),
              HasSubstr("record 2, sigma down: not a finite number"));
  EXPECT_THAT(ErrorOfSmrmsg(Bytes({101, 1, 1, 1, 1, -0.1, 1, 1, 1, 1})),
              HasSubstr("record 1, sigma of the velocity east: -0.1 m/s is negative"));
  EXPECT_THAT(ErrorOfSmrmsg(Bytes({101, 1, 1, 1, 1, 1, 1, 1, 1, 20000})),
              HasSubstr("record 1, sigma of heading: 20000 arc-minutes is implausibly large"));
  EXPECT_THAT(ErrorOfSmrmsg(std::string(160, 'x')), HasSubstr("give an SMRMSG"));
}

TEST(Smrmsg, DoubtsErrorsThatNoTrajectoryHas) {
  EXPECT_THAT(
      ErrorOfSmrmsg(Bytes({100, .02, .02, .05, .01, .01, .01, .005, .005, .02})),
      HasSubstr("errors.out: sigma of roll is at most 0.005 arc minutes, less than any navigation system of laser "
                "bathymetry has (they may be degrees); convert it to arc minutes, or, if it is not known, "
                "leave the file out"));
  EXPECT_THAT(ErrorOfSmrmsg(Bytes({100, .02, .02, .05, .01, .01, .01, 9, 9, 18})),
              HasSubstr("at least 9 arc minutes, more than any navigation system of laser bathymetry has (they may be "
                        "arc seconds)"));
  EXPECT_THAT(
      ErrorOfSmrmsg(Bytes({100, .02, .02, 50, .01, .01, .01, .2, .2, .3})),
      HasSubstr("sigma down is at least 50 m, more than any navigation system of laser bathymetry has (they may "
                "be millimetres or centimetres)"));
  EXPECT_THAT(ErrorOfSmrmsg(Bytes({100, 0, 0, 0, 0, 0, 0, 0, 0, 0})),
              HasSubstr("sigma north is 0 throughout, which no trajectory has"));
  EXPECT_THAT(ErrorOfSmrmsg(Bytes({100, .02, .02, .05, 0, 0, 0, 0, 0, .5})),
              HasSubstr("sigma of roll is 0 throughout"));
  // One record without errors is no such file, nor are velocities without.
  EXPECT_TRUE(SmrmsgFile::Parse("errors.out",
                                Bytes({100, 0, 0, 0, 0, 0, 0, 0, 0, 0, 101, .02, .02, .05, 0, 0, 0, .15, .15, .3}))
                  .ok());
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
