#include "formats/las/las_crs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "formats/las/las_header.h"
#include "formats/las/las_points.h"
#include "formats/las/wkt_records.h"
#include "formats/text/text.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

using laz::Load;

constexpr std::uint16_t kGeoKeyDirectoryRecord = 34735, kGeoDoubleParamsRecord = 34736;

// Every foot in use (international, US survey, Clarke's, British, Indian, Gold Coast) lies between these limits, in
// metres; no other unit of length or angle does.
constexpr double kShortestFoot = 0.304;
constexpr double kLongestFoot = 0.306;

// GeoTIFF 1.1: keys for the units of projected coordinates, of heights and of geocentric coordinates.
constexpr std::uint16_t kProjLinearUnits = 3076;
constexpr std::uint16_t kVerticalUnits = 4099;

// GeoTIFF 1.1: keys whose values are codes of coordinate systems, and the values that are no codes.
constexpr std::uint16_t kGeographic = 2048;
constexpr std::uint16_t kProjected = 3072;
constexpr std::uint16_t kVertical = 4096;
constexpr std::uint16_t kEllipsoid = 2056;
constexpr std::uint16_t kUndefined = 0;
constexpr std::uint16_t kUserDefined = 32767;

// GeoTIFF 1.0: keys of a projection without code, and of its ellipsoid.
constexpr std::uint16_t kAngularUnits = 2054, kSemiMajor = 2057, kSemiMinor = 2058, kInverseFlattening = 2059;
constexpr std::uint16_t kPrimeMeridian = 2061;
constexpr std::uint16_t kProjection = 3074, kTransformation = 3075;
constexpr std::uint16_t kOriginLongitude = 3080, kOriginLatitude = 3081, kFalseEasting = 3082, kFalseNorthing = 3083;
constexpr std::uint16_t kScaleAtOrigin = 3092;
constexpr std::uint16_t kDegrees = 9102, kMethodTransverseMercator = 1;
// Codes of projections: 16000 and the zone for UTM on the northern hemisphere, 16100 and the zone on the southern.
constexpr std::uint16_t kUtmNorth = 16000, kUtmSouth = 16100, kUtmZones = 60;

// EPSG codes of feet: 9002 international, 9003 US survey, 9005 Clarke, 9041, 9051 and 9070 British, 9080-9083 Indian,
// 9094 Gold Coast, 9095 British 1936; GeoTIFF 1.0 also had 9004 (modified American) and 9006 (Indian).
bool IsFoot(std::uint16_t unit) {
  return (unit >= 9002 && unit <= 9006) || unit == 9041 || unit == 9051 || unit == 9070 ||
         (unit >= 9080 && unit <= 9083) || unit == 9094 || unit == 9095;
}

// A key with its value in the entry; values elsewhere are texts and real numbers.
struct GeoKey {
  std::uint16_t key = 0, value = 0;
};

// An entry has four u16: key, location of the value (0: in the entry), count, value. The first entry is a header.

// The real number of a key, by its place in the record of real numbers.
std::optional<double> RealOf(std::uint16_t key, std::string_view directory, std::string_view reals) {
  constexpr std::size_t kEntry = 8;
  for (std::size_t begin = kEntry; begin + kEntry <= directory.size(); begin += kEntry) {
    if (Load<std::uint16_t>(directory, begin) != key) continue;
    if (Load<std::uint16_t>(directory, begin + 2) != kGeoDoubleParamsRecord) continue;
    const std::size_t at = sizeof(double) * Load<std::uint16_t>(directory, begin + 6);
    if (at + sizeof(double) > reals.size()) return std::nullopt;
    const double value = Load<double>(reals, at);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  return std::nullopt;
}

std::vector<GeoKey> ListGeoKeys(std::string_view directory) {
  constexpr std::size_t kEntry = 8;
  std::vector<GeoKey> keys;
  for (std::size_t begin = kEntry; begin + kEntry <= directory.size(); begin += kEntry) {
    if (Load<std::uint16_t>(directory, begin + 2) != 0) continue;
    keys.push_back({Load<std::uint16_t>(directory, begin), Load<std::uint16_t>(directory, begin + 6)});
  }
  return keys;
}

}  // namespace

std::optional<std::string> FindFeetInWkt(std::string_view wkt) {
  const std::string upper = absl::AsciiStrToUpper(absl::string_view(wkt.data(), wkt.size()));
  // UNIT of WKT 1 and 2, LENGTHUNIT of WKT 2. The search also finds ANGLEUNIT, which is never a foot.
  for (std::size_t at = upper.find("UNIT"); at != std::string::npos; at = upper.find("UNIT", at + 1)) {
    const std::size_t open = upper.find_first_not_of(" \t\r\n", at + 4);
    if (open == std::string::npos || (upper[open] != '[' && upper[open] != '(')) continue;
    // The name must follow immediately: a further search would take time quadratic in the length of the text.
    const std::size_t name_begin = upper.find_first_not_of(" \t\r\n", open + 1);
    if (name_begin == std::string::npos) break;
    if (upper[name_begin] != '"') continue;
    const std::size_t name_end = upper.find('"', name_begin + 1);
    if (name_end == std::string::npos) break;
    const std::string name = upper.substr(name_begin + 1, name_end - name_begin - 1);
    bool foot = name.find("FOOT") != std::string::npos || name.find("FEET") != std::string::npos || name == "FT" ||
                name == "FTUS" || name == "US-FT";
    const std::size_t comma = upper.find_first_not_of(" \t\r\n", name_end + 1);
    if (comma != std::string::npos && upper[comma] == ',') {
      const std::size_t end = std::min(upper.find_first_of(",])", comma + 1), upper.size());
      const std::optional<double> metres = ParseDouble(upper.substr(comma + 1, end - comma - 1));
      foot = foot || (metres.has_value() && *metres > kShortestFoot && *metres < kLongestFoot);
    }
    if (foot) return absl::StrCat("unit \"", std::string(wkt.substr(name_begin + 1, name.size())), "\"");
  }
  return std::nullopt;
}

std::optional<std::string> FindFeetInGeoKeys(std::string_view geo_key_directory) {
  for (const GeoKey& entry : ListGeoKeys(geo_key_directory))
    if ((entry.key == kProjLinearUnits || entry.key == kVerticalUnits) && IsFoot(entry.value))
      return absl::StrCat("GeoTIFF key ", entry.key, " = ", entry.value);
  return std::nullopt;
}

namespace {

// A projection of the file's own, if all that it needs is stated. Angles in another unit than degrees are not read.
UserProjection OwnProjection(std::string_view directory, std::string_view reals, int geographic) {
  UserProjection own;
  bool is_transverse_mercator = false;
  for (const GeoKey& entry : ListGeoKeys(directory)) {
    const int zone = entry.value % 100;
    const bool has_zone = zone >= 1 && zone <= kUtmZones;
    if (entry.key == kAngularUnits && entry.value != kDegrees) return {};
    if (entry.key == kProjection && has_zone && entry.value - zone == kUtmNorth) own.utm_zone = zone;
    if (entry.key == kProjection && has_zone && entry.value - zone == kUtmSouth) own.utm_zone = -zone;
    if (entry.key == kTransformation) is_transverse_mercator = entry.value == kMethodTransverseMercator;
    if (entry.key == kEllipsoid && entry.value != kUndefined && entry.value != kUserDefined)
      own.ellipsoid = entry.value;
  }
  const auto real = [&](std::uint16_t key) { return RealOf(key, directory, reals); };
  const std::optional<double> longitude = real(kOriginLongitude), latitude = real(kOriginLatitude),
                              scale = real(kScaleAtOrigin), east = real(kFalseEasting), north = real(kFalseNorthing);
  if (own.utm_zone == 0 && is_transverse_mercator && longitude && latitude && scale && east && north) {
    own.transverse_mercator = {.latitude = *latitude,
                               .longitude = *longitude,
                               .scale = *scale,
                               .false_easting = *east,
                               .false_northing = *north};
  }
  if (!own.has_projection()) return {};
  own.geographic = geographic;
  own.semi_major = real(kSemiMajor);
  own.inverse_flattening = real(kInverseFlattening);
  if (const auto minor = real(kSemiMinor);
      minor && own.semi_major && !own.inverse_flattening && *minor < *own.semi_major)
    own.inverse_flattening = *own.semi_major / (*own.semi_major - *minor);
  own.prime_meridian = real(kPrimeMeridian).value_or(0);
  return own;
}

}  // namespace

CrsDescription DescribeGeoKeys(std::string_view geo_key_directory, std::string_view reals) {
  CrsDescription description;
  for (const GeoKey& entry : ListGeoKeys(geo_key_directory)) {
    if (entry.value == kUndefined || entry.value == kUserDefined) continue;
    switch (entry.key) {
      case kProjected:
        description.projected = entry.value;
        break;
      case kGeographic:
        description.geographic = entry.value;
        break;
      case kProjLinearUnits:
        description.linear_unit = entry.value;
        break;
      case kVertical:
        description.vertical = entry.value;
        break;
      case kVerticalUnits:
        description.vertical_unit = entry.value;
        break;
      default:
        break;
    }
  }
  if (description.projected == 0) description.own = OwnProjection(geo_key_directory, reals, description.geographic);
  return description;
}

namespace {

// The GeoTIFF record of real numbers; empty if there is none.
absl::StatusOr<std::string> RealNumbers(const LasReader& reader) {
  for (const std::vector<VlrEntry>* entries : {&reader.vlrs(), &reader.evlrs()})
    for (const VlrEntry& entry : *entries)
      if (entry.Is(kProjectionUser, kGeoDoubleParamsRecord))
        return reader.ReadAt(entry.data_offset, std::min<std::uint64_t>(entry.data_size, kLongestWkt));
  return std::string();
}

}  // namespace

absl::StatusOr<CrsDescription> DescribeCrs(const LasReader& reader, CrsRecords records) {
  CrsDescription description;
  bool has_keys = false;
  for (const std::vector<VlrEntry>* entries : {&reader.vlrs(), &reader.evlrs()}) {
    for (const VlrEntry& entry : *entries) {
      const bool wkt = records.wkt && entry.Is(kProjectionUser, kWktRecord) && description.wkt.empty();
      const bool keys = records.keys && entry.Is(kProjectionUser, kGeoKeyDirectoryRecord) && !has_keys;
      if (!wkt && !keys) continue;
      ASSIGN_OR_RETURN(std::string data,
                       reader.ReadAt(entry.data_offset, std::min<std::uint64_t>(entry.data_size, kLongestWkt)));
      if (keys) {
        std::string text = std::move(description.wkt);
        ASSIGN_OR_RETURN(const std::string reals, RealNumbers(reader));
        description = DescribeGeoKeys(data, reals);
        description.wkt = std::move(text);
        has_keys = true;
      } else {
        description.wkt = data.substr(0, data.find('\0'));
        absl::StripAsciiWhitespace(&description.wkt);
      }
    }
  }
  return description;
}

absl::StatusOr<std::optional<std::string>> FindFeet(const LasReader& reader, CrsRecords records) {
  for (const std::vector<VlrEntry>* entries : {&reader.vlrs(), &reader.evlrs()}) {
    for (const VlrEntry& entry : *entries) {
      const bool wkt = records.wkt && entry.Is(kProjectionUser, kWktRecord);
      if (!wkt && !(records.keys && entry.Is(kProjectionUser, kGeoKeyDirectoryRecord))) continue;
      ASSIGN_OR_RETURN(const std::string data,
                       reader.ReadAt(entry.data_offset, std::min<std::uint64_t>(entry.data_size, kLongestWkt)));
      std::optional<std::string> feet = wkt ? FindFeetInWkt(data) : FindFeetInGeoKeys(data);
      if (feet.has_value()) return feet;
    }
  }
  return std::optional<std::string>();
}

namespace {

std::string NameOf(const CrsRecords& records) { return records.wkt ? "well-known text" : "GeoTIFF keys"; }

}  // namespace

absl::StatusOr<LasCrs> CrsOf(const LasReader& reader, const std::string& user, const MapPosition& middle) {
  ASSIGN_OR_RETURN(CrsDescription both, DescribeCrs(reader));
  const bool choose = user.empty() && !both.wkt.empty() && both.has_keys();
  CrsRecords named, other;
  if (choose) named = other = {.wkt = reader.header().crs_is_wkt, .keys = !reader.header().crs_is_wkt};
  if (choose) std::swap(other.wkt, other.keys);
  LasCrs crs;
  ASSIGN_OR_RETURN(CrsDescription description, DescribeCrs(reader, named));
  description.user = user;
  absl::StatusOr<std::shared_ptr<const MapFrame>> map = MapFrame::Create(reader.name(), description);
  if (!map.ok() && choose) {
    // The second of two records may still do.
    named = CrsRecords();
    map = MapFrame::Create(reader.name(), both);
  }
  if (!map.ok()) return map.status();
  crs.map = *std::move(map);
  crs.remark = crs.map->remark();
  if (user.empty() && named.wkt && !both.wkt.empty()) {
    ASSIGN_OR_RETURN(const std::string several, CompareWkts(reader, *crs.map, middle));
    absl::StrAppend(&crs.remark, crs.remark.empty() || several.empty() ? "" : "; ", several);
  }
  crs.metres_per_height_unit = crs.map->metres_per_height_unit();
  if (choose && !(named.wkt && named.keys)) {
    ASSIGN_OR_RETURN(const CrsDescription second, DescribeCrs(reader, other));
    const absl::StatusOr<std::shared_ptr<const MapFrame>> more = MapFrame::Create(reader.name(), second);
    // Keys with a projection of the file's own that is not read state no more than the datum.
    const bool same = more.ok() && (*more)->is_geographic() && !crs.map->is_geographic() && second.wkt.empty();
    const double apart = same ? 0 : more.ok() ? Apart(*crs.map, **more, middle) : HUGE_VAL;
    const std::optional<double> unit = more.ok() ? (*more)->metres_per_height_unit() : std::nullopt;
    const auto contradicts = [&](const std::string& how) {
      absl::StrAppend(&crs.remark, crs.remark.empty() ? "" : "; ", reader.name(), ": its ", NameOf(other), " ", how,
                      " its ", NameOf(named), ", which the header names (", crs.map->crs_name(),
                      "); the former are not used");
    };
    if (apart > kSamePlace) {
      contradicts(more.ok() ? absl::StrCat("(", (*more)->crs_name(), ") contradict") : "cannot be read beside");
    } else {
      named = CrsRecords();
      if (!crs.metres_per_height_unit.has_value())
        crs.metres_per_height_unit = unit;
      else if (unit.has_value() && std::abs(*unit / *crs.metres_per_height_unit - 1) > 1e-9)
        contradicts("state another unit of heights than");
    }
  }
  ASSIGN_OR_RETURN(crs.feet, FindFeet(reader, named));
  return crs;
}

absl::StatusOr<LasCrs> CrsOf(const LasReader& reader, const std::string& user) {
  MapPosition first;
  if (reader.header().point_count > 0) {
    ASSIGN_OR_RETURN(const std::string record, FirstRecord(reader));
    const LasPointFields fields(reader.header());
    first = {fields.X(record), fields.Y(record)};
  }
  return CrsOf(reader, user, first);
}

}  // namespace albtpu::formats
