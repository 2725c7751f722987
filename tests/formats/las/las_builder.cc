#include "tests/formats/las/las_builder.h"

#include <cmath>
#include <cstring>

namespace albtpu::testing {
namespace {

// LAS is little-endian, like the machines that this runs on.
template <typename Number>
void Put(std::string& bytes, std::size_t offset, Number number) {
  std::memcpy(bytes.data() + offset, &number, sizeof number);
}

void PutText(std::string& bytes, std::size_t offset, const std::string& text) {
  bytes.replace(offset, text.size(), text);
}

std::string Vlr(const LasRecord& record, bool extended) {
  std::string bytes(extended ? 60 : 54, '\0');
  PutText(bytes, 2, record.user_id);
  Put<std::uint16_t>(bytes, 18, record.record_id);
  if (extended)
    Put<std::uint64_t>(bytes, 20, record.data.size());
  else
    Put<std::uint16_t>(bytes, 20, static_cast<std::uint16_t>(record.data.size()));
  PutText(bytes, extended ? 28 : 22, "made by a test");
  return bytes + record.data;
}

std::string PointRecord(const LasSpec& spec, std::size_t index) {
  const LasPoint& point = spec.points[index];
  std::string bytes(PointSize(spec.point_format) + spec.extra_bytes, '\0');
  // A pattern without equal neighbours, so that a test notices bytes that move.
  for (std::size_t i = 12; i < bytes.size(); ++i) bytes[i] = static_cast<char>(index * 31 + i * 7);
  Put(bytes, 0, point.x);
  Put(bytes, 4, point.y);
  Put(bytes, 8, point.z);
  if (spec.point_format < 6) {
    Put<std::uint8_t>(bytes, 14, static_cast<std::uint8_t>(point.return_count << 3 | point.return_number));
    // The upper bits are flags (here: key point), not part of the class.
    Put<std::uint8_t>(bytes, 15,
                      static_cast<std::uint8_t>(0x40 | (point.withheld ? 0x80 : 0) | (point.synthetic ? 0x20 : 0) |
                                                (point.classification & 0x1F)));
    Put<std::int8_t>(bytes, 16, static_cast<std::int8_t>(std::lround(point.scan_angle)));
  } else {
    Put<std::uint8_t>(bytes, 14, static_cast<std::uint8_t>(point.return_count << 4 | point.return_number));
    Put<std::uint8_t>(bytes, 15, static_cast<std::uint8_t>((point.withheld ? 4 : 0) | (point.synthetic ? 1 : 0)));
    Put<std::uint8_t>(bytes, 16, static_cast<std::uint8_t>(point.classification));
    Put<std::int16_t>(bytes, 18, static_cast<std::int16_t>(std::lround(point.scan_angle / 0.006)));
  }
  const bool has_gps_time = spec.point_format != 0 && spec.point_format != 2;
  if (has_gps_time) Put<double>(bytes, spec.point_format < 6 ? 20 : 22, point.gps_time);
  if (point.point_source_id >= 0)
    Put(bytes, spec.point_format < 6 ? 18 : 20, static_cast<std::uint16_t>(point.point_source_id));
  return bytes;
}

}  // namespace

const char kMetricWkt[] =
    "PROJCS[\"WGS 84 / UTM zone 17N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
    "84\",6378137,298.257223563]],"
    "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
    "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",-81],PARAMETER[\"scale_factor\",0."
    "9996],"
    "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]";

std::size_t PointSize(int point_format) {
  constexpr std::size_t kSizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
  return kSizes[point_format];
}

std::string ExtraBytesEntry(std::uint8_t type, std::uint8_t options, const std::string& name) {
  std::string entry(192, '\0');
  Put(entry, 2, type);
  Put(entry, 3, options);
  PutText(entry, 4, name);
  return entry;
}

std::string GeoKeys(const std::vector<std::pair<int, int>>& keys) {
  std::vector<std::uint16_t> numbers = {1, 1, 0, static_cast<std::uint16_t>(keys.size())};
  for (const auto& [key, value] : keys)
    numbers.insert(numbers.end(), {static_cast<std::uint16_t>(key), 0, 1, static_cast<std::uint16_t>(value)});
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof numbers[0]};
}

std::string BuildLas(const LasSpec& spec) {
  constexpr std::size_t kHeaderSizes[] = {227, 227, 227, 235, 375, 393};
  const std::size_t own_size = kHeaderSizes[spec.version_minor];
  const std::size_t header_size = own_size + spec.header_tail.size();
  std::string vlrs, points, evlrs;
  for (const LasRecord& record : spec.vlrs) vlrs += Vlr(record, false);
  for (std::size_t i = 0; i < spec.points.size(); ++i) points += PointRecord(spec, i);
  for (const LasRecord& record : spec.evlrs) evlrs += Vlr(record, true);
  const std::size_t offset_to_points = header_size + vlrs.size() + spec.gap.size();
  const std::size_t end_of_points = offset_to_points + points.size();

  std::string header(own_size, '\0');
  PutText(header, 0, "LASF");
  const bool waveform_inside = !spec.waveform_packet.empty();
  // Bit 4: the coordinate system is well-known text, as formats 6-10 require. Bit 1: waveforms are in the file. Bit 0:
  // the form of GPS times.
  Put<std::uint16_t>(
      header, 6,
      static_cast<std::uint16_t>((spec.point_format >= 6 ? 0x10 : 0) | (waveform_inside ? 0x2 : 0) |
                                 (spec.adjusted_time ? 1 : 0) | (spec.time_offset.has_value() ? 0x40 : 0)));
  Put<std::uint8_t>(header, 24, 1);
  Put<std::uint8_t>(header, 25, static_cast<std::uint8_t>(spec.version_minor));
  PutText(header, 26, "SIMULATION");
  PutText(header, 58, "albtpu");
  Put<std::uint16_t>(header, 90, 1);  // Creation date: the first day of 2024, always.
  Put<std::uint16_t>(header, 92, 2024);
  Put<std::uint16_t>(header, 94, static_cast<std::uint16_t>(header_size));
  Put<std::uint32_t>(header, 96, static_cast<std::uint32_t>(offset_to_points));
  Put<std::uint32_t>(header, 100, static_cast<std::uint32_t>(spec.vlrs.size()));
  Put<std::uint8_t>(header, 104, static_cast<std::uint8_t>(spec.point_format));
  Put<std::uint16_t>(header, 105, static_cast<std::uint16_t>(PointSize(spec.point_format) + spec.extra_bytes));
  const bool legacy_count = spec.point_format < 6;
  const auto count = static_cast<std::uint32_t>(spec.points.size());
  Put<std::uint32_t>(header, 107, legacy_count ? count : 0);
  Put<std::uint32_t>(header, 111, legacy_count ? count : 0);
  for (const std::size_t axis : {0, 8, 16}) Put<double>(header, 131 + axis, spec.scale);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Put<double>(header, 155 + 8 * axis, spec.offset[axis]);
    double least = 0, greatest = 0;
    for (const LasPoint& point : spec.points) {
      const double value = (axis == 0 ? point.x : axis == 1 ? point.y : point.z) * spec.scale + spec.offset[axis];
      least = &point == &spec.points[0] ? value : std::fmin(least, value);
      greatest = &point == &spec.points[0] ? value : std::fmax(greatest, value);
    }
    Put<double>(header, 179 + 16 * axis, greatest);
    Put<double>(header, 187 + 16 * axis, least);
  }
  if (spec.version_minor >= 3 && waveform_inside) Put<std::uint64_t>(header, 227, end_of_points);
  if (spec.version_minor >= 4) {
    if (!spec.evlrs.empty()) Put<std::uint64_t>(header, 235, end_of_points + spec.waveform_packet.size());
    Put<std::uint32_t>(header, 243, static_cast<std::uint32_t>(spec.evlrs.size()));
    Put<std::uint64_t>(header, 247, count);
    Put<std::uint64_t>(header, 255, count);
  }
  if (spec.version_minor >= 5) {
    double least = 0, greatest = 0;  // Of times that are not 0.
    for (const LasPoint& point : spec.points) {
      if (point.gps_time == 0) continue;
      least = least == 0 ? point.gps_time : std::fmin(least, point.gps_time);
      greatest = greatest == 0 ? point.gps_time : std::fmax(greatest, point.gps_time);
    }
    Put<double>(header, 375, greatest);
    Put<double>(header, 383, least);
    Put<std::uint16_t>(header, 391, spec.time_offset.value_or(0));
  }
  return header + spec.header_tail + vlrs + spec.gap + points + spec.waveform_packet + evlrs;
}

}  // namespace albtpu::testing
