#include "annotate/las/las_beams.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>

#include "tests/formats/las/las_builder.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::LasSpec;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

absl::StatusOr<LasPlace> PlaceOf(const LasSpec& spec, const BeamPlan& plan) {
  const TemporaryFolder folder;
  const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder.Write("in.las", BuildLas(spec)));
  return PlaceOf(*reader, plan);
}

BeamPlan PlanOf(const BeamSource& source) {
  BeamPlan plan;
  plan.source = source;
  return plan;
}

// A point at 80.3 degrees west and 27.1 degrees north, in steps of 1e-7 degrees.
LasSpec InDegrees() {
  LasSpec spec;
  spec.scale = 1e-7;
  spec.points = {{.x = -803000000, .y = 271000000}};
  return spec;
}

TEST(LasPlace, AsksForTheCoordinateSystemOfPointsInDegrees) {
  const absl::StatusOr<LasPlace> unknown = PlaceOf(InDegrees(), PlanOf(TrajectoryFromReturns()));
  ASSERT_FALSE(unknown.ok());
  EXPECT_THAT(unknown.status().message(), HasSubstr("seem to be in degrees"));
  EXPECT_THAT(unknown.status().message(), HasSubstr("--crs"));
  // Nothing is computed from x and y.
  EXPECT_TRUE(PlaceOf(InDegrees(), PlanOf(ConstantIncidence())).ok());
}

TEST(LasPlace, AsksForTheCoordinateSystemOfDegreesAroundWhichSurfaceReturnsCount) {
  BeamPlan plan = PlanOf(ConstantIncidence());
  plan.water_classes = {41};
  const absl::StatusOr<LasPlace> unknown = PlaceOf(InDegrees(), plan);
  EXPECT_THAT(unknown.status().message(), HasSubstr("seem to be in degrees"));
  plan.crs = "EPSG:4326";
  EXPECT_NEAR(PlaceOf(InDegrees(), plan)->frame.metres_per_x, 99167, 2);  // As below.
}

TEST(LasPlace, TakesMetresWhereNoCoordinateSystemIsStated) {
  LasSpec spec;
  spec.points = {{.x = 10000, .y = 20000}};
  const absl::StatusOr<LasPlace> place = PlaceOf(spec, PlanOf(TrajectoryFromReturns()));
  EXPECT_EQ(place->frame.metres_per_x, 1);
  EXPECT_EQ(place->map, nullptr);
}

TEST(LasPlace, MeasuresDegreesInMetres) {
  BeamPlan plan = PlanOf(TrajectoryFromReturns());
  plan.crs = "EPSG:4326";
  const absl::StatusOr<LasPlace> place = PlaceOf(InDegrees(), plan);
  // A degree of the WGS 84 parallel and meridian at 27.1 degrees: 111 412.84 cos p - 93.5 cos 3p = 99 167 m, and
  // 111 132.92 - 559.82 cos 2p + 1.175 cos 4p = 110 805 m, to 1 m.
  EXPECT_NEAR(place->frame.metres_per_x, 99167, 2);
  EXPECT_NEAR(place->frame.metres_per_y, 110805, 2);
}

// The middle of the bounds of the points is on the other side of the earth; so is that of bounds that are wrong.
TEST(LasPlace, LiesAmongPointsOnBothSidesOfTheAntimeridian) {
  LasSpec spec = InDegrees();
  spec.points = {{.x = 1799990000, .y = -168000000, .classification = albtpu::testing::kSurface},
                 {.x = -1799990000, .y = -168000000, .classification = albtpu::testing::kSurface}};
  spec.vlrs = {{"LASF_Projection", 34735, albtpu::testing::GeoKeys({{2048, 4326}})}};
  const std::string right = BuildLas(spec);
  std::string wrong = right;
  const std::array<double, 4> bounds = {20, 5, 5, 1};  // Greatest and least x, greatest and least y.
  std::memcpy(&wrong[179], bounds.data(), sizeof bounds);
  LasAnnotation annotation;
  annotation.plan.source = ConstantIncidence();
  annotation.plan.water_classes = {albtpu::testing::kSurface};
  const TemporaryFolder folder;
  for (const std::string& file : {right, wrong}) {
    const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder.Write("in.las", file));
    const absl::StatusOr<std::unique_ptr<LasBeams>> beams = LasBeams::Find(*reader, annotation);
    ASSERT_TRUE(beams.ok()) << beams.status();
    EXPECT_NEAR(std::abs((*beams)->place().frame.origin_x), 179.999, 1e-9);
  }
}

}  // namespace
}  // namespace albtpu::annotate
