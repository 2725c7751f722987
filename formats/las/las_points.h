// The fields of LAS points from which pulses are made, and the number of points of each class.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "formats/las/las_header.h"
#include "formats/laz/coding/little_endian.h"

namespace albtpu::formats {

inline constexpr int kFirstModernFormat = 6;  // Formats 6-10 have a byte for the class and finer scan angles.
inline constexpr double kModernScanAngleStep = 0.006;  // degree
inline constexpr int kLegacyClassMask = 0x1F;          // Formats 0-5 have flags in the upper bits.
inline constexpr int kClassCount = 256;

// The class of bottom seen through water: 40 in the ASPRS LAS Domain Profile for Topo-Bathy Lidar, 26 in older files,
// whose classes end at 31.
constexpr int DefaultClass(int point_format) { return point_format >= kFirstModernFormat ? 40 : 26; }

// Reads the fields of records, which have the format that the header states.
class LasPointFields {
 public:
  explicit LasPointFields(const LasHeader& header)
      : modern_(header.point_format >= kFirstModernFormat),
        gps_time_(HasGpsTime(header.point_format) ? (modern_ ? 22 : 20) : 0),
        scale_(header.scale),
        offset_(header.offset) {}

  // In the units of the file's coordinates.
  double X(std::string_view record) const { return Coordinate(record, 0); }
  double Y(std::string_view record) const { return Coordinate(record, 1); }
  double Z(std::string_view record) const { return Coordinate(record, 2); }
  int Class(std::string_view record) const {
    return modern_ ? laz::Load<std::uint8_t>(record, 16)
                   : laz::Load<std::uint8_t>(record, 15) & kLegacyClassMask;
  }
  // Degrees, positive to the right of the flight direction.
  double ScanAngle(std::string_view record) const {
    return modern_ ? laz::Load<std::int16_t>(record, 18) * kModernScanAngleStep
                   : laz::Load<std::int8_t>(record, 16);
  }

  // Mostly the number of the flight line.
  int PointSourceId(std::string_view record) const {
    return laz::Load<std::uint16_t>(record, modern_ ? 20 : 18);
  }

  bool has_gps_time() const { return gps_time_ != 0; }
  // As the file states it. Requires has_gps_time().
  double GpsTime(std::string_view record) const { return laz::Load<double>(record, gps_time_); }

  // The number of this return in its pulse, the number of returns of the pulse and the channel of the scanner, which
  // formats 0-5 do not have.
  int ReturnNumber(std::string_view record) const {
    return laz::Load<std::uint8_t>(record, 14) & (modern_ ? 0xF : 0x7);
  }
  int ReturnCount(std::string_view record) const {
    const auto returns = laz::Load<std::uint8_t>(record, 14);
    return modern_ ? returns >> 4 : returns >> 3 & 0x7;
  }
  int ScannerChannel(std::string_view record) const {
    return modern_ ? laz::Load<std::uint8_t>(record, 15) >> 4 & 0x3 : 0;
  }

  // Whether two records of equal GPS times are returns of one pulse. Some files have times so coarse that several
  // pulses share one.
  bool OfOnePulse(std::string_view a, std::string_view b) const {
    const bool numbered = ReturnNumber(a) != 0 || ReturnNumber(b) != 0;
    return ReturnCount(a) == ReturnCount(b) && ScannerChannel(a) == ScannerChannel(b) &&
           (!numbered || ReturnNumber(a) != ReturnNumber(b));
  }

 private:
  double Coordinate(std::string_view record, std::size_t axis) const {
    return laz::Load<std::int32_t>(record, axis * sizeof(std::int32_t)) * scale_[axis] + offset_[axis];
  }

  bool modern_;
  std::size_t gps_time_;  // Offset in the record; 0: the format has none.
  std::array<double, 3> scale_, offset_;
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

}  // namespace albtpu::formats
