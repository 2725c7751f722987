#include "formats/las/las_extra_bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <set>

#include "absl/strings/str_cat.h"
#include "formats/text/text.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::formats {
namespace {

using laz::Load;
using laz::Store;

// An entry (LAS Specification 1.4 R15, table 24) has: reserved u16, type u8, options u8, name, unused u32; no-data,
// min, max, scale and offset of 24 bytes each; description.
constexpr std::size_t kEntrySize = 192;
constexpr std::size_t kTypeField = 2;
constexpr std::size_t kOptionsField = 3;
constexpr std::size_t kNameField = 4;
constexpr std::size_t kTextSize = 32;
constexpr std::size_t kNoDataField = 40;
constexpr std::size_t kDescriptionField = 160;

constexpr std::uint8_t kUndocumented = 0;  // The options field has the number of bytes.
constexpr std::size_t kMaxUndocumented = 255;
constexpr std::uint8_t kByte = 1, kFloat = 9, kDouble = 10;
constexpr std::uint8_t kNoDataIsSet = 0x01;

// Types 1-10 are u8, i8, u16 .. i64, f32, f64; the deprecated types 11-20 and 21-30 are two and three of these.
constexpr std::array<std::size_t, 10> kTypeSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
constexpr int kTypeCount = 30;

absl::Status MoreThanExist(const std::string& name, std::size_t described, std::size_t extra_bytes) {
  return InvalidFile(name, absl::StrCat("describes ", described, " extra bytes, but its points have ", extra_bytes,
                                        "; correct the description"));
}

struct Known {
  std::string name;
  int type;
  std::size_t offset;  // In the extra bytes.
};

struct Described {
  std::size_t bytes = 0;
  std::vector<Known> entries;
  std::set<std::string, std::less<>> names;
};

absl::StatusOr<Described> Read(const std::string& name, std::string_view record) {
  if (record.size() % kEntrySize != 0) {
    return InvalidFile(name, absl::StrCat("its Extra Bytes record has ", record.size(),
                                          " bytes; expected a multiple of ", kEntrySize));
  }
  Described described;
  for (std::size_t begin = 0; begin < record.size(); begin += kEntrySize) {
    const std::string_view entry = record.substr(begin, kEntrySize);
    const int type = Load<std::uint8_t>(entry, kTypeField);
    if (type > kTypeCount) {
      return InvalidFile(name, absl::StrCat("its Extra Bytes record has type ", type,
                                            " (of unknown size); expected 0 to ", kTypeCount));
    }
    const std::string_view text = entry.substr(kNameField, kTextSize);
    const std::string entry_name(text.substr(0, text.find('\0')));
    described.entries.push_back({entry_name, type, described.bytes});
    described.names.insert(entry_name);
    described.bytes += type == kUndocumented
                           ? Load<std::uint8_t>(entry, kOptionsField)
                           : kTypeSizes[(type - 1) % kTypeSizes.size()] * (1 + (type - 1) / kTypeSizes.size());
  }
  return described;
}

std::string Entry(std::uint8_t type, std::uint8_t options, std::string_view name, std::string_view description) {
  std::string entry(kEntrySize, '\0');
  Store(type, entry.data() + kTypeField);
  Store(options, entry.data() + kOptionsField);
  entry.replace(kNameField, name.size(), name);
  entry.replace(kDescriptionField, description.size(), description);
  return entry;
}

std::string EntryOf(const AppendedFloat& appended, std::uint8_t type) {
  if (appended.is_byte) return Entry(type, 0, appended.name, appended.description);
  std::string entry = Entry(type, kNoDataIsSet, appended.name, appended.description);
  Store(static_cast<double>(appended.no_data), entry.data() + kNoDataField);  // As f64, also for a float.
  return entry;
}

// Yields names that are not taken: "undocumented", "undocumented_2" and so on, each once.
class FreeNames {
 public:
  explicit FreeNames(const std::set<std::string, std::less<>>& taken) : taken_(taken) {}

  std::string Next() {
    std::string name;
    do {
      ++count_;
      name = count_ == 1 ? "undocumented" : absl::StrCat("undocumented_", count_);
    } while (taken_.count(name) > 0);
    return name;
  }

 private:
  const std::set<std::string, std::less<>>& taken_;
  int count_ = 0;
};

}  // namespace

std::size_t BytesOf(const std::vector<AppendedFloat>& appended) {
  std::size_t bytes = 0;
  for (const AppendedFloat& each : appended) bytes += each.size();
  return bytes;
}

std::vector<AppendedFloat> AppendedFloats(const Appended& appended) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto at = [&](std::string_view two_sigma, std::string_view one_sigma, std::string_view p95) {
    return appended.coverage == Coverage::kTwoSigma   ? two_sigma
           : appended.coverage == Coverage::kOneSigma ? one_sigma
                                                      : p95;
  };
  const std::string_view length = at("2 sigma, m", "1 sigma, m", "95 %, m");
  std::vector<AppendedFloat> floats;
  if (appended.total) {
    const std::string_view what = appended.water
                                      ? at("all shares, 2 sigma, m", "all shares, 1 sigma, m", "all shares, 95 %, m")
                                      : at("all but water column, 2 sigma, m", "all but water column, 1 sigma, m",
                                           "all but water column, 95 %, m");
    floats = {{"total_thu", what, kNoNumber}, {"total_tvu", what, kNoNumber}};
  } else {
    const std::string_view what =
        at("sea surface only, 2 sigma, m", "sea surface only, 1 sigma, m", "sea surface only, 95 %, m");
    floats = {{"sea_thu", what, kNoNumber}, {"sea_tvu", what, kNoNumber}};
  }
  if (appended.total && appended.details) {
    for (const std::string_view name : {"thu_air", "tvu_air", "thu_sea", "tvu_sea"})
      floats.push_back({name, length, kNoNumber});
    for (const std::string_view name : {"thu_water", "tvu_water"})
      floats.push_back({name, appended.water ? length : "left out", kNoNumber});
    if (appended.extra)
      for (const std::string_view name : {"thu_extra", "tvu_extra"}) floats.push_back({name, length, kNoNumber});
    for (const std::string_view name : {"tvu_pulse", "tvu_line"})  // Errors that are independent between them.
      floats.push_back({name, length, kNoNumber});
    floats.push_back({"bias_along_beam", "too far along the beam, m", kNan});
    floats.push_back({"bias_vertical", "too shallow, m", kNan});
    for (const std::string_view name :
         {"VarianceX", "VarianceY", "VarianceZ", "CovarianceXY", "CovarianceXZ", "CovarianceYZ"})
      floats.push_back({name, "of the total, 1 sigma, m2", kNan});
    if (appended.terrain) {
      floats.push_back({"terrain_slope", "of the ground around, degree", kNan});
      for (const std::string_view name : {"tvu_slope", "tvu_footprint"}) floats.push_back({name, length, kNoNumber});
    }
  }
  if (appended.details) {
    floats.push_back({"incidence", "in air, at the water, degree", kNan});
    floats.push_back({"beam_azimuth", "from true north, degree", kNan});
    floats.push_back({"footprint", "diameter across the beam, m", kNoNumber});
    floats.push_back({"water_depth", "below the water surface, m", kNoNumber});
    floats.push_back({"slant_range", "in air, sensor to water, m", kNoNumber});
  }
  if (appended.share_of()) floats.push_back({"share_of", "total: 0 none, 1 land, 2 water", 0, true});
  return floats;
}

absl::StatusOr<std::string> ReadExtraBytesRecord(const LasReader& reader) {
  std::vector<std::string> records;
  for (const std::vector<VlrEntry>* entries : {&reader.vlrs(), &reader.evlrs()}) {
    for (const VlrEntry& entry : *entries) {
      if (!entry.Is(kSpecUser, kExtraBytesRecord)) continue;
      if (entry.data_size > kLargestExtraBytesRecord) {
        return InvalidFile(reader.name(), absl::StrCat("its Extra Bytes record has ", entry.data_size,
                                                       " bytes; expected at most ", kLargestExtraBytesRecord));
      }
      ASSIGN_OR_RETURN(records.emplace_back(), reader.ReadAt(entry.data_offset, entry.data_size));
    }
  }
  if (records.empty()) return std::string();
  const std::string& longest = *std::ranges::max_element(records, {}, &std::string::size);
  if (std::ranges::all_of(records, [&](const std::string& each) { return longest.starts_with(each); })) return longest;
  std::size_t bytes = 0, entries = 0;
  std::set<std::string, std::less<>> names;
  std::string list;
  for (const std::string& record : records) {
    ASSIGN_OR_RETURN(const Described known, Read(reader.name(), record));
    list += record;
    bytes += known.bytes;
    for (const Known& entry : known.entries) entries += entry.type != kUndocumented;
    for (const Known& entry : known.entries)
      if (entry.type != kUndocumented) names.insert(entry.name);
  }
  if (bytes <= reader.header().extra_bytes() && names.size() == entries) return list;
  return InvalidFile(
      reader.name(),
      absl::StrCat("describes its extra bytes in ", records.size(), " records that contradict each other (",
                   names.size() < entries ? "a name is described twice" : absl::StrCat(bytes, " bytes are described"),
                   ", points have ", reader.header().extra_bytes(), " extra bytes); keep the right one"));
}

absl::StatusOr<AppendedDescription> DescribeAppended(const std::string& name, std::string_view described,
                                                     std::size_t extra_bytes,
                                                     const std::vector<AppendedFloat>& appended, bool replace) {
  ASSIGN_OR_RETURN(Described known, Read(name, described));
  AppendedDescription description{.record = std::string(described), .replaced = {}};
  std::string& record = description.record;
  for (std::size_t i = 0; i < appended.size(); ++i) {
    const std::string ours(appended[i].name);
    if (known.names.count(ours) == 0) continue;
    if (!replace) {
      return InvalidFile(name, absl::StrCat("already has ", ours,
                                            "; annotate the file from which it was made, or replace its values by "
                                            "--replace"));
    }
    const auto is_ours = [&](const Known& entry) { return entry.name == ours; };
    if (std::count_if(known.entries.begin(), known.entries.end(), is_ours) > 1)
      return InvalidFile(name, absl::StrCat("describes ", ours, " twice; remove one of the descriptions"));
    const auto entry = std::find_if(known.entries.begin(), known.entries.end(), is_ours);
    if (appended[i].is_byte ? entry->type != kByte : entry->type != kFloat && entry->type != kDouble) {
      return InvalidFile(name, absl::StrCat("has ", ours, " as type ", entry->type, " of Extra Bytes; --replace takes ",
                                            appended[i].is_byte ? "bytes (1)" : "floats (9) and doubles (10)",
                                            ": annotate the file from which it was made"));
    }
    const auto place = static_cast<std::size_t>(entry - known.entries.begin()) * kEntrySize;
    record.replace(place, kEntrySize, EntryOf(appended[i], static_cast<std::uint8_t>(entry->type)));
    description.replaced.push_back({i, entry->offset, entry->type == kDouble});
  }
  if (known.bytes > extra_bytes) return MoreThanExist(name, known.bytes, extra_bytes);
  FreeNames free_names(known.names);
  for (std::size_t left = extra_bytes - known.bytes; left > 0;) {
    const std::size_t bytes = std::min(left, kMaxUndocumented);
    record += Entry(kUndocumented, static_cast<std::uint8_t>(bytes), free_names.Next(), "");
    left -= bytes;
  }
  for (const AppendedFloat& ours : appended)
    if (known.names.count(ours.name) == 0) record += EntryOf(ours, ours.is_byte ? kByte : kFloat);
  if (record.size() > kLargestExtraBytesRecord) {
    return InvalidFile(
        name, absl::StrCat("describes so many extra bytes that ", appended.size(), " more descriptions exceed ",
                           kLargestExtraBytesRecord, " bytes; remove some"));
  }
  return description;
}

namespace {

absl::StatusOr<std::map<std::string, std::size_t, std::less<>>> OffsetsOf(std::uint8_t type, const std::string& name,
                                                                          std::string_view described,
                                                                          std::size_t extra_bytes) {
  ASSIGN_OR_RETURN(const Described known, Read(name, described));
  if (known.bytes > extra_bytes) return MoreThanExist(name, known.bytes, extra_bytes);
  std::map<std::string, std::size_t, std::less<>> offsets;
  for (const Known& entry : known.entries)
    if (entry.type == type) offsets.emplace(entry.name, entry.offset);
  return offsets;
}

}  // namespace

absl::StatusOr<std::map<std::string, std::size_t, std::less<>>> FloatOffsets(const std::string& name,
                                                                             std::string_view described,
                                                                             std::size_t extra_bytes) {
  return OffsetsOf(kFloat, name, described, extra_bytes);
}

absl::StatusOr<std::map<std::string, std::size_t, std::less<>>> ByteOffsets(const std::string& name,
                                                                            std::string_view described,
                                                                            std::size_t extra_bytes) {
  return OffsetsOf(kByte, name, described, extra_bytes);
}

}  // namespace albtpu::formats
