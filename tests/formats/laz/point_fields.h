// The fields of a point of any format, and their bytes in a LAS record, by the tables of the specification.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace albtpu::testing {

struct WavePacketFields {
  std::uint8_t descriptor = 0;
  std::uint64_t offset = 0;
  std::uint32_t size = 0;
  float return_location = 0;
  std::array<float, 3> direction{};
};

struct PointFields {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t intensity = 0;
  std::uint32_t return_number = 1, return_count = 1;  // Of which formats 0-5 have 3 bits, 6-10 have 4.
  bool scan_direction = false, edge = false;
  std::uint32_t classification = 0;  // 5 or 8 bits
  std::uint32_t flags = 0;           // 3 or 4 bits: synthetic, key point, withheld, overlap
  std::uint32_t channel = 0;         // 2 bits, in formats 6-10.
  std::int16_t scan_angle = 0;       // 0.006 degree; formats 0-5 have whole degrees.
  std::uint8_t user_data = 0;
  std::uint16_t source = 0;
  std::uint64_t time_bits = 0;             // Of a double, any.
  std::array<std::uint16_t, 4> colours{};  // red, green, blue, near infrared
  WavePacketFields wave_packet;
};

// Appends the fields that the format (0 to 10) has.
void AppendFields(const PointFields& point, int point_format, std::string& records);

}  // namespace albtpu::testing
