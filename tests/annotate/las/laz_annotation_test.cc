// Annotation of the same points as LAS and as LAZ: the same numbers, bit for bit.
#include <gmock/gmock.h>

#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/las/las_annotation.h"
#include "formats/las/las_points.h"
#include "laz/chunk_table.h"
#include "laz/coding/little_endian.h"
#include "service/client/local_source.h"
#include "tests/formats/las/las_builder.h"
#include "tests/laz/laz_bytes.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::BuildLaz;
using albtpu::testing::LasSpec;
using albtpu::testing::ReadFile;
using albtpu::testing::TemporaryFolder;
using laz::Load;
using laz::Store;
using ::testing::HasSubstr;

constexpr int kSurface = 9, kBottom = 26;

// Pulses with a return from the surface and one from the bottom, in time.
LasSpec Spec(int version_minor, int point_format, int pulses = 500) {
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  for (int i = 0; i < pulses; ++i) {
    const double angle = i % 37 - 18;
    spec.points.push_back({i * 40, i % 90, i % 11, kSurface, angle, i * 0.01, 1, 2, 7});
    spec.points.push_back({i * 40 + 3, i % 90, -2000 - i, kBottom, angle, i * 0.01, 2, 2, 7});
  }
  spec.vlrs = {{"LASF_Projection", 2112, albtpu::testing::kMetricWkt}, {"someone", 3, "a record"}};
  spec.gap = version_minor == 0 ? "\xDD\xCC" : "between";
  if (version_minor >= 3) spec.waveform_packet = "samples";
  if (version_minor >= 4) spec.evlrs = {{"someone", 7, "behind"}, {"someone", 8, ""}};
  return spec;
}

class LazAnnotation : public ::testing::Test {
 protected:
  LazAnnotation() {
    annotation_.classes = {kBottom};
    annotation_.plan.source = AcrossTrackScan();
    annotation_.plan.wind_speed = 5;
    annotation_.plan.footprint = 0.5f;
    annotation_.plan.azimuth = 30.0f;
    annotation_.plan.water_level = 0;
    annotation_.details = true;
  }

  // The bytes of the output, or the message of the error.
  std::string Annotate(const std::string& file, std::optional<formats::LasKind> kind = std::nullopt) {
    const std::filesystem::path input = folder_.Write("in", file), output = folder_ / "out";
    absl::StatusOr<AnnotatedLas> annotated =
        AnnotateLas(input, {.las = output, .csv = {}}, Existing::kReplace, annotation_, source_, progress_, kind);
    if (!annotated.ok()) {
      EXPECT_EQ(folder_.file_count(), 1u) << "something was left behind";
      return std::string(annotated.status().message());
    }
    EXPECT_TRUE(annotated->file.Commit().ok());
    notes_ = annotated->notes;
    copc_index_left_out_ = annotated->copc_index_left_out;
    std::string bytes = ReadFile(output);
    std::filesystem::remove(output);
    return bytes;
  }

  std::vector<std::string> notes_;
  bool copc_index_left_out_ = false;
  TemporaryFolder folder_;
  client::LocalSource source_{"", albtpu::testing::SyntheticTable()};
  LasAnnotation annotation_;
  FileProgress progress_{"points", 1, 0};
};

std::string RecordsOf(const TemporaryFolder& folder, const std::string& file) {
  const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder.Write("read", file));
  absl::StatusOr<formats::LasPointRuns> runs = formats::LasPointRuns::Open(*reader, 0, 0);
  std::string records;
  formats::LasRun run;
  while (runs->Next(1000, run).value()) records += run.records;
  std::filesystem::remove(folder / "read");
  return records;
}

TEST_F(LazAnnotation, GivesTheSameBytesAsLasInEveryVersionAndFormat) {
  for (int version = 0; version <= 4; ++version) {
    for (int format = 0; format <= (version < 2 ? 1 : version == 2 ? 3 : version == 3 ? 5 : 10); ++format) {
      LasSpec spec = Spec(version, format);
      spec.extra_bytes = format % 2 == 0 ? 3 : 0;
      const std::string las = BuildLas(spec), laz = BuildLaz(spec, 300);
      const std::string las_to_las = Annotate(las), las_to_laz = Annotate(las, formats::LasKind::kLaz);
      EXPECT_TRUE(Annotate(laz, formats::LasKind::kLas) == las_to_las) << version << " " << format;
      EXPECT_TRUE(Annotate(laz) == las_to_laz) << version << " " << format;
      // The layers of a chunk of the same points are taken over.
      EXPECT_TRUE(Annotate(BuildLaz(spec, laz::kCommonChunkSize)) == las_to_laz) << version << " " << format;
      annotation_.replace = true;
      EXPECT_TRUE(Annotate(las_to_laz) == las_to_laz) << version << " " << format;
      annotation_.replace = false;
      EXPECT_TRUE(RecordsOf(folder_, las_to_laz) == RecordsOf(folder_, las_to_las)) << version << " " << format;
      EXPECT_EQ(static_cast<unsigned char>(las_to_laz[104]), 0x80 | format);
      if (version >= 3) {
        EXPECT_EQ(las_to_laz.substr(Load<std::uint64_t>(las_to_laz, 227), 7), "samples");
      }
      if (version >= 4) {
        EXPECT_EQ(las_to_laz.substr(Load<std::uint64_t>(las_to_laz, 235) + 60, 6), "behind");
      }
    }
  }
}

// Behind the points of LAS it would pass for more of them.
TEST_F(LazAnnotation, LeavesOutWhatNoHeaderNames) {
  LasSpec spec = Spec(4, 6);
  spec.waveform_packet.clear();
  spec.evlrs.clear();
  const std::string laz = BuildLaz(spec, 300), las_to_las = Annotate(BuildLas(spec));
  EXPECT_TRUE(Annotate(laz + std::string(4096, '\0'), formats::LasKind::kLas) == las_to_las);
  std::string lost = laz;  // The writer did not go back to state where its chunk table is, nor at the end.
  Store(~std::uint64_t{0}, lost.data() + Load<std::uint32_t>(lost, 96));
  EXPECT_TRUE(Annotate(lost, formats::LasKind::kLas) == las_to_las);
}

TEST_F(LazAnnotation, SearchesThePulsesAcrossChunks) {
  annotation_.plan.water_classes = {kSurface};
  LasSpec spec = Spec(4, 6, 40'000);
  spec.points.erase(spec.points.begin());  // Chunks of even numbers of points divide the pulses.
  const std::string las_to_las = Annotate(BuildLas(spec));
  for (const std::uint32_t size : {1000u, 50'000u, 1'000'000u})
    EXPECT_TRUE(Annotate(BuildLaz(spec, size), formats::LasKind::kLas) == las_to_las) << size;
  EXPECT_TRUE(Annotate(BuildLaz(spec, 50'000)) == Annotate(BuildLas(spec), formats::LasKind::kLaz));
}

TEST_F(LazAnnotation, WritesTheLaszipRecordLast) {
  const std::string laz = Annotate(BuildLaz(Spec(2, 1), 100));
  const absl::StatusOr<formats::LasReader> reader = formats::LasReader::Open(folder_.Write("out.laz", laz));
  ASSERT_EQ(reader->vlrs().size(), 4u);
  EXPECT_TRUE(reader->vlrs()[2].Is("LASF_Spec", 4));
  EXPECT_TRUE(reader->vlrs()[3].Is("laszip encoded", 22204));
  EXPECT_EQ(reader->extent().record.chunk_size, laz::kCommonChunkSize);
}

TEST_F(LazAnnotation, WritesAnEmptyTableWhereThereAreNoPoints) {
  LasSpec spec = Spec(2, 0, 0);
  spec.points.clear();
  const std::string laz = Annotate(BuildLas(spec), formats::LasKind::kLaz);
  const auto begin = Load<std::uint32_t>(laz, 96);
  EXPECT_EQ(Load<std::uint64_t>(laz, begin), begin + 8);
  EXPECT_EQ(laz.substr(begin + 8), std::string(8, '\0'));
  EXPECT_TRUE(Annotate(BuildLaz(spec, 100)) == laz);
}

TEST_F(LazAnnotation, LeavesTheIndexOfCopcOut) {
  LasSpec spec = Spec(4, 6);
  const std::string expected = Annotate(BuildLaz(spec, 100));
  EXPECT_FALSE(copc_index_left_out_);
  spec.vlrs.insert(spec.vlrs.begin(), {"copc", 1, std::string(160, 'i')});
  spec.evlrs.insert(spec.evlrs.begin() + 1, {"copc", 1000, std::string(64, 'h')});
  EXPECT_TRUE(Annotate(BuildLaz(spec, 100)) == expected);
  EXPECT_TRUE(copc_index_left_out_);
  EXPECT_THAT(notes_.back(), HasSubstr("the index of COPC is left out"));
  spec.evlrs = {{"copc", 1000, std::string(64, 'h')}};
  const std::string without = Annotate(BuildLaz(spec, 100));
  EXPECT_EQ(Load<std::uint64_t>(without, 235), 0u);
  EXPECT_EQ(Load<std::uint32_t>(without, 243), 0u);
}

TEST_F(LazAnnotation, KeepsTheOffsetThatAPipeNeedsOutOfTheTail) {
  const LasSpec spec = Spec(2, 1);
  std::string laz = BuildLaz(spec, 100);
  const std::string expected = Annotate(laz);
  const auto begin = Load<std::uint32_t>(laz, 96);
  laz += laz.substr(begin, 8);
  Store<std::int64_t>(-1, laz.data() + begin);
  EXPECT_TRUE(Annotate(laz) == expected);
}

TEST_F(LazAnnotation, RefusesWhatContradictsItself) {
  const LasSpec spec = Spec(4, 6);
  const std::string name = (folder_ / "in").string() + ": ", remedy = "; get another copy of the file";
  const std::string truth = BuildLaz(spec, 100);
  const std::uint64_t begin = Load<std::uint32_t>(truth, 96), points = spec.points.size();
  std::string laz = truth;
  laz[104] = 0x40 | 6;
  EXPECT_EQ(Annotate(laz), name +
                               "is compressed by a LASzip from before 2.0 (2011); decompress it first, by "
                               "`laszip -i IN.laz -o OUT.las`");
  laz = BuildLas(spec);
  laz[104] = static_cast<char>(0x80 | 6);
  EXPECT_EQ(Annotate(laz),
            name + "its points are compressed, but it has 0 LASzip records (expected one, of number 22204)" + remedy);
  laz = truth;
  laz[104] = 6;
  Store<std::uint64_t>(10, laz.data() + 247);  // As many as fit uncompressed.
  Store<std::uint64_t>(begin + 10 * 30, laz.data() + 227);
  Store<std::uint64_t>(begin + 10 * 30, laz.data() + 235);
  Store<std::uint32_t>(0, laz.data() + 243);
  EXPECT_EQ(Annotate(laz), name + "has a LASzip record, but its point format is not marked as compressed" + remedy);
  laz = truth;
  Store<std::uint64_t>(points + 1, laz.data() + 247);
  EXPECT_EQ(Annotate(laz), name + absl::StrCat("its chunk table states ", points, " points in 10 chunks (expected ",
                                               points + 1, ", as the header states)", remedy));
  laz = truth;
  const auto table = laz::ReadChunkTable(laz::MemorySource(laz), laz::RecordFor(6, 30, 100), begin, points);
  Store<std::uint64_t>(begin + 20, laz.data() + 227);
  EXPECT_EQ(Annotate(laz), name + absl::StrCat("its chunk table ends at byte ", table->end,
                                               ", behind the begin of what follows the points, ", begin + 20, remedy));
}

TEST_F(LazAnnotation, NamesTheFileAndTheChunkOfADamage) {
  std::string laz = BuildLaz(Spec(4, 6), 100);
  const auto begin = Load<std::uint32_t>(laz, 96);
  const auto table = laz::ReadChunkTable(laz::MemorySource(laz), laz::RecordFor(6, 30, 100), begin, 1000);
  Store<std::uint32_t>(99, laz.data() + table->chunks[3].offset + 30);  // Behind the first point.
  EXPECT_EQ(Annotate(laz), (folder_ / "in").string() + ": chunk 4 of 10: it states 99 points (expected 100); " +
                               "get another copy of the file");
}

}  // namespace
}  // namespace albtpu::annotate
