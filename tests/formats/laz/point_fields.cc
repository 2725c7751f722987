#include "tests/formats/laz/point_fields.h"

#include <cmath>
#include <cstring>

namespace albtpu::testing {
namespace {

// LAS is little-endian, like the machines that this runs on.
template <typename Number>
void Append(Number number, std::string& bytes) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

void AppendByte(std::uint32_t byte, std::string& bytes) { bytes.push_back(static_cast<char>(byte)); }

void AppendLegacyCore(const PointFields& point, std::string& bytes) {
  AppendByte((point.return_number & 7) | (point.return_count & 7) << 3 | point.scan_direction << 6 | point.edge << 7,
             bytes);
  AppendByte((point.classification & 31) | (point.flags & 7) << 5, bytes);
  AppendByte(static_cast<std::uint8_t>(std::lround(point.scan_angle * 0.006)), bytes);
  AppendByte(point.user_data, bytes);
  Append(point.source, bytes);
}

void AppendCore(const PointFields& point, std::string& bytes) {
  AppendByte((point.return_number & 15) | (point.return_count & 15) << 4, bytes);
  AppendByte((point.flags & 15) | (point.channel & 3) << 4 | point.scan_direction << 6 | point.edge << 7, bytes);
  AppendByte(point.classification, bytes);
  AppendByte(point.user_data, bytes);
  Append(point.scan_angle, bytes);
  Append(point.source, bytes);
}

void AppendWavePacket(const WavePacketFields& packet, std::string& bytes) {
  AppendByte(packet.descriptor, bytes);
  Append(packet.offset, bytes);
  Append(packet.size, bytes);
  Append(packet.return_location, bytes);
  for (const float component : packet.direction) Append(component, bytes);
}

}  // namespace

void AppendFields(const PointFields& point, int point_format, std::string& records) {
  Append(point.x, records);
  Append(point.y, records);
  Append(point.z, records);
  Append(point.intensity, records);
  point_format < 6 ? AppendLegacyCore(point, records) : AppendCore(point, records);
  if (point_format != 0 && point_format != 2) Append(point.time_bits, records);
  const bool has_colour = point_format == 2 || point_format == 3 || point_format == 5 || point_format == 7 ||
                          point_format == 8 || point_format == 10;
  const bool has_infrared = point_format == 8 || point_format == 10;
  for (int i = 0; i < (has_infrared ? 4 : has_colour ? 3 : 0); ++i) Append(point.colours[i], records);
  const bool has_wave_packet = point_format == 4 || point_format == 5 || point_format == 9 || point_format == 10;
  if (has_wave_packet) AppendWavePacket(point.wave_packet, records);
}

}  // namespace albtpu::testing
