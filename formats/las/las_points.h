// The points of LAS and LAZ files: the fields from which pulses are made, the number of points of each class, and runs
// of points read front to back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/clocks/trajectory_time.h"
#include "formats/las/las_header.h"
#include "formats/las/las_reader.h"
#include "laz/coding/little_endian.h"
#include "laz/laz_points.h"

namespace albtpu::formats {

// `count` times of a file, as its header states them.
PointTimes PointTimesOf(const LasHeader& header, const TimeSpan& span, std::uint64_t count);

inline constexpr int kFirstModernFormat = 6;           // Formats 6-10 have a byte for the class and finer scan angles.
inline constexpr double kModernScanAngleStep = 0.006;  // degree
inline constexpr int kLegacyClassMask = 0x1F;          // Formats 0-5 have flags in the upper bits.
inline constexpr int kClassCount = 256;
inline constexpr int kLowNoise = 7, kHighNoise = 18;  // ASPRS, LAS 1.4 R15, tables 8 and 17.

// The class of bottom seen through water: 40 in the ASPRS LAS Domain Profile for Topo-Bathy Lidar, 26 in older files,
// whose classes end at 31.
constexpr int DefaultClass(int point_format) { return point_format >= kFirstModernFormat ? 40 : 26; }

// The classes of points seen through water: that one, and submerged objects (43), which older classes do not tell
// apart.
inline std::set<int> DefaultClasses(int point_format) {
  return point_format >= kFirstModernFormat ? std::set<int>{40, 43} : std::set<int>{26};
}

// The classes that returns from the water surface usually have: ASPRS, LAS Domain Profile for Topo-Bathy Lidar; in
// older point formats water (9) and what NOAA used before.
inline std::set<int> UsualSurfaceClasses(int point_format) {
  return point_format >= kFirstModernFormat ? std::set<int>{41, 42} : std::set<int>{9, 27};
}

// The same and water (9): classes of points that are neither land nor under water.
inline std::set<int> WaterSurfaceClasses(int point_format) {
  std::set<int> classes = UsualSurfaceClasses(point_format);
  classes.insert(9);
  return classes;
}

// Points that are of the ground, and points that nobody classified: ASPRS 2 and, in older formats, 8, model key points
// of the ground; 0 and 1.
constexpr bool IsGround(int point_class, int point_format) {
  return point_class == 2 || (point_class == 8 && point_format < kFirstModernFormat);
}
constexpr bool IsUnclassified(int point_class) { return point_class <= 1; }

// Whether points of this class lie on land or on the water: neither noise nor under water. ASPRS, LAS Domain Profile
// for Topo-Bathy Lidar: 40 bottom, 43 submerged object, 44 object of S-57, 45 no bottom found, 46 overlapping bottom;
// in older point formats what NOAA used before.
constexpr bool MayBeDry(int point_class, int point_format) {
  if (point_class == kLowNoise || point_class == kHighNoise) return false;
  if (point_format < kFirstModernFormat) return point_class != 25 && point_class != 26;
  return point_class != 40 && (point_class < 43 || point_class > 46);
}

// Reads the fields of records, which have the format that the header states.
class LasPointFields {
 public:
  explicit LasPointFields(const LasHeader& header)
      : modern_(header.point_format >= kFirstModernFormat),
        gps_time_(HasGpsTime(header.point_format) ? (modern_ ? 22 : 20) : 0),
        scale_(header.scale),
        offset_(header.offset),
        time_shift_(header.time_shift) {}

  // In the units of the file's coordinates.
  double X(std::string_view record) const { return Coordinate(record, 0); }
  double Y(std::string_view record) const { return Coordinate(record, 1); }
  double Z(std::string_view record) const { return Coordinate(record, 2); }
  int Class(std::string_view record) const {
    return modern_ ? laz::Load<std::uint8_t>(record, 16) : laz::Load<std::uint8_t>(record, 15) & kLegacyClassMask;
  }
  // Degrees, positive to the right of the flight direction.
  double ScanAngle(std::string_view record) const {
    return modern_ ? laz::Load<std::int16_t>(record, 18) * kModernScanAngleStep : laz::Load<std::int8_t>(record, 16);
  }

  // The scan direction flag: whether the scanner moved from the right to the left. Not all software sets it.
  bool IsScannedBackwards(std::string_view record) const {
    return (laz::Load<std::uint8_t>(record, modern_ ? 15 : 14) >> 6 & 1) == 0;
  }

  // The flags of a class: a point that its producer took back, and one that no pulse measured.
  bool IsWithheld(std::string_view record) const { return HasFlag(record, 0x04, 0x80); }
  bool IsSynthetic(std::string_view record) const { return HasFlag(record, 0x01, 0x20); }

  int UserData(std::string_view record) const { return laz::Load<std::uint8_t>(record, 17); }
  // Mostly the number of the flight line.
  int PointSourceId(std::string_view record) const { return laz::Load<std::uint16_t>(record, modern_ ? 20 : 18); }

  bool has_gps_time() const { return gps_time_ != 0; }
  // In the form that the header states, less the time offset of LAS 1.5; 0 where the file has 0, which is no time.
  // Requires has_gps_time().
  double GpsTime(std::string_view record) const {
    const auto time = laz::Load<double>(record, gps_time_);
    return time == 0 ? time : time + time_shift_;
  }

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

  bool HasFlag(std::string_view record, unsigned modern, unsigned legacy) const {
    return (laz::Load<std::uint8_t>(record, 15) & (modern_ ? modern : legacy)) != 0;
  }

  bool modern_;
  std::size_t gps_time_;  // Offset in the record; 0: the format has none.
  std::array<double, 3> scale_, offset_;
  double time_shift_;  // s
};

// Which points of a file are those of one scanner.
struct ScannerPoints {
  std::set<int> channels, user_data;  // Empty: any.

  bool Has(const LasPointFields& fields, std::string_view record) const {
    return (channels.empty() || channels.contains(fields.ScannerChannel(record))) &&
           (user_data.empty() || user_data.contains(fields.UserData(record)));
  }
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

// The points of a LAS or LAZ file, read front to back in runs.

// A run of points, and neighbours that are needed to interpret them.
struct LasRun {
  std::uint64_t first = 0;          // Number in the file of the first own point.
  std::size_t before = 0, own = 0;  // Points.
  std::string records;              // Those before, the own ones, those after.
};

class LasPointRuns {
 public:
  // Each run has up to `before` points before its own, and up to `after` behind them. `reader` must outlive it. Fails
  // when the chunk table of LAZ contradicts the file. The points have at least the fields that are `wanted`.
  static absl::StatusOr<LasPointRuns> Open(const LasReader& reader, std::size_t before, std::size_t after,
                                           laz::WantedFields wanted = laz::WantedFields::kAll);

  // The next run, of at most `most` own points, into `run`, whose memory is used again. False after the last one.
  absl::StatusOr<bool> Next(std::uint64_t most, LasRun& run);

  // The compressed chunk that has the own points of a run and no others. Empty if the file has no such chunk. Any
  // number of threads may call it at a time.
  absl::StatusOr<std::string> ReadChunk(const LasRun& run) const;

  // Once all points are read: what follows them in the file (in LAZ, them and their chunk table).
  std::uint64_t tail_begin() const;
  std::uint64_t tail_end() const;

 private:
  LasPointRuns(const LasReader& reader, std::size_t before, std::size_t after)
      : reader_(reader), before_(before), after_(after) {}
  absl::Status ReadLaz(std::uint64_t begin, std::uint64_t end, LasRun& run);

  const LasReader& reader_;
  std::size_t before_, after_;
  std::uint64_t next_ = 0;               // First own point of the next run.
  std::unique_ptr<laz::LazPoints> laz_;  // Null for LAS.
  std::string last_;                     // Records of the last run that the next one has, too.
};

// The first point. Requires that the file has one.
absl::StatusOr<std::string> FirstRecord(const LasReader& reader);

}  // namespace albtpu::formats
