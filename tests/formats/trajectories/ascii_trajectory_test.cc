#include "formats/trajectories/ascii_trajectory.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "sea/angle.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::FlightLine;
using albtpu::testing::FlightSpec;
using albtpu::testing::FlightText;
using albtpu::testing::LineOf;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

std::unique_ptr<AsciiTrajectory> Read(const std::string& text) {
  absl::StatusOr<std::unique_ptr<AsciiTrajectory>> trajectory = AsciiTrajectory::Parse("flight.txt", text);
  EXPECT_TRUE(trajectory.ok()) << trajectory.status();
  return *std::move(trajectory);
}

std::string ErrorOf(const std::string& text) {
  return std::string(AsciiTrajectory::Parse("flight.txt", text).status().message());
}

std::string ErrorAfter(std::function<void(FlightLine&)> change) {
  return ErrorOf(FlightText({.change = std::move(change)}));
}

// The text with its line `number`, counted from 1, replaced.
std::string WithLine(const std::string& text, std::size_t number, const std::string& line) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < number; ++i) begin = text.find('\n', begin) + 1;
  return text.substr(0, begin) + line + text.substr(text.find('\n', begin));
}

// Numbers are printed with 10 decimals: off by 0.5e-10 of their unit.
constexpr double kPrinted = 0.6e-10;

void ExpectLine(const AsciiTrajectory& trajectory, std::size_t record, const FlightLine& line) {
  const TrajectoryRecord r = trajectory.Record(record);
  EXPECT_NEAR(r.time, line.time, kPrinted + 1e-10);  // A double of 313200 s is off by 3e-11.
  EXPECT_EQ(r.time, trajectory.TimeAt(record));
  EXPECT_NEAR(r.longitude, RadiansOfDegrees(line.longitude), kPrinted);
  EXPECT_NEAR(r.latitude, RadiansOfDegrees(line.latitude), kPrinted);
  EXPECT_NEAR(r.height, line.height, kPrinted);
  EXPECT_NEAR(r.roll, RadiansOfDegrees(line.roll), kPrinted);
  EXPECT_NEAR(r.pitch, RadiansOfDegrees(line.pitch), kPrinted);
  EXPECT_NEAR(std::remainder(r.heading - RadiansOfDegrees(line.heading), 2 * std::numbers::pi), 0, kPrinted);
  const TrajectorySigma sigma = *trajectory.SigmaAt(record);
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.east), static_cast<float>(line.sigma_x));
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.north), static_cast<float>(line.sigma_y));
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.down), static_cast<float>(line.sigma_z));
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.roll), static_cast<float>(RadiansOfDegrees(line.sigma_roll)));
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.pitch), static_cast<float>(RadiansOfDegrees(line.sigma_pitch)));
  EXPECT_FLOAT_EQ(static_cast<float>(sigma.heading), static_cast<float>(RadiansOfDegrees(line.sigma_heading)));
  EXPECT_NEAR(trajectory.GridPositionAt(record)->x, line.x, 1e-9);  // A double of 540000 is off by 6e-11.
  EXPECT_NEAR(trajectory.GridPositionAt(record)->y, line.y, 1e-9);
}

// What the POS Export Utility writes above its numbers.
constexpr char kExportHeader[] =
    "**********\n POS Export Utility\n Copyright (C) 1997-2018\n**********\n \n Parameter setup:\n"
    " Mission Start Time:\n   Date of Mission: 2018-08-07\n   Start Time: 06:38:26\n"
    " false easting = 500000.000000 m; false northing = 0.000000 m; \n"
    " TIME, DISTANCE, EASTING, NORTHING, ELLIPSOID HEIGHT, LATITUDE, LONGITUDE, ELLIPSOID HEIGHT, ROLL, "
    "PITCH, "
    "HEADING, EAST VELOCITY, NORTH VELOCITY, UP VELOCITY, EAST SD, NORTH SD, HEIGHT SD, ROLL SD, PITCH SD, "
    "HEADING SD\n"
    "\n  (time in Sec, distance in Meters, position in Meters, lat, long in Degrees, orientation angles and "
    "SD in "
    "Degrees, velocity in Meter/Sec, position SD in Meters)  \n\n";

TEST(AsciiTrajectory, ReadsFifteenColumns) {
  const FlightSpec spec;
  const auto trajectory = Read(FlightText(spec));
  ASSERT_EQ(trajectory->size(), spec.lines);
  EXPECT_EQ(trajectory->columns(), 15u);
  EXPECT_EQ(trajectory->name(), "flight.txt");
  for (const std::size_t i : {0, 1, 100, 199}) ExpectLine(*trajectory, i, LineOf(spec, i));
  EXPECT_TRUE(std::isnan(trajectory->Record(0).velocity_north));
}

TEST(AsciiTrajectory, ReadsTwentyColumnsWithTheirVelocities) {
  const FlightSpec spec = {.columns = 20, .header = kExportHeader};
  const auto trajectory = Read(FlightText(spec));
  ASSERT_EQ(trajectory->size(), spec.lines);
  EXPECT_EQ(trajectory->columns(), 20u);
  for (const std::size_t i : {0, 1, 100, 199}) {
    ExpectLine(*trajectory, i, LineOf(spec, i));
    EXPECT_NEAR(trajectory->Record(i).velocity_north, LineOf(spec, i).velocity_north, kPrinted);
    EXPECT_NEAR(trajectory->Record(i).velocity_east, LineOf(spec, i).velocity_east, kPrinted);
    EXPECT_NEAR(trajectory->Record(i).velocity_up, LineOf(spec, i).velocity_up, kPrinted);
  }
}

TEST(AsciiTrajectory, TakesBlanksTabsAndCommas) {
  const std::string plain = FlightText({});
  for (const char* separator : {"\t", ",", ", ", " , ", "   "}) {
    SCOPED_TRACE(separator);
    ExpectLine(*Read(FlightText({.separator = separator})), 7, LineOf({}, 7));
  }
  EXPECT_EQ(Read(absl::StrReplaceAll(plain, {{"\n", "\r\n"}}))->size(), 200u);
  EXPECT_EQ(Read(absl::StrReplaceAll(plain, {{"\n", "\n\n"}}))->size(), 200u);
  EXPECT_EQ(Read("\xEF\xBB\xBF" + plain)->size(), 200u);
  EXPECT_EQ(Read(plain.substr(0, plain.size() - 1))->size(), 200u);
  EXPECT_EQ(Read(absl::StrReplaceAll(plain, {{" 1.5", " +1.5"}}))->size(), 200u);
}

TEST(AsciiTrajectory, TakesDecimalCommas) {
  for (const char* separator : {" ", "\t", ";", " ; "}) {
    SCOPED_TRACE(separator);
    const std::string text = absl::StrReplaceAll(FlightText({.separator = separator}), {{".", ","}});
    ExpectLine(*Read(text), 7, LineOf({}, 7));
  }
  ExpectLine(*Read(FlightText({.separator = ";"})), 7, LineOf({}, 7));
}

TEST(AsciiTrajectory, DoesNotGuessWhatCommasAre) {
  const std::string semicolons = FlightText({.separator = ";"});
  EXPECT_THAT(ErrorOf(WithLine(semicolons, 1, "1,5;-80.6;25;5;6;400;1;2;345;1;1;1;1;1;1")),
              HasSubstr("flight.txt line 1: has both decimal commas and decimal points"));
  // 15 numbers between blanks of which five have commas, or 20 columns.
  EXPECT_THAT(ErrorOf("1,5 2,5 3,5 4,5 5,5 6 7 8 9 1 1 1 1 1 1\n"),
              HasSubstr("line 1: has commas that may separate columns or be decimal marks"));
  const std::string commas = absl::StrReplaceAll(semicolons, {{".", ","}});
  EXPECT_THAT(ErrorOf(WithLine(commas, 5, "1.5;-80,6;25;5;6;400;1;2;345;1;1;1;1;1;1")),
              HasSubstr("flight.txt line 5: has both"));
}

TEST(AsciiTrajectory, SkipsAHeaderThatAgreesWithTheColumns) {
  EXPECT_EQ(
      Read(FlightText({.header = "time lon lat X Y Z roll pitch heading stdX stdY stdZ stdroll stdpitch stdheading\n"}))
          ->size(),
      200u);
  EXPECT_EQ(Read(FlightText({.header = "# a flight\n\n# of May\n"}))->size(), 200u);
}

TEST(AsciiTrajectory, RefusesAHeaderThatContradictsTheColumns) {
  EXPECT_THAT(ErrorOf(FlightText({.header = "time,lat,lon,X,Y,Z,roll,pitch,heading,a,b,c,d,e,f\n"})),
              HasSubstr("flight.txt line 1: the header states column 2 is 'lat', not longitude"));
  const std::string arc_minutes = absl::StrReplaceAll(
      kExportHeader, {{"orientation angles and SD in Degrees", "orientation angles and SD in Rad"}});
  EXPECT_THAT(ErrorOf(FlightText({.columns = 20, .header = arc_minutes})),
              HasSubstr("units other than 'orientation angles and SD in Degrees'"));
  const std::string omega = absl::StrReplaceAll(kExportHeader, {{"ROLL, PITCH", "PITCH, ROLL"}});
  EXPECT_THAT(ErrorOf(FlightText({.columns = 20, .header = omega})), HasSubstr("column 9 is 'pitch', not roll"));
}

TEST(AsciiTrajectory, NamesLineAndColumn) {
  const std::string text = FlightText({.header = "a flight\n"});
  EXPECT_THAT(ErrorOf(WithLine(text, 4, "1 2 3")), HasSubstr("flight.txt line 4: ends after 3 of 15 columns"));
  EXPECT_THAT(ErrorOf(text + "x\n"), HasSubstr("flight.txt line 202, column 1 'time': 'x' is not a finite number"));
  const std::string line = "313200.5 -80.6 25.1 5 6 400 1 2 345 1 1 1 1 1 1";
  const auto with = [&](const char* from, const char* to) {
    return ErrorOf(WithLine(text, 27, absl::StrReplaceAll(line, {{from, to}})));
  };
  EXPECT_THAT(with("400", "4o0"), HasSubstr("line 27, column 6 'Z': '4o0' is not a finite number"));
  EXPECT_THAT(with("400", "nan"), HasSubstr("'nan' is not a finite number"));
  EXPECT_THAT(with("400", "inf"), HasSubstr("'inf' is not a finite number"));
  EXPECT_THAT(with("400", "1e999"), HasSubstr("'1e999' is not a finite number"));
  EXPECT_THAT(with("400", "0x1p3"), HasSubstr("'0x1p3' is not a finite number"));
  EXPECT_THAT(with("400", "99999"), HasSubstr("column 6 'Z': 99999 m is outside -1000 to 30000"));
  EXPECT_THAT(with("25.1", "125.1"), HasSubstr("column 3 'latitude': 125.1 degree is outside -90 to 90; exchange"));
  EXPECT_THAT(with("345 1", "345 -1"), HasSubstr("column 10 'sigma X': -1 m is outside 0 to"));
  EXPECT_THAT(with("400", "400 9"), HasSubstr("line 27: has 16 columns, not 15"));
  EXPECT_THAT(with(" 400", ",,400"), HasSubstr("column 6 'Z': '' is not a finite number"));
  EXPECT_THAT(with("313200.5", "313200.1"),
              HasSubstr("line 27, column 1 'time': 313200.100000 s follows 313200.480000 s: times must increase"));
}

TEST(AsciiTrajectory, RefusesWhatIsNoTrajectory) {
  EXPECT_THAT(ErrorOf(""), HasSubstr("flight.txt: is empty"));
  EXPECT_THAT(ErrorOf("\n\n"), HasSubstr("no line of numbers"));
  EXPECT_THAT(ErrorOf("a\nb\n"), HasSubstr("no line of numbers"));
  EXPECT_THAT(ErrorOf("1 2 3\n"), HasSubstr("line 1: has 3 columns; a trajectory has 15"));
  EXPECT_THAT(ErrorOf(FlightText({.lines = 1})), HasSubstr("has a single record"));
  EXPECT_THAT(ErrorOf(albtpu::testing::SmrmsgBytes(100, 3)), HasSubstr("is not text"));
  std::string prose;
  for (int i = 0; i < 1000; ++i) absl::StrAppend(&prose, "word\n");
  EXPECT_THAT(ErrorOf(prose), HasSubstr("line 201: 'word' is not a number"));
}

TEST(AsciiTrajectory, GoesOnWhereTheWeekEnds) {
  const auto trajectory = Read(FlightText({.start = 604799, .change = [](FlightLine& line) {
                                             if (line.time >= 604800) line.time -= 604800;
                                           }}));
  EXPECT_NEAR(trajectory->TimeAt(199), 604799 + 199 / 50.0, 1e-9);
  for (std::size_t i = 1; i < 200; ++i) EXPECT_GT(trajectory->TimeAt(i), trajectory->TimeAt(i - 1));
}

TEST(AsciiTrajectory, TakesAdjustedGpsTimesBelowZero) {
  EXPECT_NEAR(Read(FlightText({.start = -12345678}))->TimeAt(0), -12345678, 1e-9);
}

TEST(AsciiTrajectory, HasNoGridPositionOrSigmaWhereAllAreZero) {
  const auto trajectory = Read(FlightText({.change = [](FlightLine& line) {
    line.x = line.y = line.sigma_x = line.sigma_y = line.sigma_z = 0;
    line.sigma_roll = line.sigma_pitch = line.sigma_heading = 0;
  }}));
  EXPECT_FALSE(trajectory->GridPositionAt(5).has_value());
  EXPECT_FALSE(trajectory->SigmaAt(5).has_value());
  const auto positions_alone = Read(
      FlightText({.change = [](FlightLine& line) { line.sigma_roll = line.sigma_pitch = line.sigma_heading = 0; }}));
  EXPECT_GT(positions_alone->SigmaAt(5)->north, 0);
  EXPECT_TRUE(std::isnan(positions_alone->SigmaAt(5)->roll));
}

TEST(AsciiTrajectory, DoubtsSigmasThatNoTrajectoryHas) {
  // Of 0.0025 and 0.0026 degrees.
  const auto with_attitude_in = [](double unit) {
    return ErrorAfter([unit](FlightLine& line) {
      for (double* sigma : {&line.sigma_roll, &line.sigma_pitch, &line.sigma_heading}) *sigma *= unit;
    });
  };
  EXPECT_THAT(
      with_attitude_in(std::numbers::pi / 180),
      HasSubstr("flight.txt: column 13 'sigma roll' is at most 4.4e-05 degrees, less than any navigation system "
                "of laser bathymetry has (they may be radians); convert it to degrees"));
  EXPECT_THAT(with_attitude_in(60),
              HasSubstr("column 13 'sigma roll' is at least 0.15 degrees, more than any navigation system of laser "
                        "bathymetry has (they may be arc minutes)"));
  EXPECT_THAT(ErrorAfter([](FlightLine& line) {
                for (double* sigma : {&line.sigma_x, &line.sigma_y, &line.sigma_z}) *sigma *= 1000;
              }),
              HasSubstr("column 11 'sigma Y' is at least 30 m, more than any navigation system of laser bathymetry has "
                        "(they may be millimetres or centimetres); convert it to m"));
  EXPECT_THAT(
      ErrorAfter([](FlightLine& line) { line.sigma_z = 0; }),
      HasSubstr("column 12 'sigma Z' is 0 throughout, which no trajectory has; write what it is, or, if that is "
                "not known, write 0 in all three columns of the position"));
  EXPECT_THAT(ErrorAfter([](FlightLine& line) { line.sigma_heading = 0; }),
              HasSubstr("column 15 'sigma heading' is 0"));
  EXPECT_THAT(ErrorOf(FlightText({.columns = 20, .change = [](FlightLine& line) { line.sigma_pitch = 0; }})),
              HasSubstr("column 19 'pitch SD' is 0"));
}

TEST(AsciiTrajectory, CrossesTheLongitudeOf180Degrees) {
  const auto trajectory = Read(FlightText({.longitude = 179.9999, .course = 90, .change = [](FlightLine& line) {
                                             if (line.longitude > 180) line.longitude -= 360;
                                           }}));
  EXPECT_LT(trajectory->Record(199).longitude, 0);
  EXPECT_NEAR(Read(FlightText({.longitude = 279.4}))->Record(0).longitude, RadiansOfDegrees(-80.6), kPrinted);
}

TEST(AsciiTrajectory, IsReadFromAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ((*AsciiTrajectory::Open(folder.Write("flight.txt", FlightText({}))))->size(), 200u);
  EXPECT_THAT(std::string(AsciiTrajectory::Open(folder / "no").status().message()), HasSubstr("No such file"));
  EXPECT_THAT(std::string(AsciiTrajectory::Open(folder.path()).status().message()), HasSubstr("is a folder"));
}

TEST(AsciiMotion, TakesAFlightInEveryDirection) {
  for (int course = 0; course < 360; course += 5) {
    SCOPED_TRACE(course);
    for (const std::size_t columns : {15, 20})
      Read(FlightText({.latitude = -35, .course = static_cast<double>(course), .speed = 70, .columns = columns}));
  }
}

TEST(AsciiMotion, NamesExchangedLatitudeAndLongitude) {
  // Here both angles can be latitudes. X and Y tell it where the heading does not.
  for (const double course : {0.0, 45.0, 100.0, 225.0, 300.0}) {
    SCOPED_TRACE(course);
    const auto exchange = [](FlightLine& line) { std::swap(line.longitude, line.latitude); };
    EXPECT_THAT(ErrorOf(FlightText({.course = course, .change = exchange})),
                HasSubstr("latitude and longitude are exchanged"));
    EXPECT_THAT(ErrorOf(FlightText({.course = course, .columns = 20, .change = exchange})),
                HasSubstr("latitude and longitude are exchanged"));
  }
}

TEST(AsciiMotion, NamesRadians) {
  EXPECT_THAT(ErrorAfter([](FlightLine& line) {
                line.longitude = RadiansOfDegrees(line.longitude);
                line.latitude = RadiansOfDegrees(line.latitude);
              }),
              HasSubstr("flight.txt: latitude and longitude are in radians; write degrees"));
  EXPECT_THAT(ErrorOf(FlightText(
                  {.course = 200, .change = [](FlightLine& line) { line.heading = RadiansOfDegrees(line.heading); }})),
              HasSubstr("headings are in radians; write degrees"));
}

TEST(AsciiMotion, NamesExchangedXAndY) {
  EXPECT_THAT(ErrorAfter([](FlightLine& line) { std::swap(line.x, line.y); }), HasSubstr("X and Y are exchanged"));
}

TEST(AsciiMotion, NamesAForeignHeading) {
  EXPECT_THAT(ErrorAfter([](FlightLine& line) { line.heading = std::fmod(line.heading + 90, 360); }),
              HasSubstr("heading and course over ground differ by 93 degrees"));
}

TEST(AsciiMotion, NamesAnImpossibleSpeed) {
  EXPECT_THAT(ErrorOf(FlightText({.speed = 0.5})),
              HasSubstr("the positions move with 0.5 m/s (an aircraft flies 3 to 150 m/s)"));
  EXPECT_THAT(ErrorOf(FlightText({.speed = 400})), HasSubstr("the positions move with 400 m/s"));
}

TEST(AsciiMotion, NamesVelocitiesThatDisagree) {
  EXPECT_THAT(ErrorOf(FlightText({.columns = 20, .change = [](FlightLine& line) { line.velocity_east += 2; }})),
              HasSubstr("its velocities differ from differences of its positions by 2.0 m/s rms"));
}

TEST(AsciiMotion, LetsAnAircraftWaitOnTheGround) {
  const auto wait = [](FlightLine& line) {
    if (line.time < 313202) {
      const FlightLine first = LineOf({}, 100);
      line.longitude = first.longitude;
      line.latitude = first.latitude;
    }
  };
  EXPECT_EQ(Read(FlightText({.change = wait}))->size(), 200u);
}

}  // namespace
}  // namespace albtpu::formats
