// A LAS file, which is checked when it is opened and then read from beginning to end.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "survey/files/file_stamp.h"
#include "survey/las/las_header.h"
#include "survey/las/las_vlr.h"

namespace albtpu::client {

class LasReader {
 public:
  // Reads and checks everything except the points.
  static absl::StatusOr<LasReader> Open(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  const LasHeader& header() const { return header_; }
  std::string_view head() const { return head_; }  // Every byte before the points.
  const std::vector<VlrEntry>& vlrs() const { return vlrs_; }
  const std::vector<VlrEntry>& evlrs() const { return evlrs_; }
  std::uint64_t file_size() const { return stamp_.size(); }

  // `size` bytes at `offset`, which must lie in the file. Any number of threads may read at a time.
  absl::StatusOr<std::string> ReadAt(std::uint64_t offset, std::size_t size) const;
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const;

  // Fails when the file has been modified since it was opened.
  absl::Status CheckUnchanged() const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  LasReader(std::string name, std::FILE* file);
  absl::Status ReadHead();
  absl::Status ReadEvlrs();

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  FileStamp stamp_;
  LasHeader header_;
  std::string head_;
  std::vector<VlrEntry> vlrs_, evlrs_;
};

}  // namespace albtpu::client
