#include "formats/files/file_access.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "tests/temporary_folder.h"

namespace albtpu::formats {
namespace {

using albtpu::testing::ReadFile;
using albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

TEST(OutputFile, AppearsWhenCommitted) {
  const TemporaryFolder folder;
  absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kKeep);
  ASSERT_TRUE(file->Write("whole").ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  ASSERT_TRUE(file->Commit().ok());
  EXPECT_EQ(ReadFile(folder / "out"), "whole");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, ReplacesBytesThatWereWritten) {
  const TemporaryFolder folder;
  absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kKeep);
  ASSERT_TRUE(file->Write("0000 points").ok());
  ASSERT_TRUE(file->WriteAt(2, "42").ok());
  EXPECT_EQ(file->size(), 11u);
  ASSERT_TRUE(file->Write(", all").ok());
  ASSERT_TRUE(file->Commit().ok());
  EXPECT_EQ(ReadFile(folder / "out"), "0042 points, all");
}

TEST(OutputFile, LeavesNothingBehindUnlessCommitted) {
  const TemporaryFolder folder;
  {
    absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kKeep);
    ASSERT_TRUE(file->Write("half").ok());
  }
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(OutputFile, KeepsAnExistingFile) {
  const TemporaryFolder folder;
  folder.Write("out", "old");
  const absl::Status status = OutputFile::Create(folder / "out", Existing::kKeep).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kAlreadyExists);
  EXPECT_THAT(std::string(status.message()), HasSubstr("--overwrite"));
  EXPECT_EQ(ReadFile(folder / "out"), "old");
}

TEST(OutputFile, KeepsAFileThatAppearedMeanwhile) {
  const TemporaryFolder folder;
  absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kKeep);
  ASSERT_TRUE(file->Write("ours").ok());
  folder.Write("out", "theirs");
  EXPECT_EQ(file->Commit().code(), absl::StatusCode::kAlreadyExists);
  file = absl::CancelledError();  // Discards it.
  EXPECT_EQ(ReadFile(folder / "out"), "theirs");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(OutputFile, ReplacesAFileOnlyWhenComplete) {
  const TemporaryFolder folder;
  folder.Write("out", "old");
  absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kReplace);
  ASSERT_TRUE(file->Write("new").ok());
  EXPECT_EQ(ReadFile(folder / "out"), "old");
  ASSERT_TRUE(file->Commit().ok());
  EXPECT_EQ(ReadFile(folder / "out"), "new");
}

TEST(OutputFile, DoesNotReplaceFoldersOrDevices) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "out");
  for (const std::filesystem::path& path : {folder / "out", std::filesystem::path("/dev/null")})
    EXPECT_EQ(OutputFile::Create(path, Existing::kReplace).status().code(), absl::StatusCode::kFailedPrecondition);
}

TEST(OutputFile, SaysThatTheFolderIsMissing) {
  const TemporaryFolder folder;
  const absl::Status status = OutputFile::Create(folder / "no" / "out", Existing::kKeep).status();
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("no/out: No such file or directory (no output was written); write to a folder"));
}

TEST(OutputFile, HasTheUsualModeOfANewFile) {
  const TemporaryFolder folder;
  const mode_t mask = umask(022);
  absl::StatusOr<OutputFile> file = OutputFile::Create(folder / "out", Existing::kKeep);
  umask(mask);
  ASSERT_TRUE(file->Commit().ok());
  struct stat status;
  ASSERT_EQ(stat((folder / "out").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(OutputFile, IsNotTheInputUnderAnotherName) {
  const TemporaryFolder folder;
  const std::filesystem::path input = folder.Write("in", "x");
  std::filesystem::create_hard_link(input, folder / "hard");
  std::filesystem::create_symlink(input, folder / "soft");
  EXPECT_FALSE(CheckNotTheSameFile(input, input).ok());
  EXPECT_FALSE(CheckNotTheSameFile(input, folder / "hard").ok());
  EXPECT_FALSE(CheckNotTheSameFile(input, folder / "soft").ok());
  EXPECT_TRUE(CheckNotTheSameFile(input, folder / "other").ok());
}

TEST(FilesRead, AreNotReplacedUnderAnyName) {
  const TemporaryFolder folder;
  const std::filesystem::path input = folder.Write("in", "x");
  folder.Write("other", "x");
  std::filesystem::create_symlink(input, folder / "soft");
  FilesRead read;
  read.Add({input, folder / "absent"});
  const auto of = [&](const char* name) { return read.CheckNotReplacedBy(folder / name); };
  EXPECT_THAT(std::string(of("in").message()), HasSubstr("in: is read by this run"));
  EXPECT_FALSE(of("soft").ok());
  EXPECT_TRUE(of("absent").ok());
  EXPECT_TRUE(of("other").ok());
}

TEST(FilesAt, AreTheVisibleOnesOfAFolderByName) {
  const TemporaryFolder folder;
  for (const char* const name : {"b", ".c", "a"}) folder.Write(name, "x");
  std::filesystem::create_directory(folder / "d");
  EXPECT_THAT(*FilesAt(folder.path()), ::testing::ElementsAre(folder / "a", folder / "b"));
  EXPECT_THAT(*FilesAt(folder / ".c"), ::testing::ElementsAre(folder / ".c"));  // Named by the user.
}

TEST(FileAccess, KnowsUtf16) {
  const auto wide = [](std::string_view text, bool big) {
    std::string bytes;
    for (const char each : text) bytes += big ? std::string{'\0', each} : std::string{each, '\0'};
    return bytes;
  };
  for (const bool big : {false, true}) {
    EXPECT_TRUE(IsUtf16(wide("time,depth", big)));
    EXPECT_TRUE(IsUtf16((big ? "\xFE\xFF" : "\xFF\xFE") + wide("time,depth", big)));
  }
  EXPECT_FALSE(IsUtf16("time,depth"));
  EXPECT_FALSE(IsUtf16("\xEF\xBB\xBFtime,depth"));
  EXPECT_FALSE(IsUtf16(std::string(136, '\0')));
  EXPECT_FALSE(IsUtf16(""));
}

}  // namespace
}  // namespace albtpu::formats
