// Point records for tests of compression: points that use each field and each way in which fields change, and points of
// a plain flight line. A record is the same whenever it is made; the seed gives others of the same kind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace albtpu::testing {

struct RecordLayout {
  int point_format = 6;         // 0 to 10
  std::size_t extra_bytes = 0;  // After the fields of the format.
};

std::size_t RecordLength(const RecordLayout& layout);

// `count` records in which everything changes, as in no single survey: four scanner channels that take turns, several
// pulses in flight whose returns interleave, returns out of order, GPS times that repeat, jump and go back, twenty
// classes, all flags, scan angles of both signs, grey and coloured points of which single bytes change, wave packets
// that repeat, follow each other, or lie far apart, extra bytes that stay, count, or have any value. Stretches in which
// a field does not change lie between.
std::string BusyRecords(const RecordLayout& layout, std::size_t count, std::uint64_t seed = 1);

// `count` records of one flight line: scan lines to both sides, up to three returns of a pulse one after the other,
// times that grow by the time between two pulses, and fields that hardly change.
std::string CalmRecords(const RecordLayout& layout, std::size_t count, std::uint64_t seed = 1);

}  // namespace albtpu::testing
