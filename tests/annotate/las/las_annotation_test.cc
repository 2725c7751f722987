#include "annotate/las/las_annotation.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <fstream>

#include "laz/coding/little_endian.h"
#include "service/client/local_source.h"
#include "tests/annotate/answers/test_sources.h"
#include "tests/formats/las/las_builder.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::BuildLas;
using albtpu::testing::ExtraBytesEntry;
using albtpu::testing::LasSpec;
using albtpu::testing::PointSize;
using albtpu::testing::ReadFile;
using albtpu::testing::SyntheticTable;
using albtpu::testing::TemporaryFolder;
using laz::Load;
using laz::Store;
using ::testing::HasSubstr;

// Points of each kind: bathymetric, above the water, deeper than the table, on land. Every point format can represent
// their scan angles.
LasSpec Spec(int version_minor, int point_format) {
  LasSpec spec;
  spec.version_minor = version_minor;
  spec.point_format = point_format;
  spec.points = {
      {1, 2, -5000, 26, 12}, {3, 4, 100, 26, -3}, {5, 6, -99000, 26, 0}, {7, 8, 900, 2, 5}, {9, 1, -800, 26, -18}};
  spec.vlrs.push_back({"LASF_Projection", 2112, albtpu::testing::kMetricWkt});
  return spec;
}

class LasAnnotationTest : public ::testing::Test {
 protected:
  LasAnnotationTest() {
    annotation_.classes = {26};
    annotation_.plan.source = AcrossTrackScan();
    annotation_.plan.wind_speed = 5;
    annotation_.plan.footprint = 0.5f;
    annotation_.plan.azimuth = 30.0f;
    annotation_.plan.water_level = 0;
  }

  // The annotated file, or the message of the error.
  std::string Annotate(const std::string& file) {
    const std::filesystem::path input = folder_.Write("in.las", file);
    const std::filesystem::path output = folder_ / "out.las";
    absl::StatusOr<AnnotatedLas> annotated =
        AnnotateLas(input, {.las = output, .csv = {}}, Existing::kReplace, annotation_, source_, progress_);
    if (!annotated.ok()) {
      EXPECT_EQ(folder_.file_count(), 1u) << "something was left behind";
      return std::string(annotated.status().message());
    }
    EXPECT_TRUE(annotated->file.Commit().ok());
    EXPECT_EQ(annotated->input_bytes, file.size());
    classes_ = annotated->classes;
    summary_ = annotated->summary;
    std::string bytes = ReadFile(output);
    std::filesystem::remove(output);
    return bytes;
  }
  std::string Annotate(const LasSpec& spec) { return Annotate(BuildLas(spec)); }

  PulseUncertainty AnswerFor(const LasSpec& spec, std::size_t point) {
    Pulse pulse;
    pulse.wind_speed = annotation_.plan.wind_speed;
    pulse.incidence = static_cast<float>(std::abs(spec.points[point].scan_angle));
    pulse.azimuth = annotation_.plan.azimuth;
    pulse.footprint = 0.5f;
    pulse.depth = static_cast<float>(-spec.points[point].z * spec.scale * annotation_.plan.metres_per_unit.value_or(1));
    return albtpu::testing::QueryPulse(source_, pulse, annotation_.style.coverage);
  }

  TemporaryFolder folder_;
  client::LocalSource source_{"", SyntheticTable()};
  LasAnnotation annotation_;
  formats::LasClassCounts classes_;
  UncertaintySummary summary_{AnswerStyle{}};
  FileProgress progress_{"points", 1, 0};
};

// The file that the builder makes from the specification after adding our VLR and 8 bytes to each record. The annotated
// file may differ from it only in those 8 bytes.
std::string Expected(LasSpec spec, const std::string& descriptions) {
  spec.vlrs.push_back({"LASF_Spec", 4, descriptions});
  spec.extra_bytes += 8;
  return BuildLas(spec);
}

TEST_F(LasAnnotationTest, KeepsEveryByteInEveryVersionAndFormat) {
  for (int version = 0; version <= 4; ++version) {
    for (int format = 0; format <= (version < 2 ? 1 : version == 2 ? 3 : version == 3 ? 5 : 10); ++format) {
      for (const std::size_t extra : {0, 6}) {
        LasSpec spec = Spec(version, format);
        spec.extra_bytes = extra;
        spec.header_tail = extra > 0 ? "more of the header" : "";
        spec.gap = version == 0 ? "\xDD\xCC" : "between";  // The first version signs the beginning of the points.
        if (version >= 3) spec.waveform_packet = "samples";
        if (version >= 4) spec.evlrs = {{"someone", 7, "behind"}, {"someone", 8, ""}};
        const std::string input = BuildLas(spec), output = Annotate(input);
        const std::size_t old_length = PointSize(format) + extra;
        const auto old_points = Load<std::uint32_t>(input, 96), new_points = Load<std::uint32_t>(output, 96);
        const std::size_t count = spec.points.size();
        ASSERT_EQ(Load<std::uint16_t>(output, 105), old_length + 8);

        // Point records: the same bytes, followed by 8 more.
        for (std::size_t i = 0; i < count; ++i) {
          const std::string record = output.substr(new_points + i * (old_length + 8), old_length + 8);
          ASSERT_EQ(record.substr(0, old_length), input.substr(old_points + i * old_length, old_length));
          const PulseUncertainty answer = AnswerFor(spec, i);
          const bool has_value = spec.points[i].classification == 26 && answer.outcome == Outcome::kInterpolated;
          EXPECT_EQ(Load<float>(record, old_length), has_value ? answer[Quantity::kThu] : -1) << i;
          EXPECT_EQ(Load<float>(record, old_length + 4), has_value ? answer[Quantity::kTvu] : -1) << i;
        }
        // After the points: the same bytes, at the offsets that the header states.
        EXPECT_EQ(output.substr(new_points + count * (old_length + 8)), input.substr(old_points + count * old_length));
        if (version >= 3) {
          EXPECT_EQ(output.substr(Load<std::uint64_t>(output, 227), 7), "samples");
        }
        if (version >= 4) {
          EXPECT_EQ(output.substr(Load<std::uint64_t>(output, 235) + 60, 6), "behind");
        }
        // Before the points: the builder's own header and VLRs and one more VLR, apart from the description of that
        // VLR.
        std::string head = output.substr(0, new_points);
        std::string builder_head =
            Expected(spec, std::string(extra > 0 ? 3 * 192 : 2 * 192, '\0')).substr(0, new_points);
        const std::size_t vlr = new_points - spec.gap.size() - (extra > 0 ? 3 : 2) * 192 - 54;
        EXPECT_EQ(head.substr(0, vlr), builder_head.substr(0, vlr));
        EXPECT_EQ(head.substr(vlr, 2), version == 0 ? "\xBB\xAA" : std::string(2, '\0'));  // Its signature.
        EXPECT_EQ(head.substr(vlr + 2, 20), builder_head.substr(vlr + 2, 20));
        EXPECT_EQ(head.substr(new_points - spec.gap.size()), spec.gap);
      }
    }
  }
}

TEST_F(LasAnnotationTest, CountsClassesAndOutcomes) {
  Annotate(Spec(4, 6));
  EXPECT_EQ(classes_.points(), 5u);
  EXPECT_EQ(summary_.outcomes().Text(), "4 pulses: 2 interpolated, 1 OUT_OF_DOMAIN:depth:above, 1 ABOVE_WATER");
  EXPECT_EQ(classes_.Text(), "class 2: 1 points, class 26: 4 points");
  EXPECT_THAT(summary_.Text(), HasSubstr("depth 0.800 m to 5.000 m"));
}

TEST_F(LasAnnotationTest, ExtendsAnExistingExtraBytesRecord) {
  LasSpec spec = Spec(4, 6);
  spec.extra_bytes = 5;
  const std::string described = ExtraBytesEntry(4, 0, "echo width");  // Two bytes; three are undocumented.
  spec.vlrs = {{"LASF_Spec", 4, described}, {"someone", 3, "last"}};
  const std::string output = Annotate(spec);
  EXPECT_EQ(Load<std::uint32_t>(output, 100), 2u);
  EXPECT_EQ(Load<std::uint16_t>(output, 375 + 20), 4 * 192);
  EXPECT_EQ(output.substr(375 + 54, 192), described);
  EXPECT_EQ(output.substr(375 + 54 + 4 * 192 + 54, 4), "last");
}

TEST_F(LasAnnotationTest, StatesTheCoverageOfTheQuery) {
  annotation_.style.coverage = Coverage::kP95;
  const LasSpec spec = Spec(4, 6);
  const std::string output = Annotate(spec);
  const PulseUncertainty p95 = AnswerFor(spec, 0);
  EXPECT_EQ(Load<float>(output, Load<std::uint32_t>(output, 96) + 30), p95[Quantity::kThu]);
  EXPECT_THAT(output, HasSubstr("sea surface only, 95 %, m"));
}

TEST_F(LasAnnotationTest, ReadsItsOwnOutputAndRefusesToAnnotateItAgain) {
  const std::string output = Annotate(Spec(3, 1));
  EXPECT_THAT(Annotate(output), HasSubstr("already has sea_thu"));
}

TEST_F(LasAnnotationTest, AnnotatesAFileWithoutPoints) {
  LasSpec spec = Spec(2, 0);
  spec.points.clear();
  EXPECT_EQ(Annotate(spec).size(), BuildLas(spec).size() + 54 + 2 * 192);
  EXPECT_EQ(classes_.points(), 0u);
}

TEST_F(LasAnnotationTest, IgnoresTheFlagsBesideALegacyClass) {
  // The builder sets a flag in the byte of the class; class 26 must be recognized nevertheless.
  Annotate(Spec(2, 0));
  EXPECT_EQ(summary_.outcomes().total(), 4u);
}

TEST_F(LasAnnotationTest, RequiresAUnitWhenTheFileIsInFeet) {
  LasSpec spec = Spec(4, 6);
  spec.vlrs = {{"LASF_Projection", 2112, "VERT_CS[\"x\",UNIT[\"US survey foot\",0.304800609601219]]"}};
  EXPECT_THAT(Annotate(spec), HasSubstr("in feet (unit \"US survey foot\"); give the unit"));
  annotation_.plan.metres_per_unit = 1200.0 / 3937.0;
  const std::string output = Annotate(spec);
  EXPECT_EQ(Load<float>(output, Load<std::uint32_t>(output, 96) + 30), AnswerFor(spec, 0)[Quantity::kThu]);
}

TEST_F(LasAnnotationTest, RejectsVlrsOfWrongLength) {
  LasSpec spec = Spec(4, 6);
  std::string file = BuildLas(spec);
  Store<std::uint32_t>(2, file.data() + 100);
  EXPECT_THAT(Annotate(file), HasSubstr("variable length record 2 of 2"));
  file = BuildLas(spec);
  Store<std::uint16_t>(60000, file.data() + 375 + 20);
  EXPECT_THAT(Annotate(file), HasSubstr("variable length record 1 of 1"));

  spec.evlrs = {{"someone", 7, "behind"}};
  file = BuildLas(spec);
  const std::size_t evlr = Load<std::uint64_t>(file, 235);
  EXPECT_THAT(Annotate(file.substr(0, file.size() - 1)), HasSubstr("ends after the file"));
  EXPECT_THAT(Annotate(file.substr(0, evlr + 59)), HasSubstr("get a complete copy"));
  Store<std::uint64_t>(~0ull, file.data() + evlr + 20);
  EXPECT_THAT(Annotate(file), HasSubstr("ends after the file"));
}

TEST_F(LasAnnotationTest, RejectsLazThatIsMarkedOnlyByItsVlr) {
  LasSpec spec = Spec(4, 6);
  spec.vlrs.push_back({"laszip encoded", 22204, "x"});
  EXPECT_THAT(Annotate(spec), HasSubstr("in.las: has a LASzip record, but its point format is not marked"));
}

TEST_F(LasAnnotationTest, RejectsRecordsThatCannotGrow) {
  LasSpec spec = Spec(2, 0);
  spec.extra_bytes = 65535 - 20 - 7;
  EXPECT_THAT(Annotate(spec), HasSubstr("no room for 8 more bytes"));
}

TEST_F(LasAnnotationTest, RejectsAnInputThatIsModifiedWhileItIsRead) {
  const std::string file = BuildLas(Spec(4, 6));
  for (const std::size_t size : {file.size(), file.size() - 1, file.size() + 1}) {
    const std::filesystem::path input = folder_.Write("in.las", file);
    std::filesystem::last_write_time(input, std::filesystem::file_time_type::clock::now() - std::chrono::seconds(9));
    albtpu::testing::DisturbedSource source(source_, [&] {
      std::string changed = file;
      changed.resize(size);
      std::ofstream(input, std::ios::binary) << changed;
    });
    const auto status =
        AnnotateLas(input, {.las = folder_ / "out.las", .csv = {}}, Existing::kKeep, annotation_, source, progress_)
            .status();
    EXPECT_THAT(std::string(status.message()), HasSubstr("in.las: changed while it was read"));
    EXPECT_EQ(folder_.file_count(), 1u);
  }
}

TEST_F(LasAnnotationTest, LeavesNothingBehindWhenTheSourceFails) {
  const std::filesystem::path input = folder_.Write("in.las", BuildLas(Spec(4, 6)));
  albtpu::testing::DisturbedSource source(
      source_, [] {}, absl::UnavailableError("gone"));
  const auto status =
      AnnotateLas(input, {.las = folder_ / "out.las", .csv = {}}, Existing::kKeep, annotation_, source, progress_)
          .status();
  EXPECT_EQ(status, absl::UnavailableError("gone"));
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_F(LasAnnotationTest, DoesNotOverwriteItsInput) {
  const std::string file = BuildLas(Spec(4, 6));
  const std::filesystem::path input = folder_.Write("in.las", file);
  std::filesystem::create_symlink(input, folder_ / "out.las");
  const auto status =
      AnnotateLas(input, {.las = folder_ / "out.las", .csv = {}}, Existing::kReplace, annotation_, source_, progress_)
          .status();
  EXPECT_THAT(std::string(status.message()), HasSubstr("is the input itself"));
  EXPECT_EQ(ReadFile(input), file);
}

}  // namespace
}  // namespace albtpu::annotate
