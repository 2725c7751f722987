#include "formats/las/las_vlr.h"

#include "absl/strings/str_cat.h"
#include "formats/laz/coding/little_endian.h"

namespace albtpu::formats {
namespace {

using laz::Load;
using laz::Store;

// Both kinds begin with the same fields: reserved u16, user id, record id u16, length u16 or u64, description.
constexpr std::size_t kUserIdField = 2;
constexpr std::size_t kUserIdSize = 16;
constexpr std::size_t kRecordIdField = 18;
constexpr std::size_t kVlrDescriptionField = 22;

VlrEntry ParseCommon(std::string_view bytes, std::uint64_t offset) {
  VlrEntry entry;
  const std::string_view user = bytes.substr(kUserIdField, kUserIdSize);
  entry.user_id = std::string(user.substr(0, user.find('\0')));
  entry.record_id = Load<std::uint16_t>(bytes, kRecordIdField);
  entry.offset = offset;
  return entry;
}

}  // namespace

absl::StatusOr<std::vector<VlrEntry>> ListVlrs(const std::string& name, const LasHeader& header,
                                               std::string_view head) {
  std::vector<VlrEntry> entries;
  std::uint64_t next = header.header_size;
  for (std::uint32_t i = 0; i < header.vlr_count; ++i) {
    bool fits = next + kVlrHeaderSize <= head.size();
    VlrEntry entry;
    if (fits) {
      const std::string_view bytes = head.substr(next);
      entry = ParseCommon(bytes, next);
      entry.data_offset = next + kVlrHeaderSize;
      entry.data_size = Load<std::uint16_t>(bytes, kVlrLengthField);
      fits = entry.end() <= head.size();
    }
    if (!fits) {
      return absl::InvalidArgumentError(absl::StrCat(name, ": variable length record ", i + 1, " of ",
                                                     header.vlr_count, " at byte ", next,
                                                     " does not end before the points, at ", head.size(),
                                                     "; correct the number or the lengths of these records"));
    }
    next = entry.end();
    entries.push_back(std::move(entry));
  }
  return entries;
}

absl::StatusOr<VlrEntry> ParseEvlr(const std::string& name, std::string_view bytes, std::uint64_t offset,
                                   std::uint64_t file_size) {
  VlrEntry entry = ParseCommon(bytes, offset);
  entry.data_offset = offset + kEvlrHeaderSize;
  entry.data_size = Load<std::uint64_t>(bytes, kVlrLengthField);
  if (entry.data_offset > file_size || entry.data_size > file_size - entry.data_offset) {
    return absl::DataLossError(
        absl::StrCat(name, ": the extended variable length record at byte ", offset, " has ", entry.data_size,
                     " bytes and ends after the file, which has ", file_size, "; get a complete copy"));
  }
  return entry;
}

std::string VlrHeader(std::string_view user, std::uint16_t record_id, std::uint16_t data_size,
                      std::string_view description) {
  std::string bytes(kVlrHeaderSize, '\0');
  bytes.replace(kUserIdField, user.size(), user);
  Store(record_id, bytes.data() + kRecordIdField);
  Store(data_size, bytes.data() + kVlrLengthField);
  bytes.replace(kVlrDescriptionField, description.size(), description);
  return bytes;
}

}  // namespace albtpu::formats
