#include "formats/trajectories/sbet_record.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_files.h"
#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using namespace albtpu::testing;  // Flight, SbetRow and its fields.
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// North, east and down of a row in the wander frame, by the formula of the format.
Eigen::Vector3d VelocityOf(const SbetRow& row) {
  const double a = row[kWander];
  return {row[kVelocityX] * std::cos(a) - row[kVelocityY] * std::sin(a),
          -row[kVelocityX] * std::sin(a) - row[kVelocityY] * std::cos(a), -row[kVelocityZ]};
}

// From the body (forward, right, down) to north, east, down.
Eigen::Matrix3d Attitude(const SbetRow& row, bool level) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const AngleAxisd heading(row[kPlatformHeading] - row[kWander], Vector3d::UnitZ());
  if (level) return heading.toRotationMatrix();
  return (heading * AngleAxisd(row[kPitch], Vector3d::UnitY()) * AngleAxisd(row[kRoll], Vector3d::UnitX()))
      .toRotationMatrix();
}

// How another maker writes the velocities: along the body, or along north.
struct Maker {
  const char* name;
  VelocityFrame frame;
  bool of_body, level;
  double y_sign, z_sign;  // 1: right or east, down.
};
const Maker kMakers[] = {
    {"forward, right, down", VelocityFrame::kForwardRightDown, true, false, 1, 1},
    {"forward, left, up", VelocityFrame::kForwardLeftUp, true, false, -1, -1},
    {"level, forward, right, down", VelocityFrame::kForwardRightDownOfLevel, true, true, 1, 1},
    {"level, forward, left, up", VelocityFrame::kForwardLeftUpOfLevel, true, true, -1, -1},
    {"north, east, down", VelocityFrame::kNorthEastDown, false, false, 1, 1},
    {"north, east, up", VelocityFrame::kNorthEastUp, false, false, 1, -1},
    {"north, west, up", VelocityFrame::kNorthWestUp, false, false, -1, -1},
};

std::vector<SbetRow> WrittenBy(const Maker& maker, const Flight& flight) {
  return Changed(Fly(flight), [&](SbetRow& row) {
    Eigen::Vector3d velocity = VelocityOf(row);
    if (maker.of_body) velocity = Attitude(row, maker.level).transpose() * velocity;
    row[kVelocityX] = velocity.x();
    row[kVelocityY] = maker.y_sign * velocity.y();
    row[kVelocityZ] = maker.z_sign * velocity.z();
  });
}

class VelocityAxesTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::unique_ptr<SbetFile>> Open(const std::vector<SbetRow>& rows,
                                                 VelocityAxes axes = VelocityAxes::kAuto) {
    return SbetFile::Open(folder_.Write(std::to_string(++files_) + ".sbet", SbetBytes(rows)), axes);
  }
  // The velocities of a file are those of the flight. Each is a few products of numbers up to 60.
  void ExpectVelocities(const SbetFile& file, const Flight& flight, double tolerance) {
    const std::vector<SbetRow> rows = Fly(flight);
    for (std::size_t i = 0; i < rows.size(); i += 37) {
      const Eigen::Vector3d expected = VelocityOf(rows[i]);
      const TrajectoryRecord record = file.Record(i);
      ASSERT_NEAR(record.velocity_north, expected.x(), tolerance) << i;
      ASSERT_NEAR(record.velocity_east, expected.y(), tolerance) << i;
      ASSERT_NEAR(record.velocity_up, -expected.z(), tolerance) << i;
    }
  }

  const TemporaryFolder folder_;
  int files_ = 0;
};

const Flight kFlights[] = {{.rate = 50},
                           {.rate = 50, .latitude = -33, .longitude = 151, .course = 200, .crab = 8},
                           {.rate = 5, .course = 110, .crab = -12},
                           {.rate = 50, .latitude = 60, .speed = 4, .course = 310, .weave = 5, .weave_time = 15},
                           {.rate = 50, .course = 75, .wander = 0},
                           {.rate = 50, .course = 250, .roll = 12, .pitch = 6}};

TEST_F(VelocityAxesTest, OfTheBodyAreRecognizedAndTurned) {
  for (const Maker& maker : kMakers) {
    if (!maker.of_body) continue;
    for (const Flight& flight : kFlights) {
      const auto file = Open(WrittenBy(maker, flight));
      ASSERT_TRUE(file.ok()) << maker.name << ": " << file.status();
      EXPECT_EQ((*file)->velocity_frame(), maker.frame) << maker.name << " " << flight.course;
      EXPECT_THAT((*file)->remark(), HasSubstr("its velocities are along the axes of the body")) << maker.name;
      ExpectVelocities(**file, flight, 1e-9);
    }
  }
}

TEST_F(VelocityAxesTest, OfTheFormatStayAsTheyAre) {
  for (const Flight& flight : kFlights) {
    for (const VelocityAxes axes : {VelocityAxes::kAuto, VelocityAxes::kWander}) {
      const auto file = Open(Fly(flight), axes);
      ASSERT_TRUE(file.ok()) << file.status();
      EXPECT_EQ((*file)->velocity_frame(), VelocityFrame::kWander);
      EXPECT_THAT((*file)->remark(), IsEmpty());
      ExpectVelocities(**file, flight, 1e-12 * 60);
    }
  }
}

TEST_F(VelocityAxesTest, AreThoseThatTheUserNames) {
  for (const Maker& maker : kMakers) {
    const Flight flight = {.rate = 50, .course = 110, .crab = 6};
    const auto file = Open(WrittenBy(maker, flight), maker.of_body ? VelocityAxes::kBody : VelocityAxes::kNorth);
    ASSERT_TRUE(file.ok()) << maker.name << ": " << file.status();
    EXPECT_EQ((*file)->velocity_frame(), maker.frame) << maker.name;
    ExpectVelocities(**file, flight, 1e-9);
    // The wrong ones are refused.
    const auto other = Open(WrittenBy(maker, flight), maker.of_body ? VelocityAxes::kNorth : VelocityAxes::kBody);
    EXPECT_THAT(std::string(other.status().message()), HasSubstr("they were taken as along")) << maker.name;
    EXPECT_FALSE(Open(WrittenBy(maker, flight), VelocityAxes::kWander).ok()) << maker.name;
  }
}

TEST_F(VelocityAxesTest, OfAVesselAreRecognizedAtTwoRecordsASecond) {
  // A vessel that turns: 4 m/s, at 2 Hz. The mean of two velocities is right to v'' t^2 / 12 = 4 mm/s.
  const Flight vessel = {
      .duration = 600, .rate = 2, .height = 55, .speed = 4, .weave = 10, .weave_time = 60, .climb = 0.2};
  for (const Maker& maker : kMakers) {
    if (!maker.of_body) continue;
    const auto file = Open(WrittenBy(maker, vessel));
    ASSERT_TRUE(file.ok()) << file.status();
    EXPECT_EQ((*file)->velocity_frame(), maker.frame) << maker.name;
    ExpectVelocities(**file, vessel, 1e-9);
  }
}

TEST_F(VelocityAxesTest, OfZerosAreDerivedFromPositions) {
  for (const Flight& flight : kFlights) {
    const auto file = Open(Changed(Fly(flight), [](SbetRow& row) {
      for (const SbetField field : {kVelocityX, kVelocityY, kVelocityZ}) row[field] = 0;
    }));
    ASSERT_TRUE(file.ok()) << file.status();
    EXPECT_FALSE((*file)->states_velocities());
    EXPECT_THAT((*file)->remark(), HasSubstr("all 0 while its positions move; they were derived from the positions"));
    // Over 0.2 s at 5 Hz, and at the ends of the file to one side over 0.2 s: a t / 2, with the acceleration of the
    // weave, 20 m (2 pi / 30 s)^2, and of the climb, 10 m (2 pi / 20 s)^2, together 1.9 m/s^2.
    ExpectVelocities(**file, flight, flight.rate < 10 ? 0.2 : 0.06);
  }
  // A vessel at rest has them rightly.
  const auto standing = Open(Fly({.speed = 0, .weave = 0, .climb = 0}));
  EXPECT_THAT((*standing)->remark(), IsEmpty());
}

}  // namespace
}  // namespace albtpu::formats
