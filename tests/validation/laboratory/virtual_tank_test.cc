#include "validation/laboratory/virtual_tank.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "sea/angle.h"

namespace albtpu {
namespace {

TankExperiment Small() {
  TankExperiment experiment;
  experiment.beams.push_back(LaboratoryBeam(RadiansOfDegrees(20)));
  experiment.rays = 2000;
  experiment.grid = {0.512, 128};
  experiment.frames = 6;
  return experiment;
}

TEST(TankSea, HasTheRequestedWaveHeight) {
  EXPECT_NEAR(4 * std::sqrt(ElevationVariance(TankSea(3, 0.009))), 0.009, 1e-12);
}

TEST(VirtualTank, MeasuresNoRefractionInStillWater) {
  const TankExperiment experiment = Small();
  const auto still = [&](int) {
    return std::vector<double>(static_cast<std::size_t>(experiment.grid.size) * experiment.grid.size, 0.0);
  };
  for (const TankReading& reading : ObserveTank(experiment, still)) {
    EXPECT_LT(reading.full_beam.along_wind.abs().maxCoeff(), 1e-12);
    EXPECT_EQ(reading.arrays.front().along_wind.size(), experiment.frames);
    EXPECT_LT(reading.arrays.front().along_wind.abs().maxCoeff(), 1e-12);
    EXPECT_LT(reading.arrays.front().cross_wind.abs().maxCoeff(), 1e-12);
  }
}

// Water that is lower by h and has no slope does not move a vertical beam; it moves a slanted one by h (tan - tan
// refracted).
TEST(VirtualTank, ReadsAWaterLevelAsRefractionOfASlantedBeamAsThePaperDoes) {
  const TankExperiment experiment = Small();
  const double h = 0.005;
  const auto low = [&](int) {
    return std::vector<double>(static_cast<std::size_t>(experiment.grid.size) * experiment.grid.size, -h);
  };
  const auto readings = ObserveTank(experiment, low);
  EXPECT_LT(std::abs(readings[0].full_beam.along_wind[0]), 1e-6);
  const double incidence = RadiansOfDegrees(20);
  const double shift =
      h * (std::tan(incidence) - std::tan(StillWaterRefraction(incidence, experiment.refractive_index)));
  // The rays of the cone are up to 1.8 degrees off its axis, which changes their mean by a relative 1e-3 or so.
  EXPECT_NEAR(readings[1].full_beam.along_wind[0], std::atan(shift / experiment.depth), 1e-2 * shift / 0.25);
}

TEST(VirtualTank, DoesNotDependOnThreads) {
  const TankExperiment experiment = Small();
  const auto water = IndependentFrames(TankSea(3, 0.009), experiment.grid, 1, 0);
  const auto many = ObserveTank(experiment, water);
  tbb::task_arena one(1);
  one.execute([&] {
    const auto serial = ObserveTank(experiment, water);
    for (std::size_t b = 0; b < many.size(); ++b) {
      EXPECT_TRUE((many[b].arrays[0].along_wind == serial[b].arrays[0].along_wind).all());
      EXPECT_TRUE((many[b].full_beam.cross_wind == serial[b].full_beam.cross_wind).all());
    }
  });
}

TEST(VirtualTank, HasSuccessiveFramesThatContinueEachOther) {
  TankExperiment experiment = Small();
  experiment.frames = 40;
  const auto reading = [&](double rate) {
    return ObserveTank(experiment, SuccessiveFrames(TankSea(3, 0.009), experiment.grid, rate, 1, 0)).front();
  };
  const auto mean_step = [](const Eigen::ArrayXd& angle) {
    const Eigen::Index n = angle.size();
    return (angle.tail(n - 1) - angle.head(n - 1)).square().mean();
  };
  // Waves of a few hertz move little in a millisecond and a lot in 50 ms.
  EXPECT_LT(mean_step(reading(1000).full_beam.along_wind), 0.1 * mean_step(reading(20).full_beam.along_wind));
}

TEST(LightOfFrame, IsTheLightThatTheArraysSample) {
  TankExperiment experiment = Small();
  experiment.beams.resize(1);
  const auto water = IndependentFrames(TankSea(3, 0.009), experiment.grid, 1, 0);
  const auto centroid = [&](const std::vector<double>& heights) {
    return *PhotodiodeArray({}, Eigen::Vector2d(0, 0)).Centroid(LightOfFrame(experiment, heights));
  };
  const std::vector<double> still(static_cast<std::size_t>(experiment.grid.size) * experiment.grid.size, 0.0);
  const double shift = centroid(water(2)).x() - centroid(still).x();
  EXPECT_NEAR(ObserveTank(experiment, water)[0].arrays[0].along_wind[2], std::atan(shift / experiment.depth), 1e-12);
}

}  // namespace
}  // namespace albtpu
