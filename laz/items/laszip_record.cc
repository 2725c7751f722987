// The layout of the record, in bytes:
//
//    0  u16  compressor
//    2  u16  coder; 0 is the arithmetic coder, the only one
//    4  u8, u8, u16  the version of LASzip that the writer follows
//    8  u32  options of the writer, which readers ignore
//   12  u32  points of a chunk; 0 for compressor 1, 2^32 - 1 for chunks of variable length
//   16  i64, i64  number and offset of special EVLRs; -1 for none, which readers ignore
//   32  u16  number of items, and for each of them
//   34  u16, u16, u16  type, size, version
#include "laz/items/laszip_record.h"

#include <algorithm>
#include <cassert>

#include "absl/strings/str_cat.h"
#include "laz/coding/arithmetic_decoder.h"
#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::laz {
namespace {

constexpr std::size_t kRecordHeadSize = 34, kItemSize = 6;

bool IsLayered(int point_format) { return point_format >= 6; }

// The items of a record; empty if it is shorter than its format.
std::vector<Item> ItemsOf(int point_format, std::size_t record_length) {
  assert(point_format >= 0 && point_format <= 10);
  const auto is_any_of = [=](std::initializer_list<int> formats) {
    return std::ranges::count(formats, point_format) > 0;
  };
  std::vector<Item> items;
  if (IsLayered(point_format)) {
    items.push_back({ItemType::kPoint14, 30, 3});
    if (point_format == 7) items.push_back({ItemType::kRgb14, 6, 3});
    if (is_any_of({8, 10})) items.push_back({ItemType::kRgbNir14, 8, 3});
    if (is_any_of({9, 10})) items.push_back({ItemType::kWavePacket14, 29, 3});
  } else {
    items.push_back({ItemType::kPoint10, 20, 2});
    if (is_any_of({1, 3, 4, 5})) items.push_back({ItemType::kGpsTime11, 8, 2});
    if (is_any_of({2, 3, 5})) items.push_back({ItemType::kRgb12, 6, 2});
    if (is_any_of({4, 5})) items.push_back({ItemType::kWavePacket13, 29, 1});
  }
  std::size_t length = 0;
  for (const Item& item : items) length += item.size;
  if (record_length < length || record_length > 0xFFFF) return {};
  if (record_length > length) {
    const auto size = static_cast<std::uint16_t>(record_length - length);
    items.push_back(IsLayered(point_format) ? Item{ItemType::kByte14, size, 3} : Item{ItemType::kByte, size, 2});
  }
  return items;
}

std::string Text(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items)
    absl::StrAppend(&text, text.empty() ? "" : ", ", static_cast<int>(item.type), " of ", item.size, " bytes");
  return text;
}

absl::Status CheckVersion(const Item& item, const Item& expected) {
  if (item.version == expected.version) return absl::OkStatus();
  // Version 4 differs where scanner channels alternate. Prototypes of LASzip 3 called the coding of version 3 version
  // 2; they had no wave packets.
  const bool layered = expected.version == 3, was_in_prototypes = item.type != ItemType::kWavePacket14;
  if (layered && (item.version == 4 || (item.version == 2 && was_in_prototypes))) return absl::OkStatus();
  const std::string wanted = !layered ? absl::StrCat(expected.version) : was_in_prototypes ? "2, 3 or 4" : "3 or 4";
  return absl::UnimplementedError(absl::StrCat("its LASzip record states version ", item.version, " of item ",
                                               static_cast<int>(item.type), " (expected ", wanted,
                                               "); write the file again with a present version of LASzip"));
}

absl::Status CheckCompressor(std::uint16_t compressor, std::uint16_t coder, std::uint32_t chunk_size,
                             int point_format) {
  if (compressor < 1 || compressor > 3) {
    return absl::UnimplementedError(
        absl::StrCat("its LASzip record states compressor ", compressor, " (expected 1, 2 or 3)", kGetAnotherCopy));
  }
  if (coder != 0) {
    return absl::UnimplementedError(
        absl::StrCat("its LASzip record states coder ", coder, " (expected 0)", kGetAnotherCopy));
  }
  if (IsLayered(point_format) != (compressor == static_cast<std::uint16_t>(Compressor::kLayeredChunked))) {
    const std::string problem =
        absl::StrCat("its LASzip record states compressor ", compressor, " for point format ", point_format,
                     " (expected ", IsLayered(point_format) ? "3" : "1 or 2", ")");
    return absl::UnimplementedError(absl::StrCat(problem, "; write the file again with a present version of LASzip"));
  }
  if ((chunk_size == 0) != (compressor == static_cast<std::uint16_t>(Compressor::kPointwise))) {
    return absl::InvalidArgumentError(
        absl::StrCat("its LASzip record states chunks of ", chunk_size, " points (expected ",
                     chunk_size == 0 ? "1 or more" : "0 for compressor 1", ")", kGetAnotherCopy));
  }
  return absl::OkStatus();
}

}  // namespace

std::size_t LaszipRecord::record_length() const {
  std::size_t length = 0;
  for (const Item& item : items) length += item.size;
  return length;
}

LaszipRecord RecordFor(int point_format, std::size_t record_length, std::uint32_t chunk_size) {
  LaszipRecord record{
      .compressor = IsLayered(point_format) ? Compressor::kLayeredChunked : Compressor::kPointwiseChunked,
      .chunk_size = chunk_size,
      .items = ItemsOf(point_format, record_length)};
  assert(!record.items.empty() && chunk_size != 0);
  return record;
}

absl::StatusOr<LaszipRecord> ParseLaszipRecord(std::string_view data, int point_format, std::size_t record_length) {
  if (data.size() < kRecordHeadSize) {
    return absl::InvalidArgumentError(absl::StrCat("its LASzip record has ", data.size(), " bytes (expected ",
                                                   kRecordHeadSize, " or more)", kGetAnotherCopy));
  }
  const auto chunk_size = Load<std::uint32_t>(data, 12);
  const auto compressor = Load<std::uint16_t>(data, 0);
  RETURN_IF_ERROR(CheckCompressor(compressor, Load<std::uint16_t>(data, 2), chunk_size, point_format));
  const std::size_t count = Load<std::uint16_t>(data, 32);
  if (data.size() != kRecordHeadSize + count * kItemSize) {
    return absl::InvalidArgumentError(absl::StrCat("its LASzip record has ", data.size(), " bytes (expected ",
                                                   kRecordHeadSize + count * kItemSize, " for its ", count, " items)",
                                                   kGetAnotherCopy));
  }
  const std::vector<Item> expected = ItemsOf(point_format, record_length);
  LaszipRecord record{static_cast<Compressor>(compressor), chunk_size, {}};
  for (std::size_t i = kRecordHeadSize; i < data.size(); i += kItemSize) {
    record.items.push_back({static_cast<ItemType>(Load<std::uint16_t>(data, i)), Load<std::uint16_t>(data, i + 2),
                            Load<std::uint16_t>(data, i + 4)});
  }
  const auto is_same_field = [](const Item& a, const Item& b) { return a.type == b.type && a.size == b.size; };
  if (expected.empty() || !std::ranges::equal(record.items, expected, is_same_field)) {
    const std::string wanted = expected.empty() ? "more bytes" : Text(expected);
    return absl::InvalidArgumentError(absl::StrCat("its LASzip record states items ", Text(record.items), " (expected ",
                                                   wanted, " for point format ", point_format, " and records of ",
                                                   record_length, " bytes)", kGetAnotherCopy));
  }
  for (std::size_t i = 0; i < expected.size(); ++i) RETURN_IF_ERROR(CheckVersion(record.items[i], expected[i]));
  return record;
}

std::string LaszipRecordData(const LaszipRecord& record) {
  std::string data(kRecordHeadSize + record.items.size() * kItemSize, '\0');
  char* const bytes = data.data();
  Store(static_cast<std::uint16_t>(record.compressor), bytes);
  bytes[4] = 3;  // The first version with layers and with all items of record: 3.4.3.
  bytes[5] = 4;
  Store(std::uint16_t{3}, bytes + 6);
  Store(record.chunk_size, bytes + 12);
  Store(std::int64_t{-1}, bytes + 16);
  Store(std::int64_t{-1}, bytes + 24);
  Store(static_cast<std::uint16_t>(record.items.size()), bytes + 32);
  char* next = bytes + kRecordHeadSize;
  for (const Item& item : record.items) {
    Store(static_cast<std::uint16_t>(item.type), next);
    Store(item.size, next + 2);
    Store(item.version, next + 4);
    next += kItemSize;
  }
  return data;
}

}  // namespace albtpu::laz
