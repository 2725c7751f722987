// The public header block of LAS 1.0 to 1.5 (ASPRS, LAS Specification 1.4 R15, table 3, and 1.5 R00), the sizes of
// point records, and variable length records. LAZ files have the same header.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace albtpu::formats {

// Offsets of the fields in the header, in bytes.
namespace las_field {
inline constexpr std::size_t kGlobalEncoding = 6;           // u16, from 1.2
inline constexpr std::size_t kVersionMajor = 24;            // u8
inline constexpr std::size_t kVersionMinor = 25;            // u8
inline constexpr std::size_t kCreationDay = 90;             // u16, of the year, from 1
inline constexpr std::size_t kCreationYear = 92;            // u16
inline constexpr std::size_t kHeaderSize = 94;              // u16
inline constexpr std::size_t kOffsetToPoints = 96;          // u32
inline constexpr std::size_t kVlrCount = 100;               // u32
inline constexpr std::size_t kPointFormat = 104;            // u8
inline constexpr std::size_t kRecordLength = 105;           // u16
inline constexpr std::size_t kLegacyPointCount = 107;       // u32
inline constexpr std::size_t kScale = 131;                  // 3 f64: x, y, z
inline constexpr std::size_t kOffset = 155;                 // 3 f64
inline constexpr std::size_t kBounds = 179;                 // 6 f64: maximum and minimum x, then y, then z
inline constexpr std::size_t kStartOfWaveformPacket = 227;  // u64, from 1.3
inline constexpr std::size_t kStartOfEvlrs = 235;           // u64, from 1.4
inline constexpr std::size_t kEvlrCount = 243;              // u32, from 1.4
inline constexpr std::size_t kPointCount = 247;             // u64, from 1.4
inline constexpr std::size_t kTimeBounds = 375;             // 2 f64: greatest and least GPS time, from 1.5
inline constexpr std::size_t kTimeOffset = 391;             // u16, 10^6 s, from 1.5
}  // namespace las_field

inline constexpr std::size_t kLargestLasHeader = 393;  // Bytes in 1.5; 227 up to 1.2, 235 in 1.3, 375 in 1.4.
inline constexpr int kLargestPointFormat = 10;

struct LasHeader {
  int version_minor = 4;
  std::uint16_t header_size = 0;                      // May be larger than the version requires; the rest is kept.
  std::uint16_t creation_day = 0, creation_year = 0;  // The day counts from 1 in its year; 0: not stated.
  std::uint32_t offset_to_points = 0;
  std::uint32_t vlr_count = 0;
  int point_format = 0;
  bool compressed = false;  // LAZ.
  std::uint16_t record_length = 0;
  std::uint64_t point_count = 0;
  bool adjusted_gps_time = false;  // Times are GPS seconds - 1e9, not seconds of the week; once `time_shift` is added.
  // s, of the time offset of LAS 1.5: what is added to a time of a record to make it GPS seconds - 1e9.
  double time_shift = 0;
  bool crs_is_wkt = false;                          // Well-known text states the coordinate system, not GeoTIFF keys.
  std::array<double, 3> scale = {};                 // x, y, z; of a magnitude from kLeastScale to kGreatestScale.
  std::array<double, 3> offset = {};                // At most kGreatestOffset in magnitude.
  std::array<double, 3> least = {}, greatest = {};  // The bounds that the file states, true or not.
  std::uint64_t start_of_waveform_packet = 0;       // 0: none in this file.
  std::uint64_t start_of_evlrs = 0;                 // 0: none.
  std::uint32_t evlr_count = 0;

  std::size_t extra_bytes() const;       // In a point record, after the fields of its format.
  std::uint64_t end_of_points() const {  // Of LAS.
    return offset_to_points + point_count * record_length;
  }
};

// In units of the coordinates. A degree has 1e-12 as 0.1 um; steps of more than 10 m or feet measure nothing.
inline constexpr double kLeastScale = 1e-12, kGreatestScale = 10;
inline constexpr double kGreatestOffset = 1e11;  // The circumference of the earth is 4e10 mm.

// Whether records of this format have a GPS time: formats 1 and 3 to 10.
constexpr bool HasGpsTime(int point_format) { return point_format != 0 && point_format != 2; }

// Bytes of a point record without extra bytes, for formats 0 to 10.
std::size_t MinimumRecordLength(int point_format);

// Reads the header and checks that it is consistent with itself and with the size of the file, so that all its offsets
// lie inside the file. Where the points of LAZ end is not known here: what follows is only known to lie behind their
// beginning. `bytes` is the beginning of the file: kLargestLasHeader bytes or more, or the whole file. `name`
// begins the messages. InvalidArgument: not LAS, not LAS 1.0-1.5, or an inconsistent header. DataLoss:
// truncated.
absl::StatusOr<LasHeader> ParseLasHeader(const std::string& name, std::string_view bytes, std::uint64_t file_size);

// Variable length records of a LAS file: VLRs between the header and the points, extended ones (EVLRs) after the
// points.

inline constexpr std::size_t kVlrHeaderSize = 54;
inline constexpr std::size_t kEvlrHeaderSize = 60;
inline constexpr std::size_t kVlrLengthField = 20;  // u16 in a VLR, u64 in an EVLR: bytes after its header.

// The identity of a record and its position in the file.
struct VlrEntry {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::uint64_t offset = 0;       // Of its header.
  std::uint64_t data_offset = 0;  // Of the data after its header.
  std::uint64_t data_size = 0;

  std::uint64_t end() const { return data_offset + data_size; }
  bool Is(std::string_view user, std::uint16_t record) const { return user_id == user && record_id == record; }
};

// Records that the LAS specification defines.
inline constexpr std::string_view kSpecUser = "LASF_Spec";
inline constexpr std::uint16_t kExtraBytesRecord = 4;

// The user of the record of LASzip's compatibility mode: points of formats 6 to 10 in the form of formats 1 to 5.
inline constexpr std::string_view kCompatibleUser = "lascompatible";

// The VLRs in `head`, which has all bytes before the points. Fails when they extend beyond it, and when a record of
// the specification or of LASzip follows them that the header does not count.
absl::StatusOr<std::vector<VlrEntry>> ListVlrs(const std::string& name, const LasHeader& header, std::string_view head);

// Whether the points are read wrong without records of this user: those of the specification ("LASF_") and of LASzip.
// Bytes of this form lie behind the records that a header counts only where it counts too few.
bool MustBeCounted(const VlrEntry& entry);

// The EVLR whose header is `bytes`, at `offset`. Fails when it extends beyond the file.
absl::StatusOr<VlrEntry> ParseEvlr(const std::string& name, std::string_view bytes, std::uint64_t offset,
                                   std::uint64_t file_size);

// The header of a VLR for `data_size` bytes of data.
std::string VlrHeader(std::string_view user, std::uint16_t record_id, std::uint16_t data_size,
                      std::string_view description);

}  // namespace albtpu::formats
