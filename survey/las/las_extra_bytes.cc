#include "survey/las/las_extra_bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include "absl/strings/str_cat.h"
#include "survey/las/little_endian.h"

namespace albtpu::client {
namespace {

// An entry (LAS Specification 1.4 R15, table 24): reserved u16, type u8, options u8, name, unused u32,
// no-data, min and max 24 bytes each, scale and offset 24 each, description.
constexpr std::size_t kEntrySize = 192;
constexpr std::size_t kTypeField = 2;
constexpr std::size_t kOptionsField = 3;
constexpr std::size_t kNameField = 4;
constexpr std::size_t kTextSize = 32;
constexpr std::size_t kNoDataField = 40;
constexpr std::size_t kDescriptionField = 160;

constexpr std::uint8_t kUndocumented = 0;  // Its options are its number of bytes.
constexpr std::size_t kMostUndocumented = 255;
constexpr std::uint8_t kFloat = 9;
constexpr std::uint8_t kNoDataIsSet = 0x01;

// Types 1-10 are u8, i8, u16 .. i64, f32, f64; 11-20 and 21-30 (deprecated) are two and three of them.
constexpr std::array<std::size_t, 10> kTypeSizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
constexpr int kTypeCount = 30;

struct Described {
  std::size_t bytes = 0;
  std::set<std::string, std::less<>> names;
};

absl::Status Bad(const std::string& name, const std::string& message) {
  return absl::InvalidArgumentError(absl::StrCat(name, ": ", message));
}

absl::StatusOr<Described> Read(const std::string& name, std::string_view record) {
  if (record.size() % kEntrySize != 0) {
    return Bad(name, absl::StrCat("its record of extra bytes has ", record.size(), " bytes: a multiple of ",
                                  kEntrySize, " is right"));
  }
  Described described;
  for (std::size_t begin = 0; begin < record.size(); begin += kEntrySize) {
    const std::string_view entry = record.substr(begin, kEntrySize);
    const int type = Load<std::uint8_t>(entry, kTypeField);
    if (type > kTypeCount) {
      return Bad(name, absl::StrCat("its extra bytes have type ", type, ", whose size is not known: 0 to ",
                                    kTypeCount, " are right"));
    }
    described.bytes += type == kUndocumented ? Load<std::uint8_t>(entry, kOptionsField)
                                             : kTypeSizes[(type - 1) % kTypeSizes.size()] *
                                                   (1 + (type - 1) / kTypeSizes.size());
    const std::string_view text = entry.substr(kNameField, kTextSize);
    described.names.emplace(text.substr(0, text.find('\0')));
  }
  return described;
}

std::string Entry(std::uint8_t type, std::uint8_t options, std::string_view name,
                  std::string_view description) {
  std::string entry(kEntrySize, '\0');
  Store(type, entry.data() + kTypeField);
  Store(options, entry.data() + kOptionsField);
  entry.replace(kNameField, name.size(), name);
  entry.replace(kDescriptionField, description.size(), description);
  return entry;
}

std::string UncertaintyEntry(std::string_view name, Coverage coverage) {
  std::string entry =
      Entry(kFloat, kNoDataIsSet, name,
            coverage == Coverage::kTwoSigma ? "sea surface only, 2 sigma, m" : "sea surface only, 95 %, m");
  Store(static_cast<double>(kNoUncertainty),
        entry.data() + kNoDataField);  // Floats have their no-data as f64.
  return entry;
}

// Names that are not taken: "undocumented", then with a number behind it, each but once.
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

absl::StatusOr<std::string> DescribeUncertainty(const std::string& name, std::string_view described,
                                                std::size_t extra_bytes, Coverage coverage) {
  absl::StatusOr<Described> known = Read(name, described);
  if (!known.ok()) return known.status();
  for (const std::string_view ours : {kThuName, kTvuName}) {
    if (known->names.count(ours) > 0) {
      return Bad(
          name, absl::StrCat("has ", std::string(ours), " already: annotate the file that it was made from"));
    }
  }
  if (known->bytes > extra_bytes) {
    return Bad(name, absl::StrCat("describes ", known->bytes, " extra bytes, its records have ", extra_bytes,
                                  ": as many as there are is right"));
  }
  std::string record(described);
  FreeNames free_names(known->names);
  for (std::size_t left = extra_bytes - known->bytes; left > 0;) {
    const std::size_t bytes = std::min(left, kMostUndocumented);
    record += Entry(kUndocumented, static_cast<std::uint8_t>(bytes), free_names.Next(), "");
    left -= bytes;
  }
  record += UncertaintyEntry(kThuName, coverage);
  record += UncertaintyEntry(kTvuName, coverage);
  if (record.size() > kLargestExtraBytesRecord) {
    return Bad(name, absl::StrCat("describes so many extra bytes that two more do not fit a record of ",
                                  kLargestExtraBytesRecord, " bytes: remove some"));
  }
  return record;
}

}  // namespace albtpu::client
