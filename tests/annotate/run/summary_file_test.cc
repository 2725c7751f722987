#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "annotate/run/file_jobs.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::ReadFile;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

class SummaryFile : public ::testing::Test {
 protected:
  SummaryFile() {
    folder_.Write("in.las", "input");
    settings_.command = "las";
    settings_.parameters = nlohmann::ordered_json{{"wind_speed", 5}, {"classes", {26, 40}}, {"fetch", nullptr}};
    settings_.table.id = "survey";
    settings_.table.digest = "1234";
  }

  // Writes the output and its summary.
  absl::Status Write(Existing existing = Existing::kKeep) {
    absl::StatusOr<OutputFile> output = OutputFile::Create(job_.output, existing);
    if (!output.ok()) return output.status();
    EXPECT_TRUE(output->Write("output").ok());
    const Findings findings{.input_bytes = 5,
                            .input = nlohmann::ordered_json{{"points", 1}},
                            .answers = nlohmann::ordered_json{{"pulses", 1}}};
    const std::string text = SummaryText(settings_, job_, findings, output->size());
    return CommitWithSummary(*std::move(output), job_, text, existing);
  }

  std::string Difference() { return std::string(CheckComplete(settings_, job_).message()); }

  TemporaryFolder folder_;
  Job job_{folder_ / "in.las", folder_ / "out.las"};
  OutputSettings settings_;
};

TEST_F(SummaryFile, RecognizesACompleteOutput) {
  EXPECT_TRUE(absl::IsNotFound(CheckComplete(settings_, job_)));
  ASSERT_TRUE(Write().ok());
  EXPECT_TRUE(CheckComplete(settings_, job_).ok()) << Difference();
  EXPECT_EQ(folder_.file_count(), 3u);
}

TEST_F(SummaryFile, HasTheSameBytesInEveryFolder) {
  ASSERT_TRUE(Write().ok());
  const std::string text = ReadFile(folder_ / "out.las.json");
  EXPECT_THAT(text, ::testing::Not(HasSubstr(folder_ / "")));
  const TemporaryFolder elsewhere;
  elsewhere.Write("in.las", "input");
  job_ = {elsewhere / "in.las", elsewhere / "out.las"};
  ASSERT_TRUE(Write().ok());
  EXPECT_EQ(ReadFile(elsewhere / "out.las.json"), text);
}

TEST_F(SummaryFile, SaysWhatDiffers) {
  ASSERT_TRUE(Write().ok());
  const OutputSettings original = settings_;
  (*settings_.parameters)["wind_speed"] = 6;
  EXPECT_THAT(Difference(), HasSubstr("parameters.wind_speed is 5 there, 6 here"));
  settings_ = original;
  (*settings_.parameters)["classes"] = {26};
  EXPECT_THAT(Difference(), HasSubstr("parameters.classes is [26,40] there, [26] here"));
  settings_ = original;
  settings_.table.digest = "5678";
  EXPECT_THAT(Difference(), HasSubstr("table.digest is \"1234\" there"));
  settings_ = original;
  folder_.Write("out.las", "outpu");
  EXPECT_THAT(Difference(), HasSubstr("output.bytes is 6 there, 5 here"));
  ASSERT_TRUE(Write(Existing::kReplace).ok());
  folder_.Write("in.las", "other input");
  EXPECT_THAT(Difference(), HasSubstr("input.bytes is 5 there, 11 here"));
}

TEST_F(SummaryFile, NoticesThatTheInputIsNewer) {
  ASSERT_TRUE(Write().ok());
  const auto later = std::filesystem::last_write_time(job_.output) + std::chrono::seconds(1);
  std::filesystem::last_write_time(job_.input, later);
  EXPECT_THAT(Difference(), HasSubstr("in.las is newer"));
}

TEST_F(SummaryFile, RejectsAnOutputThatIsOlderThanItsTrajectory) {
  settings_.files = {folder_.Write("sbet.out", "trajectory")};
  ASSERT_TRUE(Write().ok());
  EXPECT_TRUE(CheckComplete(settings_, job_).ok()) << Difference();
  const auto later = std::filesystem::last_write_time(job_.output) + std::chrono::seconds(1);
  std::filesystem::last_write_time(settings_.files[0], later);
  EXPECT_THAT(Difference(), HasSubstr("sbet.out is newer"));
}

TEST_F(SummaryFile, RejectsAnOutputWithoutAValidSummary) {
  for (const char* text : {"", "{", "[]", "{\"program\": 1}", "{\"parameters\": 1, \"command\": \"las\"}"}) {
    folder_.Write("out.las", "output");
    folder_.Write("out.las.json", text);
    EXPECT_TRUE(absl::IsFailedPrecondition(CheckComplete(settings_, job_))) << text;
  }
}

TEST_F(SummaryFile, RejectsADeeplyNestedOrHugeSummary) {
  const auto nested = [](std::size_t depth) {
    return "{\"parameters\": " + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  folder_.Write("out.las", "output");
  for (const std::string& text : {nested(200'000), nested(500'000), std::string(2 << 20, ' ')}) {
    folder_.Write("out.las.json", text);
    EXPECT_TRUE(absl::IsFailedPrecondition(CheckComplete(settings_, job_)));
  }
}

TEST_F(SummaryFile, NamesTheOutputWhenBothExist) {
  ASSERT_TRUE(Write().ok());
  EXPECT_THAT(CheckSummaryCanBeWritten(job_, Existing::kKeep).message(), HasSubstr("out.las: already exists"));
}

TEST_F(SummaryFile, KeepsAnotherFileWithItsName) {
  folder_.Write("out.las.json", "{\"precious\": 1}");
  EXPECT_TRUE(absl::IsAlreadyExists(Write()));
  EXPECT_FALSE(std::filesystem::exists(job_.output));
  EXPECT_EQ(ReadFile(folder_ / "out.las.json"), "{\"precious\": 1}");
  EXPECT_TRUE(Write(Existing::kReplace).ok());
}

TEST_F(SummaryFile, ReplacesASummaryLeftByAKilledRun) {
  ASSERT_TRUE(Write().ok());
  std::filesystem::remove(job_.output);
  EXPECT_TRUE(absl::IsNotFound(CheckComplete(settings_, job_)));
  EXPECT_TRUE(Write().ok());
  EXPECT_TRUE(CheckComplete(settings_, job_).ok());
}

}  // namespace
}  // namespace albtpu::annotate
