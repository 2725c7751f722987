#include "service/server/ground/file_value.h"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "absl/status/status.h"
#include "tests/temporary_folder.h"

namespace albtpu::server {
namespace {

using Text = FileValue<std::string>;

// A file whose value is its first word; an empty file is invalid.
class FileValueTest : public ::testing::Test {
 protected:
  absl::StatusOr<std::unique_ptr<Text>> Open() {
    return Text::Open({path_}, [this]() -> absl::StatusOr<std::string> {
      std::string word;
      if (std::ifstream(path_) >> word) return word;
      return absl::InvalidArgumentError("no word: expected one");
    });
  }

  // Replaces the file atomically.
  void Write(const std::string& text) { std::filesystem::rename(folder_.Write("new", text), path_); }

  testing::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "file";
};

TEST_F(FileValueTest, IsReadFromTheFile) {
  Write("first");
  const auto value = Open().value();
  EXPECT_EQ(*value->Get(), "first");
  EXPECT_EQ(value->Get(), value->Get());
}

TEST_F(FileValueTest, ChangesWithTheFile) {
  Write("first");
  const auto value = Open().value();
  const std::shared_ptr<const std::string> before = value->Get();
  Write("other");
  EXPECT_EQ(*value->Get(), "other");
  EXPECT_EQ(*before, "first");
}

TEST_F(FileValueTest, StaysWhileTheFileIsInvalid) {
  Write("first");
  const auto value = Open().value();
  Write("");
  EXPECT_EQ(*value->Get(), "first");
  std::filesystem::remove(path_);
  EXPECT_EQ(*value->Get(), "first");
  Write("third");
  EXPECT_EQ(*value->Get(), "third");
}

TEST_F(FileValueTest, IsReadAgainAfterATemporaryError) {
  Write("first");
  bool readable = true;
  const auto value = Text::Open({path_}, [&]() -> absl::StatusOr<std::string> {
                       std::string word;
                       std::ifstream(path_) >> word;
                       return readable ? absl::StatusOr<std::string>(word) : absl::InternalError("too many open files");
                     }).value();
  readable = false;
  Write("other");
  EXPECT_EQ(*value->Get(), "first");
  readable = true;
  while (*value->Get() != "other") std::this_thread::yield();
}

TEST_F(FileValueTest, RequiresAValidFileAtFirst) {
  EXPECT_EQ(Open().status(), absl::InvalidArgumentError("no word: expected one"));
}

}  // namespace
}  // namespace albtpu::server
