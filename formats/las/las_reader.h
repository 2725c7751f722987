// A LAS or LAZ file, which is checked when it is opened. Its points are read by las_points.h.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "formats/files/file_access.h"
#include "formats/las/las_header.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/laz_points.h"

namespace albtpu::formats {

// LAS, or LAZ: the same with compressed points.

enum class LasKind { kLas, kLaz };

constexpr std::string_view Name(LasKind kind) { return kind == LasKind::kLas ? "LAS" : "LAZ"; }

// ".las"
inline std::string Extension(LasKind kind) { return kind == LasKind::kLas ? ".las" : ".laz"; }

class LasReader {
 public:
  // Reads and checks everything except the points.
  static absl::StatusOr<LasReader> Open(const std::filesystem::path& path);

  const std::string& name() const { return name_; }
  const LasHeader& header() const { return header_; }
  LasKind kind() const { return header_.compressed ? LasKind::kLaz : LasKind::kLas; }
  std::string_view head() const { return head_; }  // Every byte before the points.
  const std::vector<VlrEntry>& vlrs() const { return vlrs_; }
  const std::vector<VlrEntry>& evlrs() const { return evlrs_; }
  std::uint64_t file_size() const { return file_->size(); }

  // The file for other readers, which begin no message with its name.
  const laz::ByteSource& bytes() const { return *file_; }
  // The place of the compressed points. Requires LAZ.
  const laz::LazExtent& extent() const { return *extent_; }

  // `size` bytes at `offset`, which must lie in the file. Any number of threads may read at a time.
  absl::StatusOr<std::string> ReadAt(std::uint64_t offset, std::size_t size) const;
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const;

  // Begins the message of a failure with the name of the file.
  absl::Status Named(const absl::Status& status) const;

  // Fails when the file has been modified since it was opened.
  absl::Status CheckUnchanged() const;

 private:
  class File : public laz::ByteSource {
   public:
    explicit File(std::FILE* file) : file_(file), stamp_(FileStamp::Of(fileno(file))) {}
    std::uint64_t size() const override { return stamp_.size(); }
    const FileStamp& stamp() const { return stamp_; }
    absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override;
    int descriptor() const { return fileno(file_.get()); }

   private:
    struct Close {
      void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    FileStamp stamp_;
  };
  LasReader(std::string name, std::FILE* file);
  absl::Status ReadHead();
  absl::Status ReadEvlrs();
  absl::Status ReadLaszipRecord();
  absl::Status CheckCompatibility() const;

  std::string name_;
  std::unique_ptr<const File> file_;
  LasHeader header_;
  std::string head_;
  std::vector<VlrEntry> vlrs_, evlrs_;
  std::optional<laz::LazExtent> extent_;
};

}  // namespace albtpu::formats
