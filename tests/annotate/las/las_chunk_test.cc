#include "annotate/las/las_chunk.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <limits>
#include <random>

#include "annotate/las/las_annotation.h"
#include "annotate/las/las_beams.h"
#include "annotate/las/las_prescan.h"
#include "formats/las/las_reader.h"
#include "laz/coding/little_endian.h"
#include "service/client/local_source.h"
#include "tests/formats/las/las_builder.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::LasPoint;
using albtpu::testing::LasSpec;
using laz::Load;

using albtpu::testing::kBottom;
using albtpu::testing::kSurface;

// Pulses with a return from the surface, one from the bottom, or both, whose records are mixed with those of their
// neighbours: the two of a pulse lie up to about 25 records apart, some of them beyond kPulseReach. Each surface return
// has a height of its own, which tells from where a point has its water.
LasSpec MixedPulses(std::size_t pulses) {
  std::mt19937 random(7);
  struct Placed {
    double at;
    LasPoint point;
  };
  std::vector<Placed> placed;
  for (std::size_t i = 0; i < pulses; ++i) {
    const auto jitter = [&] { return static_cast<double>(random() % 1000) / 50; };
    LasPoint point = {.x = static_cast<std::int32_t>(random() % 200000),
                      .y = static_cast<std::int32_t>(random() % 200000),
                      .scan_angle = static_cast<double>(random() % 30) - 15,
                      .gps_time = 1000 + static_cast<double>(i / 2),  // Two pulses at a time.
                      .return_count = 2 + static_cast<int>(i % 2)};
    const unsigned kind = random() % 4;
    if (kind != 0) {
      point.classification = kSurface;
      point.z = static_cast<std::int32_t>(random() % 1000) - 500;
      point.return_number = 1;
      placed.push_back({static_cast<double>(i) + jitter(), point});
    }
    if (kind != 1) {
      point.classification = kBottom;
      point.z = -2000 - static_cast<std::int32_t>(random() % 8000);
      point.return_number = 2;
      placed.push_back({static_cast<double>(i) + jitter(), point});
    }
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) { return a.at < b.at; });
  LasSpec spec;
  spec.vlrs.push_back({"LASF_Projection", 2112, albtpu::testing::kMetricWkt});
  for (const Placed& each : placed) spec.points.push_back(each.point);
  return spec;
}

class LasChunkTest : public ::testing::Test {
 protected:
  LasChunkTest() {
    annotation_.plan.source = AcrossTrackScan{.flight_direction = 10, .altitude = 400};
    annotation_.plan.wind_speed = 5;
    annotation_.plan.wind_from = 200;
    annotation_.plan.footprint = DivergingBeam{.divergence = 1};
    annotation_.plan.water_level = 0.25;
    annotation_.plan.water_classes = {kSurface};
    annotation_.details = true;
  }

  struct Result {
    std::string records;
    std::string surface, outcomes, incidence;  // As they are stated.
    SurfaceCounts counts;
  };

  // The records of the file in chunks of `size` points, each with the records around it that may belong to its pulses.
  Result AnnotateInChunks(const std::string& file, std::size_t size) {
    const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder_.Write("in.las", file));
    const formats::LasHeader& header = reader->header();
    const absl::StatusOr<std::unique_ptr<LasBeams>> beams = LasBeams::Find(*reader, annotation_);
    EXPECT_TRUE(beams.ok() && (*beams)->has_surface_returns());
    const LasChunkWork work(header, annotation_, {}, (*beams)->geometries(), formats::UtcClock(), true, source_);
    LasChunkWork::Chunk chunk(annotation_.style);  // Used again for each part.
    Result result;
    UncertaintySummary summary(annotation_.style);
    CoordinateSpread incidence;
    const std::size_t count = header.point_count, length = header.record_length;
    for (std::size_t begin = 0; begin < count; begin += size) {
      const std::size_t end = std::min(begin + size, count);
      const std::size_t first = begin - std::min(kPulseReach, begin);
      const std::size_t last = std::min(end + kPulseReach, count);
      chunk.before = begin - first;
      chunk.own = end - begin;
      chunk.records = file.substr(header.offset_to_points + first * length, (last - first) * length);
      EXPECT_TRUE(work(chunk).ok());
      result.records += chunk.annotated;
      result.counts.Merge(chunk.surface);
      summary.Merge(chunk.summary);
      incidence.Merge(chunk.incidence);
    }
    result.surface = result.counts.Text();
    result.outcomes = summary.outcomes().Text();
    result.incidence = std::to_string(incidence.count()) + " " + std::to_string(incidence.least()) + " " +
                       std::to_string(incidence.middle()) + " " + std::to_string(incidence.greatest());
    return result;
  }

  // The records that the whole program writes for the file.
  std::string AnnotateFile(const std::string& file) {
    const std::filesystem::path output = folder_ / "out.las";
    FileProgress progress("points", 1, 0);
    absl::StatusOr<AnnotatedLas> annotated = AnnotateLas(folder_.Write("in.las", file), {.las = output, .csv = {}},
                                                         Existing::kReplace, annotation_, source_, progress);
    EXPECT_TRUE(annotated->file.Commit().ok());
    const std::string bytes = albtpu::testing::ReadFile(output);
    return bytes.substr(Load<std::uint32_t>(bytes, 96));
  }

  // The surface return of the same pulse by comparing all records: the nearest one within kPulseReach that has the time
  // and the return count of the point and another return number. Returns how many points have one beyond.
  std::size_t ExpectSurfaceOfPulse(const LasSpec& spec) {
    const Result whole = AnnotateInChunks(BuildLas(spec), 64);
    const std::size_t length =
        albtpu::testing::PointSize(6) + formats::AppendedFloats({.details = true}).size() * sizeof(float);
    std::size_t found = 0, beyond = 0;
    for (std::size_t i = 0; i < spec.points.size(); ++i) {
      const LasPoint& point = spec.points[i];
      if (point.classification != kBottom) continue;
      const LasPoint* surface = nullptr;
      std::size_t nearest = spec.points.size();
      for (std::size_t j = 0; j < spec.points.size(); ++j) {
        const LasPoint& other = spec.points[j];
        if (other.classification != kSurface || other.gps_time != point.gps_time ||
            other.return_count != point.return_count || other.return_number == point.return_number)
          continue;
        const std::size_t distance = i > j ? i - j : j - i;
        if (distance >= nearest) continue;
        nearest = distance;
        surface = &other;
      }
      if (surface == nullptr) continue;
      if (nearest > kPulseReach) {
        ++beyond;
        continue;
      }
      ++found;
      const std::size_t depth = albtpu::testing::PointSize(6) + (formats::kUncertaintyCount + 3) * sizeof(float);
      EXPECT_EQ(Load<float>(whole.records, i * length + depth),
                static_cast<float>(surface->z * spec.scale - point.z * spec.scale))
          << i;
    }
    EXPECT_EQ(whole.counts[SurfaceFrom::kPulse], found);
    EXPECT_GT(found, 100u);
    return beyond;
  }

  const albtpu::testing::TemporaryFolder folder_;
  client::LocalSource source_{"", albtpu::testing::SyntheticTable()};
  LasAnnotation annotation_;
};

TEST_F(LasChunkTest, GivesTheSameBytesForChunksOfAnySize) {
  const LasSpec spec = MixedPulses(2000);
  const std::string file = BuildLas(spec);
  const Result whole = AnnotateInChunks(file, spec.points.size());
  EXPECT_GT(whole.counts[SurfaceFrom::kPulse], 100u);
  EXPECT_GT(whole.counts[SurfaceFrom::kLocal], 100u);
  EXPECT_GT(whole.counts[SurfaceFrom::kLevel], 20u);
  for (const std::size_t size : {1, 7, 64, 1000}) {
    const Result parts = AnnotateInChunks(file, size);
    EXPECT_TRUE(parts.records == whole.records) << "chunks of " << size;
    EXPECT_EQ(parts.surface, whole.surface) << size;
    EXPECT_EQ(parts.outcomes, whole.outcomes) << size;
    EXPECT_EQ(parts.incidence, whole.incidence) << size;
  }
}

TEST_F(LasChunkTest, FindsTheSurfaceReturnOfThePulse) {
  const LasSpec spec = MixedPulses(2000);
  EXPECT_GT(ExpectSurfaceOfPulse(spec), 20u);
}

TEST_F(LasChunkTest, FindsTheSurfaceReturnOfThePulseInOrderOfTime) {
  LasSpec spec = MixedPulses(2000);
  std::ranges::stable_sort(spec.points, {}, &LasPoint::gps_time);
  ExpectSurfaceOfPulse(spec);
}

TEST_F(LasChunkTest, FindsTheSurfaceReturnOfThePulseWhereATimeIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& times : {std::vector<double>{7, none, 3}, std::vector<double>{9, none, 3}}) {
    for (const bool of_the_bottom : {false, true}) {
      LasSpec spec = MixedPulses(2000);
      spec.points.clear();
      LasPoint point = {.gps_time = 3, .return_count = 2};
      const auto add = [&](bool bottom, double time) {
        point.classification = bottom ? kBottom : kSurface;
        point.z = bottom ? -3000 : 100 + static_cast<int>(spec.points.size());
        point.gps_time = time;
        point.return_number = bottom ? 2 : 1;
        spec.points.push_back(point);
      };
      for (const double time : times) add(of_the_bottom, time);
      add(!of_the_bottom, 3);
      const std::string file = BuildLas(spec);
      EXPECT_EQ(AnnotateInChunks(file, spec.points.size()).counts[SurfaceFrom::kPulse], 1u);
    }
  }
}

// The program cuts a file into parts of 8 MiB, here of 1042 records, and works on them in parallel.
TEST_F(LasChunkTest, GivesTheBytesOfOneChunkForAnyNumberOfThreads) {
  LasSpec spec = MixedPulses(4000);
  spec.extra_bytes = 8020;
  ASSERT_GT(spec.points.size(), 5 * 1042u);
  const std::string file = BuildLas(spec);
  const std::string whole = AnnotateInChunks(file, spec.points.size()).records;
  for (const std::size_t threads : {1, 2, 8}) {
    const oneapi::tbb::global_control most(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(AnnotateFile(file) == whole) << threads << " threads";
  }
}

}  // namespace
}  // namespace albtpu::annotate
