// The fields of a LAS point that a pulse is made of.
#pragma once

#include <cstdint>
#include <string_view>

#include "survey/las/las_header.h"
#include "survey/las/little_endian.h"

namespace albtpu::client {

inline constexpr int kFirstModernFormat = 6;  // Formats 6-10 hold classes in a byte, finer scan angles.
inline constexpr double kModernScanAngleStep = 0.006;  // degree
inline constexpr int kLegacyClassMask = 0x1F;          // Formats 0-5 keep flags in the upper bits.
inline constexpr int kClassCount = 256;

// Reads records of one file.
class LasPointFields {
 public:
  explicit LasPointFields(const LasHeader& header)
      : modern_(header.point_format >= kFirstModernFormat),
        scale_z_(header.scale_z),
        offset_z_(header.offset_z) {}

  double Z(std::string_view record) const { return Load<std::int32_t>(record, 8) * scale_z_ + offset_z_; }
  int Class(std::string_view record) const {
    return modern_ ? Load<std::uint8_t>(record, 16) : Load<std::uint8_t>(record, 15) & kLegacyClassMask;
  }
  // Degrees, positive to the right of the flight.
  double ScanAngle(std::string_view record) const {
    return modern_ ? Load<std::int16_t>(record, 18) * kModernScanAngleStep : Load<std::int8_t>(record, 16);
  }

 private:
  bool modern_;
  double scale_z_, offset_z_;
};

}  // namespace albtpu::client
