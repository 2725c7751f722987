#include "formats/las/las_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::formats {
LasReader::LasReader(std::string name, std::FILE* file)
    : name_(std::move(name)), file_(std::make_unique<const File>(file)) {}

absl::StatusOr<LasReader> LasReader::Open(const std::filesystem::path& path) {
  // O_NONBLOCK: opening a pipe without a writer returns immediately, and the pipe is refused.
  const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  std::FILE* file = descriptor < 0 ? nullptr : fdopen(descriptor, "rb");
  if (file == nullptr) {
    const int error = errno;
    return absl::Status(absl::ErrnoToStatusCode(error), absl::StrCat(path.string(), ": ", std::strerror(error),
                                                                     "; give a LAS or LAZ file that can be read"));
  }
  LasReader reader(path.string(), file);
  if (!reader.file_->stamp().is_regular()) {
    return absl::FailedPreconditionError(
        absl::StrCat(path.string(), ": is not a regular file; give a LAS or LAZ file"));
  }
  RETURN_IF_ERROR(reader.ReadHead());
  RETURN_IF_ERROR(reader.ReadEvlrs());
  RETURN_IF_ERROR(reader.ReadLaszipRecord());
  RETURN_IF_ERROR(reader.CheckCompatibility());
  posix_fadvise(descriptor, 0, 0, POSIX_FADV_SEQUENTIAL);
  return reader;
}

absl::StatusOr<std::string> LasReader::ReadAt(std::uint64_t offset, std::size_t size) const {
  std::string bytes(size, '\0');
  RETURN_IF_ERROR(ReadAt(offset, std::span<char>(bytes)));
  return bytes;
}

absl::Status LasReader::ReadAt(std::uint64_t offset, std::span<char> bytes) const {
  return Named(file_->ReadAt(offset, bytes));
}

absl::Status LasReader::Named(const absl::Status& status) const {
  return status.ok() ? status : absl::Status(status.code(), absl::StrCat(name_, ": ", status.message()));
}

absl::Status LasReader::File::ReadAt(std::uint64_t offset, std::span<char> bytes) const {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count =
        pread(descriptor(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      return absl::DataLossError(absl::StrCat("reading failed at byte ", offset + done, " (",
                                              count < 0 ? std::strerror(errno) : "the file became shorter",
                                              "); copy the file to a sound disk"));
    }
    done += static_cast<std::size_t>(count);
  }
  return absl::OkStatus();
}

absl::Status LasReader::CheckUnchanged() const { return file_->stamp().CheckUnchanged(name_, file_->descriptor()); }

absl::Status LasReader::ReadHead() {
  ASSIGN_OR_RETURN(const std::string beginning, ReadAt(0, std::min<std::uint64_t>(file_size(), kLargestLasHeader)));
  ASSIGN_OR_RETURN(header_, ParseLasHeader(name_, beginning, file_size()));
  ASSIGN_OR_RETURN(head_, ReadAt(0, header_.offset_to_points));
  ASSIGN_OR_RETURN(vlrs_, ListVlrs(name_, header_, head_));
  return absl::OkStatus();
}

// LASzip's compatibility mode stores formats 6 to 10 as 1 to 5: classes above 31 as 0, scan angles as whole degrees,
// and the rest in extra bytes of these names (LASzip 3.4.3, laszip_dll.cpp). The record of the mode may be lost on the
// way.
absl::Status LasReader::CheckCompatibility() const {
  if (header_.point_format >= 6) return absl::OkStatus();
  for (const VlrEntry& vlr : vlrs_) {
    const bool described = vlr.Is(kSpecUser, kExtraBytesRecord) &&
                           head().substr(vlr.data_offset, vlr.data_size).find("LAS 1.4 classification") != head().npos;
    if (vlr.user_id != kCompatibleUser && !described) continue;
    return Named(absl::InvalidArgumentError(
        absl::StrCat("has points of LAS 1.4 in the compatibility mode of LASzip (lascompatible), as point format ",
                     header_.point_format,
                     ", in which classes above 31 are 0 and scan angles are rounded; restore "
                     "them by `laszip -i IN.laz -o OUT.las`")));
  }
  return absl::OkStatus();
}

// LAZ has one LASzip record, LAS none.
absl::Status LasReader::ReadLaszipRecord() {
  std::vector<const VlrEntry*> records;
  for (const VlrEntry& vlr : vlrs_)
    if (vlr.user_id == laz::kLaszipUser) records.push_back(&vlr);
  if (!header_.compressed) {
    if (records.empty()) return absl::OkStatus();
    return Named(absl::InvalidArgumentError(
        absl::StrCat("has a LASzip record, but its point format is not marked as compressed", laz::kGetAnotherCopy)));
  }
  if (records.size() != 1 || !records[0]->Is(laz::kLaszipUser, laz::kLaszipRecordId)) {
    return Named(absl::InvalidArgumentError(absl::StrCat("its points are compressed, but it has ", records.size(),
                                                         " LASzip records (expected one, of number ",
                                                         laz::kLaszipRecordId, ")", laz::kGetAnotherCopy)));
  }
  const VlrEntry& vlr = *records[0];
  absl::StatusOr<laz::LaszipRecord> record = laz::ParseLaszipRecord(head().substr(vlr.data_offset, vlr.data_size),
                                                                    header_.point_format, header_.record_length);
  if (!record.ok()) return Named(record.status());
  extent_ = {.record = *std::move(record),
             .points_begin = header_.offset_to_points,
             .point_count = header_.point_count,
             .points_end = file_size()};
  for (const std::uint64_t start : {header_.start_of_evlrs, header_.start_of_waveform_packet})
    if (start != 0) extent_->points_end = std::min(extent_->points_end, start);
  return absl::OkStatus();
}

absl::Status LasReader::ReadEvlrs() {
  std::uint64_t next = header_.start_of_evlrs;
  for (std::uint32_t i = 0; i < header_.evlr_count; ++i) {
    if (file_size() - next < kEvlrHeaderSize) {
      return absl::DataLossError(absl::StrCat(name_, ": extended variable length record ", i + 1, " of ",
                                              header_.evlr_count, " begins at byte ", next, ", but the file has only ",
                                              file_size(), "; get a complete copy"));
    }
    ASSIGN_OR_RETURN(const std::string bytes, ReadAt(next, kEvlrHeaderSize));
    ASSIGN_OR_RETURN(const VlrEntry evlr, ParseEvlr(name_, bytes, next, file_size()));
    evlrs_.push_back(evlr);
    next = evlr.end();
  }
  // A header that counts none may still say where they begin.
  if (header_.version_minor >= 4 && header_.evlr_count == 0)
    next = laz::Load<std::uint64_t>(head_, las_field::kStartOfEvlrs);
  if (next < header_.offset_to_points || next > file_size() || file_size() - next < kEvlrHeaderSize)
    return absl::OkStatus();
  ASSIGN_OR_RETURN(const std::string bytes, ReadAt(next, kEvlrHeaderSize));
  const absl::StatusOr<VlrEntry> more = ParseEvlr(name_, bytes, next, file_size());
  if (!more.ok() || !MustBeCounted(*more)) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat(name_, ": its header counts ", header_.evlr_count,
                                                 " extended variable length records, but another follows at byte ",
                                                 next, " (", more->user_id, " ", more->record_id,
                                                 "); correct the number"));
}

}  // namespace albtpu::formats
