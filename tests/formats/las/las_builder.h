// Builds LAS files for tests, of any version and point format and with any extra bytes and records, valid or not. It
// follows the specification and shares no code with our reader.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace albtpu::testing {

inline constexpr int kBottom = 40, kSurface = 41;  // Classes of points with a bathymetric domain profile.

struct LasPoint {
  std::int32_t x = 0, y = 0, z = 0;  // In steps of LasSpec::scale.
  int classification = 0;
  double scan_angle = 0;  // degree, rounded to the resolution of the format
  double gps_time = 0;    // In formats that have it.
  int return_number = 1, return_count = 1;
  int point_source_id = -1;  // -1: the pattern of LasSpec::extra_bytes in place of it.
  bool withheld = false, synthetic = false;
};

struct LasRecord {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::string data;
};

struct LasSpec {
  int version_minor = 4;
  int point_format = 6;
  std::vector<LasPoint> points;
  std::size_t extra_bytes = 0;         // In each record, after the fields of its format; filled with a pattern.
  std::vector<LasRecord> vlrs, evlrs;  // EVLRs only in 1.4.
  std::string header_tail;             // Bytes after the fields of the header, counted in its size.
  std::string gap;                     // Bytes between the VLRs and the points.
  std::string waveform_packet;         // After the points; the header states its offset (from 1.3).
  double scale = 0.001;
  std::array<double, 3> offset{};                 // Of x, y and z.
  bool adjusted_time = false;                     // Times are GPS time - 1e9 s; otherwise seconds of the GPS week.
  std::optional<std::uint16_t> time_offset = {};  // Of 1.5, 10^6 s, with its flag; requires adjusted_time.
};

std::string BuildLas(const LasSpec& spec);

// Bytes of a record without extra bytes, from the tables of the specification.
std::size_t PointSize(int point_format);

// An entry of an Extra Bytes record, 192 bytes.
std::string ExtraBytesEntry(std::uint8_t type, std::uint8_t options, const std::string& name);

// The data of a record 34735 (OGC GeoTIFF 1.1): keys with their values.
std::string GeoKeys(const std::vector<std::pair<int, int>>& keys);

// The well-known text of a coordinate system in metres.
extern const char kMetricWkt[];

}  // namespace albtpu::testing
