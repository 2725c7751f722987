#include "formats/las/las_header.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"
#include "laz/coding/little_endian.h"
#include "laz/items/laszip_record.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

using laz::Load;

// LAS Specification 1.4 R15, tables 6-17.
constexpr std::array<std::size_t, kLargestPointFormat + 1> kRecordLengths = {20, 28, 26, 34, 57, 63,
                                                                             30, 36, 38, 59, 67};
// By the minor version: the first and the last point format that LAS 1.0 to 1.5 define.
constexpr std::array<int, 6> kFirstFormats = {0, 0, 0, 0, 0, 6};
constexpr std::array<int, 6> kLastFormats = {1, 1, 3, 5, 10, 10};
constexpr std::array<std::size_t, 6> kHeaderSizes = {227, 227, 227, 235, 375, kLargestLasHeader};

// The other upper bit of the point format, which the first LASzip set.
constexpr int kOldCompressedFlag = 0x40;
// Bits of the global encoding.
constexpr std::uint16_t kAdjustedGpsTime = 0x1;
constexpr std::uint16_t kWaveformInside = 0x2;
constexpr std::uint16_t kWaveformOutside = 0x4;
constexpr std::uint16_t kCrsIsWkt = 0x10;
constexpr std::uint16_t kHasTimeOffset = 0x40;

constexpr double kAdjustment = 1e9;        // s, of adjusted standard GPS time.
constexpr double kUnitOfTimeOffset = 1e6;  // s

absl::Status Truncated(const std::string& name, const std::string& message) {
  return absl::DataLossError(absl::StrCat(name, ": ", message));
}

absl::Status CheckVersion(const std::string& name, std::string_view bytes) {
  if (bytes.size() < 4 || bytes.substr(0, 4) != "LASF")
    return InvalidFile(name, "is not a LAS file (it does not begin with 'LASF'); give a .las or .laz file");
  if (bytes.size() < kHeaderSizes[0])
    return Truncated(name, absl::StrCat("ends after ", bytes.size(), " bytes, inside its header; get a complete copy"));
  const int major = Load<std::uint8_t>(bytes, las_field::kVersionMajor);
  const int minor = Load<std::uint8_t>(bytes, las_field::kVersionMinor);
  if (major != 1 || minor > 5) {
    return InvalidFile(name, absl::StrCat("is LAS ", major, ".", minor,
                                          " (expected 1.0 to 1.5); convert it by `las2las -set_version 1.4` or "
                                          "`pdal translate --writers.las.minor_version=4`"));
  }
  return absl::OkStatus();
}

// LAS 1.4 has a 64-bit point count and, for the old point formats, the same count in the legacy 32-bit field.
absl::StatusOr<std::uint64_t> PointCount(const std::string& name, std::string_view bytes, int version_minor) {
  const std::uint64_t legacy = Load<std::uint32_t>(bytes, las_field::kLegacyPointCount);
  if (version_minor < 4) return legacy;
  const auto count = Load<std::uint64_t>(bytes, las_field::kPointCount);
  if (legacy != 0 && legacy != count) {
    return InvalidFile(name, absl::StrCat("its header states ", count, " points, but ", legacy,
                                          " in the legacy field; expected the same number, or 0 in the legacy field"));
  }
  return count;
}

absl::Status CheckRecords(const std::string& name, const LasHeader& header) {
  const int first_format = kFirstFormats[header.version_minor], last_format = kLastFormats[header.version_minor];
  if (header.point_format < first_format || header.point_format > last_format) {
    return InvalidFile(name, absl::StrCat("has point format ", header.point_format, " in LAS 1.", header.version_minor,
                                          "; expected ", first_format, " to ", last_format));
  }
  const std::size_t minimum = MinimumRecordLength(header.point_format);
  if (header.record_length < minimum) {
    return InvalidFile(name, absl::StrCat("has point records of ", header.record_length, " bytes; point format ",
                                          header.point_format, " needs ", minimum, " or more"));
  }
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis) {
    const double scale = header.scale[axis], offset = header.offset[axis];
    if (std::abs(scale) >= kLeastScale && std::abs(scale) <= kGreatestScale && std::abs(offset) <= kGreatestOffset)
      continue;
    return InvalidFile(name, absl::StrCat("has ", std::string(1, "xyz"[axis]), " scale ", scale, " and offset ", offset,
                                          "; expected a scale from ", kLeastScale, " to ", kGreatestScale,
                                          " and an offset of at most ", kGreatestOffset, ": correct the header"));
  }
  return absl::OkStatus();
}

// What the header says of times: seconds of the week, GPS seconds - 1e9, or in LAS 1.5 GPS seconds less an offset.
absl::Status ReadTimes(const std::string& name, std::string_view bytes, std::uint16_t encoding, LasHeader& header) {
  header.adjusted_gps_time = (encoding & kAdjustedGpsTime) != 0;
  const bool has_offset = (encoding & kHasTimeOffset) != 0;
  if (header.version_minor == 4 && has_offset) {
    return InvalidFile(
        name,
        "its global encoding has the time offset flag of LAS 1.5 (bit 6), but it is LAS 1.4, which has no "
        "time offset; correct the version or the flag");
  }
  if (header.version_minor < 5) return absl::OkStatus();
  const double offset = Load<std::uint16_t>(bytes, las_field::kTimeOffset) * kUnitOfTimeOffset;
  if (has_offset && !header.adjusted_gps_time) {
    return InvalidFile(
        name,
        "its global encoding has the time offset flag (bit 6) without that of standard GPS time (bit 0); "
        "set both, or neither for seconds of the week");
  }
  const bool means_nothing = offset == 0 || (header.adjusted_gps_time && offset == kAdjustment);
  if (!has_offset && !means_nothing) {
    return InvalidFile(name,
                       absl::StrCat("its header states a time offset of ", offset,
                                    " s, but its global encoding lacks the time offset flag (bit 6); set the flag, "
                                    "or the offset to 0"));
  }
  if (has_offset) header.time_shift = offset - kAdjustment;
  return absl::OkStatus();
}

absl::Status CheckOffsets(const std::string& name, const LasHeader& header, std::uint64_t file_size) {
  const std::size_t min_header = kHeaderSizes[header.version_minor];
  if (header.header_size < min_header) {
    return InvalidFile(name, absl::StrCat("has header size ", header.header_size, "; LAS 1.", header.version_minor,
                                          " needs ", min_header, " bytes or more"));
  }
  if (header.offset_to_points < header.header_size) {
    return InvalidFile(
        name, absl::StrCat("its point records begin at byte ", header.offset_to_points, ", inside the header of ",
                           header.header_size, " bytes; expected them after it"));
  }
  if (header.offset_to_points > file_size) {
    return Truncated(name, absl::StrCat("its point records begin at byte ", header.offset_to_points,
                                        ", but the file has only ", file_size, "; get a complete copy"));
  }
  if (header.compressed) return absl::OkStatus();
  const std::uint64_t room = (file_size - header.offset_to_points) / header.record_length;
  if (header.point_count > room) {
    return Truncated(name, absl::StrCat("its header states ", header.point_count, " points, but the file has ", room,
                                        " (truncated, or the header is wrong); get a complete copy"));
  }
  return absl::OkStatus();
}

// Not all writers of waveforms set the bit that says where they are.
void FindWaveforms(std::string_view bytes, std::uint16_t global_encoding, std::uint64_t file_size, LasHeader& header) {
  if (header.version_minor < 3) return;
  const auto start = Load<std::uint64_t>(bytes, las_field::kStartOfWaveformPacket);
  const int format = header.point_format;
  const bool has_waves = format == 4 || format == 5 || format == 9 || format == 10;
  const std::uint64_t least = header.compressed ? header.offset_to_points : header.end_of_points();
  const bool may_be_inside = has_waves && (global_encoding & kWaveformOutside) == 0 && start >= least &&
                             start > header.offset_to_points && start < file_size;
  if ((global_encoding & kWaveformInside) != 0 || may_be_inside) header.start_of_waveform_packet = start;
}

// The header must state everything that follows the points: points beyond its count would be lost.
absl::Status CheckAfterPoints(const std::string& name, const LasHeader& header, std::uint64_t file_size) {
  const std::uint64_t end_of_points = header.compressed ? header.offset_to_points : header.end_of_points();
  std::uint64_t next = file_size;
  for (const auto& [start, what] : {std::pair(header.start_of_evlrs, "extended variable length records"),
                                    std::pair(header.start_of_waveform_packet, "waveform packets")}) {
    if (start == 0) continue;
    if (start < end_of_points || start > file_size) {
      return InvalidFile(name, absl::StrCat("its ", what, " begin at byte ", start, "; expected between the ",
                                            header.compressed ? "beginning" : "end", " of the points, ", end_of_points,
                                            ", and the end of the file, ", file_size));
    }
    next = std::min(next, start);
  }
  if (header.compressed) return absl::OkStatus();
  const std::uint64_t uncounted = next - end_of_points;
  if (uncounted >= header.record_length) {
    return InvalidFile(
        name, absl::StrCat("its header states ", header.point_count, " points, but ", uncounted, " bytes, enough for ",
                           uncounted / header.record_length, " more points, follow them; correct the point count"));
  }
  return absl::OkStatus();
}

}  // namespace

std::size_t MinimumRecordLength(int point_format) { return kRecordLengths[point_format]; }

std::size_t LasHeader::extra_bytes() const { return record_length - MinimumRecordLength(point_format); }

absl::StatusOr<LasHeader> ParseLasHeader(const std::string& name, std::string_view bytes, std::uint64_t file_size) {
  RETURN_IF_ERROR(CheckVersion(name, bytes));
  LasHeader header;
  header.version_minor = Load<std::uint8_t>(bytes, las_field::kVersionMinor);
  const std::size_t min_header = kHeaderSizes[header.version_minor];
  if (bytes.size() < min_header)
    return Truncated(name, absl::StrCat("ends after ", bytes.size(), " bytes, inside its header; get a complete copy"));
  header.creation_day = Load<std::uint16_t>(bytes, las_field::kCreationDay);
  header.creation_year = Load<std::uint16_t>(bytes, las_field::kCreationYear);
  header.header_size = Load<std::uint16_t>(bytes, las_field::kHeaderSize);
  header.offset_to_points = Load<std::uint32_t>(bytes, las_field::kOffsetToPoints);
  header.vlr_count = Load<std::uint32_t>(bytes, las_field::kVlrCount);
  header.point_format = Load<std::uint8_t>(bytes, las_field::kPointFormat);
  header.record_length = Load<std::uint16_t>(bytes, las_field::kRecordLength);
  for (std::size_t axis = 0; axis < header.scale.size(); ++axis) {
    header.scale[axis] = Load<double>(bytes, las_field::kScale + axis * sizeof(double));
    header.offset[axis] = Load<double>(bytes, las_field::kOffset + axis * sizeof(double));
    header.greatest[axis] = Load<double>(bytes, las_field::kBounds + 2 * axis * sizeof(double));
    header.least[axis] = Load<double>(bytes, las_field::kBounds + (2 * axis + 1) * sizeof(double));
  }
  if ((header.point_format & kOldCompressedFlag) != 0) {
    return InvalidFile(name,
                       "is compressed by a LASzip from before 2.0 (2011); decompress it first, by "
                       "`laszip -i IN.laz -o OUT.las`");
  }
  header.compressed = (header.point_format & laz::kCompressedFlag) != 0;
  header.point_format &= ~laz::kCompressedFlag;
  ASSIGN_OR_RETURN(header.point_count, PointCount(name, bytes, header.version_minor));
  // Before 1.2 these bytes are reserved, and times are seconds of the week.
  const std::uint16_t global_encoding =
      header.version_minor >= 2 ? Load<std::uint16_t>(bytes, las_field::kGlobalEncoding) : 0;
  RETURN_IF_ERROR(ReadTimes(name, bytes, global_encoding, header));
  if (header.version_minor >= 4) {
    header.crs_is_wkt = (global_encoding & kCrsIsWkt) != 0;
    header.evlr_count = Load<std::uint32_t>(bytes, las_field::kEvlrCount);
    if (header.evlr_count > 0) header.start_of_evlrs = Load<std::uint64_t>(bytes, las_field::kStartOfEvlrs);
    if (header.evlr_count > 0 && header.start_of_evlrs == 0) {
      return InvalidFile(name, absl::StrCat("its header states ", header.evlr_count,
                                            " extended variable length records but not where they begin; expected an "
                                            "offset after the points"));
    }
  }
  RETURN_IF_ERROR(CheckRecords(name, header));
  RETURN_IF_ERROR(CheckOffsets(name, header, file_size));
  FindWaveforms(bytes, global_encoding, file_size, header);
  RETURN_IF_ERROR(CheckAfterPoints(name, header, file_size));
  return header;
}

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

bool MustBeCounted(const VlrEntry& entry) {
  return entry.user_id.starts_with("LASF_") || entry.user_id == laz::kLaszipUser || entry.user_id == kCompatibleUser;
}

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
      return absl::InvalidArgumentError(absl::StrCat(
          name, ": variable length record ", i + 1, " of ", header.vlr_count, " at byte ", next,
          " does not end before the points, at ", head.size(), "; correct the number or the lengths of these records"));
    }
    next = entry.end();
    entries.push_back(std::move(entry));
  }
  if (next + kVlrHeaderSize > head.size()) return entries;
  const VlrEntry more = ParseCommon(head.substr(next), next);
  const std::uint64_t end = next + kVlrHeaderSize + Load<std::uint16_t>(head.substr(next), kVlrLengthField);
  if (MustBeCounted(more) && end <= head.size()) {
    return absl::InvalidArgumentError(absl::StrCat(name, ": its header counts ", header.vlr_count,
                                                   " variable length records, but another follows at byte ", next, " (",
                                                   more.user_id, " ", more.record_id, "); correct the number"));
  }
  return entries;
}

absl::StatusOr<VlrEntry> ParseEvlr(const std::string& name, std::string_view bytes, std::uint64_t offset,
                                   std::uint64_t file_size) {
  VlrEntry entry = ParseCommon(bytes, offset);
  entry.data_offset = offset + kEvlrHeaderSize;
  entry.data_size = Load<std::uint64_t>(bytes, kVlrLengthField);
  if (entry.data_offset > file_size || entry.data_size > file_size - entry.data_offset) {
    return absl::DataLossError(absl::StrCat(name, ": the extended variable length record at byte ", offset, " has ",
                                            entry.data_size, " bytes and ends after the file, which has ", file_size,
                                            "; get a complete copy"));
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
