// Pulses per second and core from an SBET of 200 Hz, 100 000 pulses a second along a flight line at 400 m:
//   positions        ProjectedTrack::PositionsAt: the sensor at the time of each pulse
//   geometry         BeamGeometry: positions, water level, refraction, and the columns that are written
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "annotate/beams/point_beams.h"
#include "annotate/beams/projected_track.h"
#include "formats/trajectories/sbet_file.h"
#include "tests/formats/trajectories/flight_files.h"

namespace albtpu::bench {
namespace {

using namespace albtpu::annotate;
using namespace albtpu::formats;

constexpr std::size_t kPulses = std::size_t{1} << 20, kBatch = std::size_t{1} << 16;
constexpr double kPulseRate = 100'000, kPulsesInATurn = 300;

template <typename T>
T Must(absl::StatusOr<T> result) {
  if (result.ok()) return *std::move(result);
  std::cerr << "track_bench: " << result.status() << "\n";
  std::exit(1);
}

struct FlightLine {
  FlightLine() {
    const testing::Flight flight;
    bytes = testing::SbetBytes(testing::Fly(flight));
    const TrajectoryFiles files = {Must(SbetFile::Parse("sbet", MappedFile::View(bytes)))};
    const PointTimes times = {{flight.start + 1, flight.start + flight.duration - 1}, PointTimeForm::kWeekSeconds};
    track = Must(ProjectedTrack::Create(Must(TrajectoryTimeline::Create(files, TrajectoryClock::kGps, times)),
                                        Must(MapFrame::Create("points", {.user = "EPSG:32617"})), {}));
    for (std::size_t i = 0; i < kPulses; ++i)
      points.times.push_back(flight.start + 1 + static_cast<double>(i) / kPulseRate);
    std::vector<SensorPosition> sensor(kPulses);
    std::vector<TrackOutcome> outcomes(kPulses);
    track->PositionsAt(points.times, sensor, outcomes);
    for (std::size_t i = 0; i < kPulses; ++i) {
      const double turn = 2 * std::numbers::pi * static_cast<double>(i) / kPulsesInATurn;
      const double radius = 400 * std::tan(20 * std::numbers::pi / 180);
      points.x.push_back(sensor[i].x + radius * std::sin(turn));
      points.y.push_back(sensor[i].y + radius * std::cos(turn));
      points.z.push_back(-8 - 6 * std::sin(static_cast<double>(i) / 9000));
    }
    points.pulse_surface.assign(kPulses, std::nan(""));
  }

  std::string bytes;
  std::unique_ptr<ProjectedTrack> track;
  SurveyPoints points;
};

const FlightLine& Line() {
  static const FlightLine line;
  return line;
}

void Positions(benchmark::State& state) {
  const FlightLine& line = Line();
  std::vector<SensorPosition> positions(kBatch);
  std::vector<TrackOutcome> outcomes(kBatch);
  for (auto _ : state) {
    for (std::size_t begin = 0; begin < kPulses; begin += kBatch) {
      line.track->PositionsAt(std::span(line.points.times).subspan(begin, kBatch), positions, outcomes);
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Positions)->Name("positions")->Unit(benchmark::kMillisecond);

void Geometry(benchmark::State& state) {
  const FlightLine& line = Line();
  BeamPlan plan;
  plan.source = TrajectoryFromFiles{};
  plan.footprint = DivergingBeam{.divergence = 1};
  plan.wind_from = 250;
  const WaterHeights water = {.level = 0.0};
  const formats::LocalFrame frame = {.origin_x = line.points.x[0], .origin_y = line.points.y[0]};
  const BeamGeometry geometry(plan, frame, water, line.track.get());
  std::vector<SurveyPoints> batches;
  for (std::size_t begin = 0; begin < kPulses; begin += kBatch) {
    const auto rows = [begin](const std::vector<double>& column) {
      const auto first = column.begin() + static_cast<std::ptrdiff_t>(begin);
      return std::vector<double>(first, first + kBatch);
    };
    batches.push_back({.x = rows(line.points.x),
                       .y = rows(line.points.y),
                       .z = rows(line.points.z),
                       .times = rows(line.points.times),
                       .scan_angles = {},
                       .pulse_surface = rows(line.points.pulse_surface)});
  }
  BeamScratch scratch;
  PointBeams beams;
  for (auto _ : state) {
    for (const SurveyPoints& batch : batches) {
      geometry.Compute(batch, scratch, beams);
      benchmark::DoNotOptimize(beams.incidence.data());
    }
  }
  if (beams.why_not[0].has_value()) state.SkipWithError("ERROR OCCURRED: a point has no pulse");
  state.SetItemsProcessed(state.iterations() * kPulses);
}
BENCHMARK(Geometry)->Name("geometry")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace albtpu::bench

BENCHMARK_MAIN();
