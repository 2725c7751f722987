#include "tables/file/atomic_file.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/temporary_folder.h"

namespace albtpu {
namespace {

namespace fs = std::filesystem;
using ::albtpu::testing::ReadFile;
using ::albtpu::testing::TemporaryFolder;
using ::testing::HasSubstr;

TEST(AtomicFile, WritesANewFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "new", "bytes", Existing::kKeep).ok());
  EXPECT_EQ(ReadFile(folder / "new"), "bytes");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, LetsExactlyOneOfManyWritersCreateAFile) {
  const TemporaryFolder folder;
  std::vector<int> won(8);
  std::vector<std::thread> writers;
  for (std::size_t i = 0; i < won.size(); ++i) {
    writers.emplace_back(
        [&, i] { won[i] = WriteFileAtomically(folder / "new", std::to_string(i), Existing::kKeep).ok(); });
  }
  for (std::thread& writer : writers) writer.join();
  ASSERT_EQ(std::count(won.begin(), won.end(), 1), 1);
  EXPECT_EQ(won[std::stoul(ReadFile(folder / "new"))], 1);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ReportsAMissingFolder) {
  const TemporaryFolder folder;
  const absl::Status status = WriteFileAtomically(folder / "no/file", "bytes", Existing::kKeep);
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(std::string(status.message()), HasSubstr("write to a folder that exists"));
}

TEST(AtomicFile, ReportsAFolderThatIsNotWritable) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "root may write anywhere";
  }
  const TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const absl::Status status = WriteFileAtomically(folder / "file", "bytes", Existing::kKeep);
  fs::permissions(folder.path(), fs::perms::owner_all);
  EXPECT_EQ(status.code(), absl::StatusCode::kPermissionDenied);
}

TEST(AtomicFile, ReportsAFolderThatIsAFile) {
  const TemporaryFolder folder;
  std::ofstream(folder / "file");
  EXPECT_FALSE(WriteFileAtomically(folder / "file/x", "bytes", Existing::kReplace).ok());
  EXPECT_FALSE(WriteFileAtomically("", "bytes", Existing::kReplace).ok());
}

// With a limit on the size of files, a write fails halfway, as it does on a full disk.
TEST(AtomicFile, LeavesNothingBehindAfterAFailedWrite) {
  const TemporaryFolder folder;
  std::ofstream(folder / "old") << "precious";
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small = {10'000, before.rlim_max};
  const auto handler = signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const absl::Status status = WriteFileAtomically(folder / "old", std::string(1'000'000, 'x'), Existing::kReplace);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  signal(SIGXFSZ, handler);
  EXPECT_THAT(std::string(status.message()), HasSubstr("old: File too large"));
  EXPECT_EQ(ReadFile(folder / "old"), "precious");
  EXPECT_EQ(folder.file_count(), 1u);
}

}  // namespace
}  // namespace albtpu
