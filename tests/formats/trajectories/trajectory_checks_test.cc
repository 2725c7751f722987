#include "formats/trajectories/trajectory_checks.h"

#include <gmock/gmock.h>

#include <utility>

#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using namespace albtpu::testing;  // Flight, Fly, SbetRow and its fields.
using ::testing::HasSubstr;

class CheckNearPointsTest : public ::testing::Test {
 protected:
  static std::shared_ptr<const MapFrame> Frame(const std::string& crs) {
    return *MapFrame::Create("in.las", {.user = crs});
  }
  TrajectoryTimeline Timeline(const std::vector<SbetRow>& rows) {
    auto file = SbetFile::Open(folder_.Write("flight.sbet", SbetBytes(rows)));
    EXPECT_TRUE(file.ok()) << file.status();
    return *TrajectoryTimeline::Create({*std::move(file)}, TrajectoryClock::kGps,
                                       {{300010, 300040}, PointTimeForm::kWeekSeconds});
  }
  // The points below a flight, in `crs`.
  static PointExtent Below(const Flight& flight, const std::string& crs) {
    const auto frame = Frame(crs);
    PointExtent extent = {1e300, -1e300, 1e300, -1e300};
    for (double time = 10; time <= 40; time += 1) {
      const SbetRow row = RowAt(flight, time);
      const MapPosition position = frame->Project({row[kLatitude], row[kLongitude]});
      extent.x_min = std::min(extent.x_min, position.x);
      extent.x_max = std::max(extent.x_max, position.x);
      extent.y_min = std::min(extent.y_min, position.y);
      extent.y_max = std::max(extent.y_max, position.y);
    }
    return extent;
  }
  std::string Check(const std::vector<SbetRow>& rows, const std::string& crs, const PointExtent& extent) {
    return std::string(CheckNearPoints("in.las", Timeline(rows), *Frame(crs), extent).message());
  }
  const TemporaryFolder folder_;
};

TEST_F(CheckNearPointsTest, AcceptsTheRightTrajectory) {
  const Flight flight;
  for (const char* crs : {"EPSG:26917", "EPSG:2236", "EPSG:4269", "EPSG:3857"})
    EXPECT_EQ(Check(Fly(flight), crs, Below(flight, crs)), "") << crs;
  // Of the flight from which a file has points at one moment only, the rest may be far away.
  PointExtent extent = Below(flight, "EPSG:26917");
  extent.x_max = extent.x_min;
  EXPECT_EQ(Check(Fly(flight), "EPSG:26917", extent), "");
}

TEST_F(CheckNearPointsTest, NamesAnotherZone) {
  const Flight flight;
  EXPECT_THAT(Check(Fly(flight), "EPSG:26917", Below(flight, "EPSG:26918")),
              HasSubstr("another zone: the points fit a central meridian 6 degrees further east, UTM zone 18"));
  EXPECT_THAT(Check(Fly(flight), "EPSG:26917", Below(flight, "EPSG:26916")),
              HasSubstr("6 degrees further west, UTM zone 16"));
  const Flight fiji = {.latitude = -17, .longitude = 178};
  EXPECT_THAT(Check(Fly(fiji), "EPSG:32760", Below(fiji, "EPSG:32701")),
              HasSubstr("6 degrees further east, UTM zone 1"));
}

TEST_F(CheckNearPointsTest, NamesTheOtherHemisphere) {
  const Flight sydney = {.latitude = -33, .longitude = 151};
  EXPECT_THAT(Check(Fly(sydney), "EPSG:32656", Below(sydney, "EPSG:32756")), HasSubstr("other hemisphere"));
  EXPECT_THAT(Check(Fly(sydney), "EPSG:32756", Below(sydney, "EPSG:32656")), HasSubstr("other hemisphere"));
}

TEST_F(CheckNearPointsTest, NamesExchangedCoordinates) {
  // At 45 degrees of both, the exchange changes velocities by less than 1 m/s. Only the place tells.
  const Flight flight = {.latitude = 45.2, .longitude = 44.9, .course = 45};
  const Flight exchanged = {.latitude = 44.9, .longitude = 45.2, .course = 45};
  EXPECT_THAT(Check(Fly(exchanged), "EPSG:32638", Below(flight, "EPSG:32638")),
              HasSubstr("latitude and longitude of the trajectory are exchanged"));
  PointExtent extent = Below(Flight(), "EPSG:26917");
  std::swap(extent.x_min, extent.y_min);
  std::swap(extent.x_max, extent.y_max);
  EXPECT_THAT(Check(Fly(Flight()), "EPSG:26917", extent), HasSubstr("x and y of the points are exchanged"));
}

TEST_F(CheckNearPointsTest, NamesWrongSigns) {
  const Flight flight;
  EXPECT_THAT(Check(Fly({.longitude = 81.8}), "EPSG:4269", Below(flight, "EPSG:4269")),
              HasSubstr("longitude of the trajectory has the wrong sign"));
  EXPECT_THAT(Check(Fly({.latitude = -26}), "EPSG:26917", Below(flight, "EPSG:26917")),
              HasSubstr("latitude of the trajectory has the wrong sign"));
}

TEST_F(CheckNearPointsTest, NamesFeet) {
  const Flight flight = {.longitude = -80.4};
  EXPECT_THAT(Check(Fly(flight), "EPSG:26958", Below(flight, "EPSG:2236")), HasSubstr("the points are in feet"));
  EXPECT_THAT(Check(Fly(flight), "EPSG:2236", Below(flight, "EPSG:26958")), HasSubstr("the points are in metres"));
}

TEST_F(CheckNearPointsTest, SaysHowFarAnotherFlightIs) {
  const Flight flight;
  // A tenth of a degree of latitude is 11.08 km here; the course of 30 degrees brings both boxes nearer by its length
  // to the north, 30 s x 60 m/s x cos(30 degrees) = 1.6 km.
  const std::string message = Check(Fly({.latitude = 26.1}), "EPSG:26917", Below(flight, "EPSG:26917"));
  EXPECT_THAT(message, HasSubstr("in.las: at the times of its points the trajectory is 9.5 km or more away"));
  EXPECT_THAT(message, HasSubstr("another flight"));
}

}  // namespace
}  // namespace albtpu::formats
