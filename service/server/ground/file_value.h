// A value read from a few files, which is read again whenever one of them changes.
#pragma once

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::server {

// Detects whether a file on disk is still the one that was read.

// Device, inode, size, and the times of the last change of the content and of the inode, each in s and ns.
// No program can set the last of these times back. All zeros if there is no such file.
using FileIdentity = std::array<long long, 7>;

inline FileIdentity IdentityOf(const std::filesystem::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return {static_cast<long long>(found.st_dev),
          static_cast<long long>(found.st_ino),
          found.st_size,
          found.st_mtim.tv_sec,
          found.st_mtim.tv_nsec,
          found.st_ctim.tv_sec,
          found.st_ctim.tv_nsec};
}

// If the files can no longer be read, or their content is invalid, the last good value stays in use and the log
// says why. The read is then retried at most once a second, because the cause may have been temporary, such as too
// many open files. Thread-safe.
template <typename Value>
class FileValue {
 public:
  using Read = std::function<absl::StatusOr<Value>()>;

  // `read` reads `files`, now and whenever one of them has changed. Fails if the first read fails.
  static absl::StatusOr<std::unique_ptr<FileValue>> Open(std::vector<std::filesystem::path> files, Read read) {
    Identities identities = IdentitiesOf(files);
    absl::StatusOr<Value> value = read();
    if (!value.ok()) return value.status();
    return std::unique_ptr<FileValue>(
        new FileValue(std::move(files), std::move(read), std::move(identities), *std::move(value)));
  }

  // Returns the same object until a file has changed.
  std::shared_ptr<const Value> Get() {
    const std::lock_guard lock(mutex_);
    // The identities are taken before the read, so a change during the read is noticed the next time.
    if (Identities identities = IdentitiesOf(files_); identities != identities_) {
      identities_ = std::move(identities);
      failure_ = absl::OkStatus();
      Reread();
    } else if (!failure_.ok() && Clock::now() - read_at_ > std::chrono::seconds(1)) {
      Reread();
    }
    return value_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Identities = std::vector<FileIdentity>;

  FileValue(std::vector<std::filesystem::path> files, Read read, Identities identities, Value value)
      : files_(std::move(files)),
        read_(std::move(read)),
        identities_(std::move(identities)),
        value_(std::make_shared<const Value>(std::move(value))) {}

  static Identities IdentitiesOf(const std::vector<std::filesystem::path>& files) {
    Identities identities;
    for (const std::filesystem::path& file : files) identities.push_back(IdentityOf(file));
    return identities;
  }

  void Reread() {
    absl::StatusOr<Value> value = read_();
    const bool is_known = value.status() == failure_;
    failure_ = value.status();
    read_at_ = Clock::now();
    if (value.ok()) {
      value_ = std::make_shared<const Value>(*std::move(value));
      spdlog::info("{}: changed and was read again", files_.front().string());
    } else if (!is_known) {
      spdlog::error("{}; the values read before stay in use", std::string(failure_.message()));
    }
  }

  const std::vector<std::filesystem::path> files_;
  const Read read_;
  std::mutex mutex_;
  Identities identities_;  // Guarded by mutex_, as are all members below.
  std::shared_ptr<const Value> value_;
  absl::Status failure_;  // Of the last read; OK if it succeeded.
  Clock::time_point read_at_;
};

}  // namespace albtpu::server
