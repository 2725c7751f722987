// Detects whether a file on disk is still the one that was read.
#pragma once

#include <sys/stat.h>

#include <array>
#include <filesystem>

namespace albtpu::server {

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

}  // namespace albtpu::server
