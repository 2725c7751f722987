#include "annotate/run/file_jobs.h"

#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "annotate/run/file_progress.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

using albtpu::testing::ReadFile;
using albtpu::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FileJobs : public ::testing::Test {
 protected:
  FileJobs() {
    for (const char* name : {"out", "in", "in/line", "in/line/deep"}) std::filesystem::create_directory(folder_ / name);
    for (const char* name : {"b.las", "a.LAS", "notes.txt", "line/a.las", "line/deep/c.las"})
      folder_.Write(std::string("in/") + name, "");
    options_.output_folder = folder_ / "out";
  }

  // The outputs, relative to the output folder, or the message of the error.
  std::vector<std::string> Outputs() {
    const absl::StatusOr<std::vector<Job>> jobs = FindJobs("las", {".las", ".laz"}, options_);
    status_ = jobs.status();
    if (!jobs.ok()) return {std::string(jobs.status().message())};
    std::vector<std::string> outputs;
    for (const Job& job : *jobs) outputs.push_back(job.output.lexically_relative(folder_ / "out").string());
    return outputs;
  }

  TemporaryFolder folder_;
  FileOptions options_;
  absl::Status status_;
};

TEST_F(FileJobs, ExpandsAFolderToAllFilesInIt) {
  options_.files = {folder_ / "in"};
  EXPECT_THAT(Outputs(), ElementsAre("a.LAS", "b.las"));
}

TEST_F(FileJobs, RecreatesSubfoldersWhenRecursive) {
  options_.files = {folder_ / "in/"};
  options_.recursive = true;
  EXPECT_THAT(Outputs(), ElementsAre("a.LAS", "b.las", "line/a.las", "line/deep/c.las"));
}

TEST_F(FileJobs, LeavesOutFilesAndFoldersWhoseNamesBeginWithADot) {
  folder_.Write("in/.b.las", "");
  std::filesystem::create_directory(folder_ / "in/.trash");
  folder_.Write("in/.trash/d.las", "");
  options_.files = {folder_ / "in"};
  EXPECT_THAT(Outputs(), ElementsAre("a.LAS", "b.las"));
  options_.recursive = true;
  EXPECT_THAT(Outputs(), ElementsAre("a.LAS", "b.las", "line/a.las", "line/deep/c.las"));
  options_.files = {folder_ / "in/.b.las", folder_ / "in/.trash"};  // Named by the user.
  EXPECT_THAT(Outputs(), ElementsAre(".b.las", "d.las"));
}

TEST_F(FileJobs, MixesFilesAndFolders) {
  options_.files = {folder_ / "in/line/deep/c.las", folder_ / "in"};
  EXPECT_THAT(Outputs(), ElementsAre("c.las", "a.LAS", "b.las"));
}

TEST_F(FileJobs, TakesFilesOfAllExtensionsInAnyCase) {
  folder_.Write("in/c.laz", "");
  folder_.Write("in/d.LAZ", "");
  folder_.Write("in/a.laz", "");
  options_.files = {folder_ / "in"};
  EXPECT_THAT(Outputs(), ElementsAre("a.LAS", "a.laz", "b.las", "c.laz", "d.LAZ"));
}

TEST_F(FileJobs, ChangesTheExtensionOfOutputs) {
  folder_.Write("in/c.laz", "");
  folder_.Write("in/d.LAZ", "");
  folder_.Write("named.2016", "");
  options_.output_extension = ".laz";
  options_.files = {folder_ / "in", folder_ / "named.2016"};
  EXPECT_THAT(Outputs(), ElementsAre("a.laz", "b.laz", "c.laz", "d.LAZ", "named.2016.laz"));
  folder_.Write("in/b.laz", "");
  EXPECT_THAT(Outputs(), ElementsAre(HasSubstr("two outputs would be called b.laz")));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

TEST_F(FileJobs, SkipsFilesInTheOutputFolder) {
  options_.output_folder = folder_ / "in/line";
  options_.files = {folder_ / "in"};
  options_.recursive = true;
  EXPECT_EQ(Outputs().size(), 2u);
}

TEST_F(FileJobs, RejectsTwoInputsWithTheSameName) {
  options_.files = {folder_ / "in/line", folder_ / "in/../in/line/a.las"};
  EXPECT_THAT(Outputs(), ElementsAre(HasSubstr("two inputs are called a.las")));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

TEST_F(FileJobs, SaysWhichArgumentIsWrong) {
  options_.files = {folder_ / "out"};
  EXPECT_THAT(Outputs(), ElementsAre(HasSubstr("out: no .las or .laz file in this folder")));
  EXPECT_FALSE(formats::IsUsageError(status_));
  options_.output_folder = folder_ / "no";
  EXPECT_THAT(Outputs(), ElementsAre(HasSubstr("no is not a folder")));
  options_.output_folder.clear();
  EXPECT_THAT(Outputs(), ElementsAre(HasSubstr("give IN.las OUT.las")));
  EXPECT_TRUE(formats::IsUsageError(status_));
}

class SummaryFile : public ::testing::Test {
 protected:
  SummaryFile() {
    folder_.Write("in.las", "input");
    settings_.command = "las";
    settings_.parameters =
        JsonBox(nlohmann::ordered_json{{"wind_speed", 5}, {"classes", {26, 40}}, {"fetch", nullptr}});
    settings_.table.id = "survey";
    settings_.table.digest = "1234";
  }

  // Writes the output and its summary.
  absl::Status Write(Existing existing = Existing::kKeep) {
    if (absl::Status room = MakeRoomForSummary(job_, existing); !room.ok()) return room;
    absl::StatusOr<OutputFile> output = OutputFile::Create(job_.output, existing);
    if (!output.ok()) return output.status();
    EXPECT_TRUE(output->Write("output").ok());
    const Findings findings{.input_bytes = 5,
                            .input = JsonBox(nlohmann::ordered_json{{"points", 1}}),
                            .answers = JsonBox(nlohmann::ordered_json{{"pulses", 1}})};
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

// It has given the summary its name and not yet the output.
TEST_F(SummaryFile, OfAnotherProcessStays) {
  absl::StatusOr<OutputFile> output = OutputFile::Create(job_.output, Existing::kKeep);
  ASSERT_TRUE(output.ok());
  ASSERT_TRUE(Write().ok());
  std::filesystem::remove(job_.output);
  const std::string summary = ReadFile(SummaryPath(job_.output));
  EXPECT_TRUE(absl::IsAlreadyExists(CommitWithSummary(*std::move(output), job_, "another", Existing::kKeep)));
  EXPECT_EQ(ReadFile(SummaryPath(job_.output)), summary);
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
  const std::vector<std::filesystem::path> files = {folder_.Write("a.out", "trajectory"),
                                                    folder_.Write("sbet.out", "trajectory")};
  settings_.newest = NewestOf(files);
  ASSERT_TRUE(Write().ok());
  EXPECT_TRUE(CheckComplete(settings_, job_).ok()) << Difference();
  const auto later = std::filesystem::last_write_time(job_.output) + std::chrono::seconds(1);
  std::filesystem::last_write_time(files[1], later);
  settings_.newest = NewestOf(files);
  EXPECT_THAT(Difference(), HasSubstr("sbet.out is newer"));
  settings_.newest = NewestOf({files[0], folder_ / "no.out"});
  EXPECT_THAT(Difference(), HasSubstr("no.out is newer"));
  EXPECT_FALSE(NewestOf({}).has_value());
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
