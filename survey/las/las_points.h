// The fields of LAS points from which pulses are made, and the number of points of each class.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "survey/las/las_header.h"
#include "survey/las/little_endian.h"

namespace albtpu::client {

inline constexpr int kFirstModernFormat = 6;  // Formats 6-10 have a byte for the class and finer scan angles.
inline constexpr double kModernScanAngleStep = 0.006;  // degree
inline constexpr int kLegacyClassMask = 0x1F;          // Formats 0-5 have flags in the upper bits.
inline constexpr int kClassCount = 256;

// Reads the fields of records, which have the format that the header states.
class LasPointFields {
 public:
  explicit LasPointFields(const LasHeader& header)
      : modern_(header.point_format >= kFirstModernFormat),
        scale_z_(header.scale_z),
        offset_z_(header.offset_z) {}

  // In the vertical unit of the file.
  double Z(std::string_view record) const { return Load<std::int32_t>(record, 8) * scale_z_ + offset_z_; }
  int Class(std::string_view record) const {
    return modern_ ? Load<std::uint8_t>(record, 16) : Load<std::uint8_t>(record, 15) & kLegacyClassMask;
  }
  // Degrees, positive to the right of the flight direction.
  double ScanAngle(std::string_view record) const {
    return modern_ ? Load<std::int16_t>(record, 18) * kModernScanAngleStep : Load<std::int8_t>(record, 16);
  }

 private:
  bool modern_;
  double scale_z_, offset_z_;
};

class LasClassCounts {
 public:
  void Add(int point_class) { ++counts_[point_class]; }
  void Merge(const LasClassCounts& other);

  std::uint64_t points() const;

  // "class 1: 12345 points, class 26: 4321 points": the choices for --classes.
  std::string Text() const;

  // {"1": 12345, "26": 4321}
  nlohmann::ordered_json Json() const;

 private:
  std::array<std::uint64_t, kClassCount> counts_ = {};
};

}  // namespace albtpu::client
