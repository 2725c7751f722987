// Check points of simulated surveys over waves that travel: are differences as large as predicted, is an offset found?
//
// Points of one survey share its datum, and those of a line its trajectory, so that a survey tells little, however many
// check points it has: z^2 of some 10 independent points. Many surveys tell it. ALBTPU_EVERY_CASE=1 makes 1000 of each
// kind.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "quality/checkpoints/point_check.h"
#include "quality/crosscheck/pulse_part.h"
#include "quality/surface/cell_plane.h"
#include "tests/every_case.h"
#include "tests/quality/surface/simulated_place.h"

namespace albtpu::quality {
namespace {

using Eigen::Vector2d;

using albtpu::testing::EveryCase;

struct SurveyCase {
  std::string name;
  ScanPattern pattern;
  int surveys;  // Of a quick run; 0: none.
  double radius = kDefaultRadius;
  // Of lines, survey and check points. Without them, waves are nearly all that is left.
  double shared = 1;

  friend std::ostream& operator<<(std::ostream& out, const SurveyCase& c) { return out << c.name; }
};

struct CheckOfSurvey {
  DifferenceStatistics as_it_is, without_offset, with_offset;  // The last two: of the survey, none and 0.1 m.
  double variance = 0;   // Of a difference, the mean, without what the survey shares, m^2.
  double offset = 0;     // That was drawn of the survey, m.
  double by_passes = 0;  // What passes of a line share by theory, over the variances of differences: the mean.
};

// Ten places, two of them on each pair of lines, with four check points each.
class Surveys {
 public:
  explicit Surveys(const SurveyCase& c)
      : radius_(c.radius),
        shared_(c.shared),
        place_({{.pattern = c.pattern, .number = 1, .heading = 30, .aside = 60, .start = 0},
                {.pattern = c.pattern,
                 .number = 2,
                 .heading = 210,
                 .aside = c.pattern == ScanPattern::kRaster ? 3.0 : 90.0,
                 .start = 600}},
               1, {SideOfCircle(c.radius)}, c.shared) {}

  CheckOfSurvey operator()(std::uint64_t seed) const {
    constexpr int kPlaces = 10, kPlacesOfLine = 2;
    constexpr double kBetween = 1000;  // m
    const std::uint64_t first = seed * (2 * kPlaces);
    std::mt19937_64 random(first + 2 * kPlaces - 1);
    const Eigen::Vector3d of_survey = place_.DrawShared(first).survey;
    std::vector<CheckPoint> points;
    std::vector<PointsAround> around;
    for (int i = 0; i < kPlaces; ++i) {
      const int pair = i / kPlacesOfLine;
      SharedErrors errors = place_.DrawShared(first + kPlaces + static_cast<std::uint64_t>(pair));
      errors.survey = of_survey;
      const std::vector<Vector2d> places = DrawPlaces(random);
      DrawnSurvey drawn = place_.Survey(first + static_cast<std::uint64_t>(i), places);
      errors.AddTo(drawn.points);
      for (const Vector2d& at : places) {
        CheckPoint& point = points.emplace_back(Measured(at, random));
        std::vector<SurfacePoint>& wet = around.emplace_back().wet;
        for (SurfacePoint each : drawn.points) {
          if (std::hypot(each.x - point.x, each.y - point.y) > radius_) continue;
          each.x += i * kBetween;
          each.flight_line = static_cast<std::uint16_t>(each.flight_line + 2 * pair);
          wet.push_back(each);
        }
        point.x += i * kBetween;
      }
    }
    const std::vector<SurfaceAtPoint> surfaces =
        SurfacesOf(points, around, radius_, 1, place_.SourcesFor(SideOfCircle(radius_)));
    CheckOfSurvey check = Checked(DifferencesOf(surfaces, points), SimulatedPlace::Upward().dot(of_survey));
    // Of waves alone. In the order of SurfacePoint::Order, in which the surfaces put them.
    for (const SurfaceAtPoint& each : surfaces)
      if (shared_ == 0 && seed <= kSurveysWithPasses)
        check.by_passes += of_passes_.VarianceOf(around[each.point].wet) / each.node.variance.total() /
                           static_cast<double>(surfaces.size());
    return check;
  }

  static constexpr std::uint64_t kSurveysWithPasses = 4;

 private:
  static constexpr double kVertical = 0.02, kHorizontal = 0.03;  // m, one sigma of check points; radial.

  // In the quarters of a place, further apart than they reach.
  static std::vector<Vector2d> DrawPlaces(std::mt19937_64& random) {
    std::uniform_real_distribution<double> aside(-2, 2);
    std::vector<Vector2d> places;
    for (const double x : {-5.5, 5.5})
      for (const double y : {-5.5, 5.5}) {
        const double dx = aside(random), dy = aside(random);
        places.push_back(Vector2d::Constant(SimulatedPlace::kWest + SimulatedPlace::kWidth / 2) +
                         Vector2d(x + dx, y + dy));
      }
    return places;
  }

  CheckPoint Measured(const Vector2d& at, std::mt19937_64& random) const {
    const PointSigma sigma = {.horizontal = shared_ * kHorizontal, .vertical = shared_ * kVertical};
    std::normal_distribution<double> normal;
    const double dx = normal(random), dy = normal(random), dz = normal(random);
    const double along = sigma.horizontal / std::numbers::sqrt2;  // Of each axis.
    return {.id = {},
            .kind = {},
            .x = at.x() + along * dx,
            .y = at.y() + along * dy,
            .elevation = SimulatedPlace::HeightAt(at) + sigma.vertical * dz,
            .sigma = sigma};
  }

  static CheckOfSurvey Checked(std::vector<Difference> differences, double offset) {
    std::vector<std::size_t> all(differences.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    CheckOfSurvey check;
    check.as_it_is = StatisticsOf(differences, all), check.offset = offset;
    for (Difference& each : differences) {
      check.variance += (each.variance() - each.survey * each.survey) / static_cast<double>(all.size());
      each.difference -= offset;
    }
    check.without_offset = StatisticsOf(differences, all);
    for (Difference& each : differences) each.difference += 0.1;
    check.with_offset = StatisticsOf(differences, all);
    return check;
  }

  double radius_, shared_;
  SimulatedPlace place_;
  WavesOfTwoPasses of_passes_ = place_.OfTwoPasses();
};

class CheckPointsOfSurveys : public ::testing::TestWithParam<SurveyCase> {};

TEST_P(CheckPointsOfSurveys, LieAsFarFromTheSurfaceAsPredicted) {
  const SurveyCase& c = GetParam();
  const int count = EveryCase() ? 1000 : c.surveys;
  if (count == 0) GTEST_SKIP() << "ALBTPU_EVERY_CASE=1 runs it";
  const Surveys surveys(c);
  std::vector<CheckOfSurvey> checks(static_cast<std::size_t>(count));
  tbb::parallel_for(std::size_t{0}, checks.size(), [&](std::size_t i) { checks[i] = surveys(i + 1); });

  const double n = count;
  double points = 0, mean = 0, squares = 0, by_degrees = 0, bias = 0, held = 0, by_passes = 0;
  int in_z = 0, in_rmse = 0, found = 0, not_there = 0, scatters = 0;
  for (const CheckOfSurvey& check : checks) {
    const DifferenceStatistics& of = check.as_it_is;
    points += static_cast<double>(of.points);
    mean += of.squared_z.value / n, squares += std::pow(of.squared_z.value, 2) / n;
    by_degrees += 2 / of.squared_z_degrees / (n * n);
    held += of.within_predicted / n, bias += of.offset() / n;
    in_z += !of.squared_z.excludes(1);
    in_rmse += !of.rmse.excludes(std::sqrt(std::pow(check.offset + of.bias, 2) + check.variance));
    scatters += of.scatter_differs;
    by_passes += check.by_passes / static_cast<double>(Surveys::kSurveysWithPasses);
    not_there += check.without_offset.has_offset;
    found += check.with_offset.has_offset;
  }
  const double standard_error = std::sqrt((squares - mean * mean) / (n - 1));
  std::printf(
      "%s, %d surveys, %.0f check points: z^2 %.3f +- %.3f (+- %.3f by degrees of freedom), mean offset %+.1f mm; "
      "within 1.96 sigma %.1f %%; intervals hold: z^2 %d, RMSE %d; an offset of 0.1 m is named in %d, one that is not "
      "there in %d; scatter differs in %d; passes share %+.3f\n",
      c.name.c_str(), count, points, mean, standard_error, std::sqrt(by_degrees), 1000 * bias, 100 * held, in_z,
      in_rmse, found, not_there, scatters, by_passes);
  const auto at_most = [n](double rate) { return rate * n + 3 * std::sqrt(rate * (1 - rate) * n); };
  EXPECT_GT(points, 0.99 * 40 * n);
  EXPECT_NEAR(mean, 1 + by_passes, c.shared > 0 ? std::max(0.05, 3 * standard_error) : 0.03 + 3 * standard_error);
  if (c.shared == 0) return;
  EXPECT_LE(n - in_z, at_most(0.05));
  EXPECT_LE(n - in_rmse, at_most(0.05));
  EXPECT_LE(not_there, at_most(0.01));
  EXPECT_LE(scatters, at_most(2 * kTailOfPart));
  EXPECT_GE(found, 0.99 * n);
}

INSTANTIATE_TEST_SUITE_P(Cases, CheckPointsOfSurveys,
                         ::testing::Values(SurveyCase{"palmer", ScanPattern::kPalmer, 50},
                                           SurveyCase{"raster", ScanPattern::kRaster, 0},
                                           SurveyCase{"random", ScanPattern::kRandom, 0},
                                           SurveyCase{"palmer_within_1_m", ScanPattern::kPalmer, 0, 1},
                                           SurveyCase{"waves_of_palmer", ScanPattern::kPalmer, 0, kDefaultRadius, 0},
                                           SurveyCase{"waves_of_raster", ScanPattern::kRaster, 0, kDefaultRadius, 0},
                                           SurveyCase{"waves_of_random", ScanPattern::kRandom, 0, kDefaultRadius, 0}),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace albtpu::quality
