// LAS files made from a description, written from the specification and not from our reader: so a test can
// have any version, point format, extra bytes and records, right or wrong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace albtpu::testing {

struct LasPoint {
  std::int32_t x = 0, y = 0, z = 0;  // In steps of LasSpec::scale.
  int classification = 0;
  double scan_angle = 0;  // degree, rounded to what the format holds
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
  std::size_t extra_bytes = 0;         // Of each record, behind its format; filled with a pattern.
  std::vector<LasRecord> vlrs, evlrs;  // EVLRs: 1.4 only.
  std::string header_tail;             // Behind the header of the version, part of its size.
  std::string gap;                     // Between the VLRs and the points.
  std::string waveform_packet;         // Behind the points, pointed to by the header (from 1.3).
  double scale = 0.001;
};

std::string BuildLas(const LasSpec& spec);

// Bytes of a record without extra bytes, by the specification's tables.
std::size_t PointSize(int point_format);

// An entry of an Extra Bytes record: 192 bytes.
std::string ExtraBytesEntry(std::uint8_t type, std::uint8_t options, const std::string& name);

// A well-known text of a coordinate system in metres.
extern const char kMetricWkt[];

}  // namespace albtpu::testing
