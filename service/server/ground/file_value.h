// What a few files say, for as long as a server runs: read again when one of them changes.
#pragma once

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "service/server/ground/file_stamp.h"

namespace albtpu::server {

// Files that cannot be read any more, or that say what is not right, change nothing: what they said before
// holds, and the log says why. Such files are read again, at most each second: what was in the way may have been
// the system, with too many open files. May be asked from several threads.
template <typename Value>
class FileValue {
 public:
  using Read = std::function<absl::StatusOr<Value>()>;

  // `read` reads `files`, now and whenever one of them has changed. Fails as it does the first time.
  static absl::StatusOr<std::unique_ptr<FileValue>> Open(std::vector<std::filesystem::path> files,
                                                         Read read) {
    Stamps stamps = StampsOf(files);
    absl::StatusOr<Value> value = read();
    if (!value.ok()) return value.status();
    return std::unique_ptr<FileValue>(
        new FileValue(std::move(files), std::move(read), std::move(stamps), *std::move(value)));
  }

  // The same object until a file has changed.
  std::shared_ptr<const Value> Get() {
    const std::lock_guard lock(mutex_);
    // The stamps are older than what is read: a change meanwhile is noticed the next time.
    if (Stamps stamps = StampsOf(files_); stamps != stamps_) {
      stamps_ = std::move(stamps);
      failure_ = absl::OkStatus();
      ReadAgain();
    } else if (!failure_.ok() && Clock::now() - read_at_ > std::chrono::seconds(1)) {
      ReadAgain();
    }
    return value_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Stamps = std::vector<FileStamp>;

  FileValue(std::vector<std::filesystem::path> files, Read read, Stamps stamps, Value value)
      : files_(std::move(files)),
        read_(std::move(read)),
        stamps_(std::move(stamps)),
        value_(std::make_shared<const Value>(std::move(value))) {}

  static Stamps StampsOf(const std::vector<std::filesystem::path>& files) {
    Stamps stamps;
    for (const std::filesystem::path& file : files) stamps.push_back(StampOf(file));
    return stamps;
  }

  void ReadAgain() {
    absl::StatusOr<Value> value = read_();
    const bool is_known = value.status() == failure_;
    failure_ = value.status();
    read_at_ = Clock::now();
    if (value.ok()) {
      value_ = std::make_shared<const Value>(*std::move(value));
      spdlog::info("{}: has changed and been read again", files_.front().string());
    } else if (!is_known) {
      spdlog::error("{}; what was read before holds", std::string(failure_.message()));
    }
  }

  const std::vector<std::filesystem::path> files_;
  const Read read_;
  std::mutex mutex_;
  Stamps stamps_;  // Guarded by mutex_, as are:
  std::shared_ptr<const Value> value_;
  absl::Status failure_;  // Of the last time that the files were read.
  Clock::time_point read_at_;
};

}  // namespace albtpu::server
