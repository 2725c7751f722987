#include "annotate/csv/csv_annotation.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "annotate/csv/csv_pulses.h"
#include "annotate/totals/plan_total.h"
#include "formats/text/text.h"
#include "service/client/local_source.h"
#include "tests/annotate/answers/test_sources.h"
#include "tests/tables/synthetic_table.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::ReadFile;
using albtpu::testing::SyntheticTable;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

class CsvAnnotation : public ::testing::Test {
 protected:
  // The annotated copy of a file with this text, or the message of the error.
  std::string Annotate(const std::string& text) {
    const std::filesystem::path input = folder_.Write("in.csv", text);
    const std::filesystem::path output = folder_ / "out.csv";
    std::filesystem::remove(output);
    FileProgress progress("pulses", 1, 0);
    absl::StatusOr<AnnotatedCsv> annotated =
        AnnotateCsv(input, output, Existing::kKeep, fixed_, style_, source_, progress);
    status_ = annotated.status();
    if (!annotated.ok()) {
      EXPECT_EQ(folder_.file_count(), 1u) << "something was left behind";
      return std::string(annotated.status().message());
    }
    EXPECT_TRUE(annotated->file.Commit().ok());
    EXPECT_EQ(annotated->input_bytes, text.size());
    counts_ = annotated->summary.outcomes();
    return ReadFile(output);
  }

  // The cells expected for a pulse.
  std::string Cells(const Pulse& pulse) {
    const PulseUncertainty answer = albtpu::testing::QueryPulse(source_, pulse);
    std::string cells;
    for (const float value : answer.values)
      absl::StrAppend(&cells, ",", answer.outcome == Outcome::kInterpolated ? formats::FormatFloat(value) : "");
    return absl::StrCat(cells, ",", OutcomeText(answer));
  }

  void Fix(AxisId axis, float value) { Fix(InputOf(axis), value); }
  void Fix(PulseInput input, float value) { fixed_[input] = value; }

  TemporaryFolder folder_;
  client::LocalSource source_{"", SyntheticTable()};
  FixedInputs fixed_;
  AnswerStyle style_;
  OutcomeCounts counts_;
  absl::Status status_;
};

const char kAppended[] = ",refraction_along_wind,refraction_cross_wind,thu,tvu,bias_along_beam,bias_vertical,outcome";
const char kHeader[] = "wind_speed,fetch,incidence,azimuth,footprint,depth";
const Pulse kPulse = {
    .wind_speed = 5, .fetch = 3e4f, .incidence = 12.5f, .azimuth = 30.0f, .footprint = 0.6f, .depth = 7};

TEST_F(CsvAnnotation, WritesInTheDialectOfTheFile) {
  const auto with = [](std::string text, char separator, char decimal) {
    for (char& character : text) character = character == ',' ? separator : character == '.' ? decimal : character;
    return text;
  };
  const std::string plain = Annotate(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n");
  for (const auto& [separator, decimal] : {std::pair(';', ','), {'\t', ','}, {';', '.'}, {'\t', '.'}}) {
    const std::string text = with(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n", separator, decimal);
    EXPECT_EQ(Annotate(text), with(plain, separator, decimal));
  }
  const std::string quoted = Annotate(std::string(kHeader) + "\n5,3e4,\"12,5\",30,\",6\",7\n");
  EXPECT_EQ(quoted.find('.'), std::string::npos) << quoted;
  EXPECT_THAT(Annotate("depth;wind_speed;incidence;footprint\n5,5;5;12;0,6\n1.5;5;12;0,6\n"),
              HasSubstr("in.csv: has a number with a comma in line 2 and one with a point in line 3"));
  EXPECT_THAT(Annotate("depth,wind_speed,incidence,footprint\n5,5;5;12;0,6\n"),
              HasSubstr("line 2: 3 cells, but the header has 4 (columns separated by commas, decimal points)"));
}

TEST_F(CsvAnnotation, AppendsTheAnswerToEachRecord) {
  EXPECT_EQ(Annotate(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n"),
            std::string(kHeader) + kAppended + "\n5,3e4,12.5,30,.6,7" + Cells(kPulse) + "\n");
  EXPECT_EQ(counts_.Text(), "1 pulse: 1 interpolated");
}

TEST_F(CsvAnnotation, FindsColumnsInAnyOrderAmongOthers) {
  EXPECT_EQ(Annotate("\xEF\xBB\xBFname,depth, azimuth ,\"footprint\",incidence,fetch,wind_speed\r\n"
                     "\"a, \"\"b\"\"\", 7 ,30,\".6\",12.5,30000,5\r\n"),
            "\xEF\xBB\xBFname,depth, azimuth ,\"footprint\",incidence,fetch,wind_speed" + std::string(kAppended) +
                "\r\n\"a, \"\"b\"\"\", 7 ,30,\".6\",12.5,30000,5" + Cells(kPulse) + "\r\n");
}

TEST_F(CsvAnnotation, TakesAMissingColumnFromAFlag) {
  Fix(AxisId::kWindSpeed, 5);
  Fix(AxisId::kFetch, 3e4f);
  Fix(AxisId::kAzimuth, 30);
  Fix(AxisId::kFootprint, 0.6f);
  EXPECT_THAT(Annotate("incidence,depth\n12.5,7\n"), HasSubstr("12.5,7" + Cells(kPulse)));
}

TEST_F(CsvAnnotation, TreatsEmptyFetchAndAzimuthAsAbsent) {
  Pulse pulse = kPulse;
  pulse.fetch = std::numeric_limits<float>::infinity();
  pulse.azimuth.reset();
  EXPECT_THAT(
      Annotate(std::string(kHeader) + "\n5,,12.5, ,.6,7\n5,inf,12.5,,.6,7\n"),
      ::testing::AllOf(HasSubstr("\n5,,12.5, ,.6,7" + Cells(pulse)), HasSubstr("\n5,inf,12.5,,.6,7" + Cells(pulse))));
  EXPECT_THAT(Annotate("wind_speed,incidence,footprint,depth\n5,12.5,.6,7"), HasSubstr(Cells(pulse) + "\n"));
  EXPECT_THAT(counts_.Text(), HasSubstr("1 pulse: 1 interpolated; all without azimuth: "));
  Annotate(std::string(kHeader) + "\n5,,12.5,3,.6,7\n5,inf,12.5,,.6,7\n");
  EXPECT_THAT(counts_.Text(), HasSubstr("; 1 without azimuth: "));
}

TEST_F(CsvAnnotation, GivesEveryPulseAnOutcome) {
  const std::string text = Annotate(std::string(kHeader) +
                                    "\n5,,12,,.6,7\n-5,,12,,.6,7\n5,,12,,.6,-1\n5,,12,,.6,nan\ninf,,12,,.6,7\n"
                                    "5,,12,,.6,1e39\n5,-inf,12,,.6,7\n5,,91,,.6,7\n");
  EXPECT_THAT(text, HasSubstr("\n-5,,12,,.6,7,,,,,,,OUT_OF_DOMAIN:wind_speed:below\n"));
  EXPECT_THAT(text, HasSubstr("\n5,,12,,.6,-1,,,,,,,OUT_OF_DOMAIN:depth:below\n"));
  EXPECT_THAT(text, HasSubstr("\n5,,12,,.6,nan,,,,,,,INVALID"));
  EXPECT_THAT(text, HasSubstr("\ninf,,12,,.6,7,,,,,,,INVALID"));
  EXPECT_THAT(text, HasSubstr("\n5,,12,,.6,1e39,,,,,,,OUT_OF_DOMAIN:depth:above\n"));
  EXPECT_THAT(text, HasSubstr("\n5,-inf,12,,.6,7,,,,,,,INVALID"));
  EXPECT_THAT(text, HasSubstr("\n5,,91,,.6,7,,,,,,,OUT_OF_DOMAIN:incidence:above\n"));
  EXPECT_EQ(counts_.total(), 8u);
  EXPECT_EQ(counts_.interpolated(), 1u);
}

TEST_F(CsvAnnotation, CopiesBlankLinesAndFilesWithoutPulses) {
  const std::string header = std::string(kHeader) + kAppended;
  EXPECT_EQ(Annotate(std::string(kHeader) + "\n"), header + "\n");
  EXPECT_EQ(Annotate(kHeader), header + "\n");
  EXPECT_EQ(Annotate(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n\n"),
            header + "\n5,3e4,12.5,30,.6,7" + Cells(kPulse) + "\n\n");
}

TEST_F(CsvAnnotation, AppendsStandardErrorsAndS44OnRequest) {
  style_ = {.coverage = Coverage::kP95, .s44_order = S44Order::k1b, .standard_errors = true};
  const std::string text = Annotate(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n5,,12,,.6,99\n");
  EXPECT_THAT(text, HasSubstr("outcome,refraction_along_wind_standard_error,refraction_cross_wind_standard_error,"
                              "thu_standard_error,tvu_standard_error,bias_along_beam_standard_error,"
                              "bias_vertical_standard_error,s44_best_order,s44_remaining_thu,s44_remaining_tvu\n"));
  const PulseUncertainty p95 = albtpu::testing::QueryPulse(source_, kPulse, Coverage::kP95);
  EXPECT_THAT(text, HasSubstr(absl::StrCat(",", formats::FormatFloat(p95[Quantity::kThu]), ",")));
  const double left = RemainingBudget(ThuLimit(S44Order::k1b, 7), p95[Quantity::kThu]).value();
  EXPECT_THAT(text, HasSubstr(absl::StrCat(",", formats::FormatFloat(static_cast<float>(left)), ",")));
  EXPECT_THAT(text, HasSubstr(",OUT_OF_DOMAIN:depth:above,,,,,,,,,\n"));
}

TEST_F(CsvAnnotation, LeavesCellsEmptyWhereTheTableHasNoNumber) {
  source_ = client::LocalSource("", SyntheticTable({.published = true}));
  style_.standard_errors = true;
  const std::string text = Annotate(std::string(kHeader) + "\n5,3e4,12.5,30,.6,7\n");
  EXPECT_THAT(text, HasSubstr(",,,INTERPOLATED,,,,,,\n"));
}

TEST_F(CsvAnnotation, NamesLineAndColumnOfTextThatIsNotANumber) {
  const std::string ok = "5,,12,,.6,7\n";
  EXPECT_THAT(Annotate(kHeader + ("\n" + ok) + ok + "5,,12,,.6,deep\n"),
              HasSubstr("in.csv line 4, column 'depth': 'deep' is not a number; "));
  EXPECT_THAT(Annotate(kHeader + ("\n" + ok) + "5,,,,.6,7\n"), HasSubstr("line 3, column 'incidence': is empty"));
}

TEST_F(CsvAnnotation, NamesAMissingColumnAndTheFlagForIt) {
  const std::string message = Annotate("wind_speed,incidence,Depth,footprint\n5,12,7,.6\n");
  EXPECT_THAT(message,
              HasSubstr("line 1: no column 'depth' (columns found: wind_speed, incidence, Depth, footprint); add it, "
                        "or give one value for all pulses by --depth"));
  EXPECT_FALSE(formats::IsUsageError(status_));
  EXPECT_THAT(Annotate("wind_speed;incidence;Depth;footprint\n5;12;7;.6\n"),
              HasSubstr("no column 'depth' (columns found: wind_speed, incidence, Depth, footprint)"));
}

TEST_F(CsvAnnotation, RejectsAFlagBesideItsColumn) {
  Fix(AxisId::kDepth, 3);
  EXPECT_THAT(Annotate(std::string(kHeader) + "\n5,,12,,.6,7\n"), HasSubstr("--depth"));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

TEST_F(CsvAnnotation, TakesDirectionsForAzimuthAndABeamForFootprint) {
  // Wind from 250 degrees blows to 70; the beam towards 100 is 30 degrees from downwind. At nadir, the footprint is
  // 400 m * 1.5 mrad.
  Pulse pulse = kPulse;
  pulse.incidence = 0;
  pulse.footprint = 0.6f;
  const std::string by_columns = Annotate(
      "wind_speed,fetch,incidence,beam_azimuth,wind_from,altitude,divergence,depth\n"
      "5,3e4,0,100,250,400,1.5,7\n");
  EXPECT_THAT(by_columns, HasSubstr(",7" + Cells(pulse) + "\n"));
  Fix(PulseInput::kWindFrom, 250);
  Fix(PulseInput::kDivergence, 1.5f);
  EXPECT_THAT(Annotate("wind_speed,fetch,incidence,beam_azimuth,altitude,depth\n5,3e4,0,100,400,7\n"),
              HasSubstr(",7" + Cells(pulse) + "\n"));
  Fix(PulseInput::kBeamAzimuth, 100);
  Fix(PulseInput::kAltitude, 400);
  EXPECT_THAT(Annotate("wind_speed,fetch,incidence,depth\n5,3e4,0,7\n"), HasSubstr(",7" + Cells(pulse) + "\n"));
  pulse.incidence = 12.5f;
  pulse.footprint = static_cast<float>(FootprintAtIncidence(400, 1.5, 12.5));
  EXPECT_THAT(Annotate("wind_speed,fetch,incidence,depth\n5,3e4,12.5,7\n"), HasSubstr(",7" + Cells(pulse) + "\n"));
}

TEST_F(CsvAnnotation, HasNoAzimuthWhereADirectionIsEmpty) {
  Pulse pulse = kPulse;
  pulse.fetch = std::numeric_limits<float>::infinity();
  pulse.azimuth.reset();
  const std::string header = "wind_speed,incidence,beam_azimuth,wind_from,footprint,depth\n";
  const std::string text = Annotate(header + "5,12.5,,250,.6,7\n5,12.5,100, ,.6,7\n5,12.5,100,250,.6,7\n");
  EXPECT_THAT(text, HasSubstr("\n5,12.5,,250,.6,7" + Cells(pulse) + "\n"));
  EXPECT_THAT(text, HasSubstr("\n5,12.5,100, ,.6,7" + Cells(pulse) + "\n"));
  pulse.azimuth = 30;
  EXPECT_THAT(text, HasSubstr("\n5,12.5,100,250,.6,7" + Cells(pulse) + "\n"));
  EXPECT_EQ(counts_.without_azimuth(), 2u);
}

TEST_F(CsvAnnotation, ReadsNoColumnThatLacksTheOtherOfItsWay) {
  Pulse pulse = kPulse;
  pulse.fetch = std::numeric_limits<float>::infinity();
  pulse.azimuth.reset();
  EXPECT_THAT(Annotate("wind_speed,incidence,beam_azimuth,altitude,footprint,depth\n5,12.5,east,low,.6,7\n"),
              HasSubstr("east,low,.6,7" + Cells(pulse) + "\n"));
}

TEST_F(CsvAnnotation, RejectsTwoWaysToACoordinateAndNamesBoth) {
  const std::string sea = "wind_speed,incidence,depth,";
  EXPECT_THAT(Annotate(sea + "footprint,azimuth,beam_azimuth,wind_from\n"),
              HasSubstr("in.csv line 1: column 'azimuth' gives the azimuth, and so do column 'beam_azimuth' and "
                        "column 'wind_from'; leave out"));
  EXPECT_FALSE(formats::IsUsageError(status_));
  EXPECT_THAT(Annotate(sea + "footprint,altitude,divergence\n"),
              HasSubstr("column 'footprint' gives the footprint, and so do column 'altitude' and column 'divergence'"));
  Fix(PulseInput::kAltitude, 400);
  EXPECT_THAT(Annotate(sea + "footprint\n"),
              HasSubstr("column 'footprint' gives the footprint, which --altitude is for, too"));
  EXPECT_TRUE(formats::IsUsageError(status_));
  EXPECT_THAT(Annotate(sea + "altitude,divergence\n"), HasSubstr("--altitude: "));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

TEST_F(CsvAnnotation, NamesTheMissingHalfOfAWay) {
  EXPECT_THAT(Annotate("wind_speed,incidence,depth,altitude\n"),
              HasSubstr("by --footprint, or add divergence to altitude"));
  EXPECT_THAT(Annotate("wind_speed,incidence,depth\n"), HasSubstr("by --footprint, or give altitude and divergence"));
  Fix(PulseInput::kWindFrom, 250);
  EXPECT_THAT(Annotate("wind_speed,incidence,depth,footprint\n"),
              HasSubstr("--wind-from alone does not give the azimuth; add --beam-azimuth or, in a file, a column "
                        "'beam_azimuth'"));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

TEST_F(CsvAnnotation, PutsAFootprintBeyondFloatsOutOfTheDomain) {
  EXPECT_THAT(Annotate("wind_speed,incidence,depth,altitude,divergence\n5,12,7,1e30,1e30\n5,12,7,nan,1\n"),
              ::testing::AllOf(HasSubstr("1e30,1e30,,,,,,,OUT_OF_DOMAIN:footprint:above\n"),
                               HasSubstr("nan,1,,,,,,,INVALID\n")));
}

TEST_F(CsvAnnotation, RejectsAmbiguousHeaders) {
  EXPECT_THAT(Annotate("depth,wind_speed,depth,incidence,footprint\n"), HasSubstr("'depth' occurs twice"));
  EXPECT_THAT(Annotate(std::string(kHeader) + ",thu\n"), HasSubstr("column 'thu' exists already"));
  EXPECT_THAT(Annotate(""), HasSubstr("is empty"));
  EXPECT_THAT(Annotate("\n1\n"), HasSubstr("is empty"));
}

TEST_F(CsvAnnotation, RejectsRecordsWithAnotherNumberOfCells) {
  EXPECT_THAT(Annotate(std::string(kHeader) + "\n5,,12,,.6\n"), HasSubstr("line 2: 5 cells, but the header has 6"));
}

TEST_F(CsvAnnotation, DoesNotOverwriteItsInput) {
  const std::filesystem::path input = folder_.Write("in.csv", kHeader);
  FileProgress progress("pulses", 1, 0);
  const auto status = AnnotateCsv(input, input, Existing::kReplace, fixed_, style_, source_, progress).status();
  EXPECT_THAT(std::string(status.message()), HasSubstr("is the input itself"));
  EXPECT_EQ(ReadFile(input), kHeader);
}

TEST_F(CsvAnnotation, RejectsAnInputThatIsModifiedWhileItIsRead) {
  albtpu::testing::DisturbedSource source(source_,
                                          [&] { std::ofstream(folder_ / "in.csv", std::ios::app) << "5,,12,,.6,7\n"; });
  const std::filesystem::path input = folder_.Write("in.csv", std::string(kHeader) + "\n5,,12,,.6,7\n");
  FileProgress progress("pulses", 1, 0);
  const auto status =
      AnnotateCsv(input, folder_ / "out.csv", Existing::kKeep, fixed_, style_, source, progress).status();
  EXPECT_THAT(std::string(status.message()), HasSubstr("in.csv: changed while it was read"));
  EXPECT_EQ(folder_.file_count(), 1u);
}

TEST_F(CsvAnnotation, KeepsTheOrderOfRecordsAcrossChunks) {
  std::string text = "id,depth\n";
  for (int i = 0; i < 150000; ++i) absl::StrAppend(&text, i, ",", i % 20, "\n");
  Fix(AxisId::kWindSpeed, 5);
  Fix(AxisId::kIncidence, 12);
  Fix(AxisId::kFootprint, 0.6f);
  const std::string annotated = Annotate(text);
  EXPECT_EQ(counts_.interpolated(), 150000u);
  std::size_t at = annotated.find('\n') + 1;
  for (int i = 0; i < 150000; ++i) {
    const std::string begin = absl::StrCat(i, ",", i % 20, ",");
    ASSERT_EQ(annotated.compare(at, begin.size(), begin), 0) << i;
    at = annotated.find('\n', at) + 1;
  }
  EXPECT_EQ(at, annotated.size());
}

TEST(WaveHeightsOfWinds, AreThoseOfEachPulse) {
  const std::string spectrum = "Elfouhaily et al. (1997)";
  PulseBatch pulses;
  pulses.axis[Index(AxisId::kWindSpeed)] = {5, 1.0096f, 5.0103f, 9.987f, 9.987f, 12, 0, -1, NAN};
  pulses.axis[Index(AxisId::kFetch)] = {INFINITY, INFINITY, INFINITY, 3210, 51234, 5000, INFINITY, 5000, 5000};
  pulses.size = 9;
  std::vector<float> heights;
  WaveHeightsOfWinds(pulses, spectrum, heights);
  EXPECT_EQ(heights[0], WaveHeightOfWind(5, {}, spectrum));
  for (std::size_t i = 1; i < 6; ++i) {
    const float fetch = pulses.axis[Index(AxisId::kFetch)][i];
    const std::optional<float> metres = std::isfinite(fetch) ? std::optional<float>(fetch) : std::nullopt;
    const float exact = WaveHeightOfWind(pulses.axis[Index(AxisId::kWindSpeed)][i], metres, spectrum);
    EXPECT_NEAR(heights[i], exact, 1e-4 * exact) << i;
  }
  for (std::size_t i = 6; i < 9; ++i) EXPECT_EQ(heights[i], 0);
}

}  // namespace
}  // namespace albtpu::annotate
