#include "annotate/run/file_jobs.h"

#include <gmock/gmock.h>

#include "annotate/run/file_progress.h"
#include "tests/temporary_folder.h"

namespace albtpu::annotate {
namespace {

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

}  // namespace
}  // namespace albtpu::annotate
