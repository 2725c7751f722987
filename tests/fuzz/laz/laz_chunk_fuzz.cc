// Arbitrary bytes as a chunk of a LAZ file are rejected with a reason, or decoded from no byte that is not the chunk's:
// to the same records in steps of any size. Arbitrary records of every point format survive coding.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "laz/coding/little_endian.h"
#include "laz/items/point14_fields.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/laz/chunk_input.h"

namespace albtpu::fuzz {
namespace {

DecodedChunk Decode(const ChunkInput& chunk, std::string_view bytes, std::size_t step, bool exact) {
  return DecodeChunk(*chunk.coding->decoder, bytes, chunk.record_length(), chunk.points, chunk.decoded, step, exact);
}

// The fields of WantedFields::kReturns are the same in both.
bool HaveSameReturns(std::string_view one, std::string_view other, std::size_t record_length) {
  const auto same = [&](std::size_t begin, std::size_t size) {
    return one.substr(begin, size) == other.substr(begin, size);
  };
  for (std::size_t at = 0; at < one.size(); at += record_length) {
    if (!same(at + laz::kXOffset, 12) || !same(at + laz::kReturnsOffset, 1) || !same(at + laz::kClassOffset, 1) ||
        !same(at + laz::kFlagsOffset, 1) || !same(at + laz::kTimeOffset, 8))
      return false;
  }
  return one.size() == other.size();
}

// The chunk is the same when it is decoded in other steps, when its end is known, when only its returns are wanted, and
// after its records are encoded.
void Compare(const ChunkInput& chunk, const DecodedChunk& whole) {
  const DecodedChunk again = Decode(chunk, chunk.bytes, chunk.step, chunk.exact);
  ALBTPU_MUST(whole.status.ok() == again.status.ok());
  if (!whole.status.ok()) return;
  ALBTPU_MUST(whole.records == again.records && whole.position == again.position);
  if (!chunk.exact && chunk.decoded == chunk.points) {
    const DecodedChunk cut = Decode(chunk, chunk.bytes.substr(0, whole.position), chunk.step, true);
    ALBTPU_MUST(cut.status.ok() && cut.records == whole.records && cut.position == whole.position);
  }
  if (chunk.coding->returns_decoder != nullptr) {
    const DecodedChunk returns = DecodeChunk(*chunk.coding->returns_decoder, chunk.bytes, chunk.record_length(),
                                             chunk.points, chunk.decoded, chunk.step, chunk.exact);
    ALBTPU_MUST(returns.status.ok() && returns.position == whole.position);
    ALBTPU_MUST(HaveSameReturns(returns.records, whole.records, chunk.record_length()));
  }
  ChunkCoding& encoded = *chunk.coding->encoded;
  MustSurviveCoding(encoded, whole.records);
  const laz::CommonLayers common(chunk.coding->record, encoded.record);
  if (chunk.decoded == chunk.points && !common.empty())
    MustSurviveCoding(encoded, whole.records, common.Of(chunk.bytes.substr(0, whole.position)));
}

void LazChunkTarget(std::string_view input) {
  if (input.size() < kChunkHeadSize) return;
  const ChunkInput chunk = ParseChunkInput(input);
  const DecodedChunk whole = Decode(chunk, chunk.bytes, kMostPoints, chunk.exact);
  if (whole.status.ok())
    ALBTPU_MUST(whole.position == chunk.bytes.size() || !chunk.exact || chunk.decoded < chunk.points);
  else
    ALBTPU_MUST(absl::IsDataLoss(whole.status) && whole.status.message().size() > 20);
  if (IsOneIn(8, input)) Compare(chunk, whole);  // Each coding takes as long as the first.
}

void LazRecordsTarget(std::string_view bytes) {
  if (bytes.size() < kChunkHeadSize) return;
  const ChunkInput input = ParseChunkInput(bytes);
  const std::size_t points = std::min(kMostPoints, input.bytes.size() / input.record_length());
  if (points > 0) MustSurviveCoding(*input.coding->encoded, input.bytes.substr(0, points * input.record_length()));
}

struct Field {
  std::size_t offset, size;
};

// x, y, z, intensity, returns, flags, class, scan angle, user data, source, time; LAS Specification 1.4 R15.
constexpr Field kLegacyFields[] = {{0, 4},  {4, 4},  {8, 4},  {12, 2}, {14, 1}, {15, 1}, {16, 1},
                                   {17, 1}, {18, 2}, {20, 8}, {20, 8}, {20, 2}, {22, 2}, {24, 2}};
constexpr Field kModernFields[] = {{0, 4},  {4, 4},  {8, 4},  {12, 2}, {14, 1}, {15, 1}, {16, 1}, {17, 1},
                                   {18, 2}, {20, 2}, {22, 8}, {22, 8}, {30, 2}, {32, 2}, {34, 2}, {36, 2}};

Field AnyField(Random& random, int point_format, std::size_t record_length) {
  Field field = point_format < 6 ? kLegacyFields[random() % std::size(kLegacyFields)]
                                 : kModernFields[random() % std::size(kModernFields)];
  if (random() % 3 == 0) field = {random() % record_length, std::size_t{1} << random() % 4};
  field.offset = std::min(field.offset, record_length - 1);
  field.size = std::min(field.size, record_length - field.offset);
  return field;
}

// Small steps, powers of two and numbers beside them, and anything; of either sign.
std::uint64_t AnyStep(Random& random) {
  std::uint64_t step = random() % 16;
  switch (random() % 4) {
    case 0:
      step = (std::uint64_t{1} << random() % 64) + random() % 3 - 1;
      break;
    case 1:
      step = random() >> random() % 32;
      break;
    case 2:
      step = (std::uint64_t{random()} << 32 | random()) >> random() % 64;
      break;
  }
  return random() % 2 == 0 ? step : 0 - step;
}

std::uint64_t Number(const char* record, const Field& field) {
  std::uint64_t number = 0;
  std::memcpy(&number, record + field.offset, field.size);
  return number;
}

void Store(std::uint64_t number, char* record, const Field& field) {
  std::memcpy(record + field.offset, &number, field.size);
}

// Changes records once as neighbouring points of a survey differ, so that all predictions of a codec are reached.
// Requires at least one record; leaves one to `most`.
void ChangeRecord(Random& random, int point_format, std::size_t record_length, std::size_t most, std::string& records) {
  const std::size_t count = records.size() / record_length, at = random() % count;
  const auto record = [&](std::size_t i) { return records.data() + i * record_length; };
  const Field field = AnyField(random, point_format, record_length);
  const std::uint64_t step = AnyStep(random);
  switch (random() % 8) {
    case 0:  // A point like another, maybe an earlier one.
      if (count < most)
        records.insert(at * record_length, records.substr(random() % count * record_length, record_length));
      return;
    case 1:
      if (count > 1) records.erase(at * record_length, record_length);
      return;
    case 2:  // A step that lasts.
      for (std::size_t i = at; i < count; ++i) Store(Number(record(i), field) + step, record(i), field);
      return;
    case 3:  // A steady change.
      for (std::size_t i = at; i < count; ++i) Store(Number(record(at), field) + (i - at) * step, record(i), field);
      return;
    case 4:  // A value that returns.
      Store(Number(record(random() % count), field), record(at), field);
      return;
    case 5:  // Different in every point.
      for (std::size_t i = at; i < count; ++i) Store(AnyStep(random), record(i), field);
      return;
    case 6:
      Store(step, record(at), field);
      return;
    default:
      Store(Number(record(at), field) + step, record(at), field);
  }
}

void ChangeRecords(Random& random, const ChunkInput& input, std::size_t most, std::string& records) {
  for (std::size_t i = 0, changes = 1 + random() % 4; i < changes; ++i)
    ChangeRecord(random, input.coding->point_format, input.record_length(), most, records);
}

constexpr std::size_t kNumberSize = sizeof(std::uint32_t);  // In the head of a layered chunk.
constexpr unsigned int kRecordsInEvery = 32;                // Mutations: two codings take as long as two inputs.

// The chunk of other records, behind its head. Empty if the input cannot be decoded.
std::string OtherRecords(Random& random, const ChunkInput& input, std::string head) {
  const std::size_t length = input.record_length();
  std::string records =
      DecodeChunk(*input.coding->decoder, input.bytes, length, input.points, input.decoded, kMostPoints, input.exact)
          .records;
  if (records.empty()) return "";
  ChangeRecords(random, input, kMostPoints, records);
  std::string bytes;
  input.coding->encoded->encoder->Encode(records, bytes, {});
  return WithPoints(head, records.size() / length) + bytes;
}

// Changes one stream of a layered chunk, and states in its head what then follows. `chunk` must reach behind the head.
void ChangeLayer(Random& random, const ChunkInput& input, std::size_t count, std::size_t most, std::string& chunk) {
  struct Part {
    std::size_t size_offset, begin, size;
  };
  const std::size_t sizes = input.record_length() + kNumberSize;
  const std::size_t changed = random() % count, other = random() % count;
  laz::Store(static_cast<std::uint32_t>(input.points), &chunk[input.record_length()]);
  Part layer{}, copied{};
  std::size_t begin = sizes + count * kNumberSize;
  for (std::size_t i = 0; i < count; ++i) {
    Part part = {sizes + i * kNumberSize, begin, 0};
    part.size = std::min<std::size_t>(laz::Load<std::uint32_t>(chunk, part.size_offset), chunk.size() - begin);
    laz::Store(static_cast<std::uint32_t>(part.size), &chunk[part.size_offset]);
    if (i == changed) layer = part;
    if (i == other) copied = part;
    begin += part.size;
  }
  chunk.resize(begin);

  const std::string bytes = random() % 8 == 0 ? chunk.substr(copied.begin, copied.size)
                                              : MutateBytes(chunk.substr(layer.begin, layer.size),
                                                            most - std::min(most, chunk.size() - layer.size));
  chunk.replace(layer.begin, layer.size, bytes);
  laz::Store(static_cast<std::uint32_t>(bytes.size()), &chunk[layer.size_offset]);
}

// Another stream behind the first record, or other bytes of a chunk that is too short to have one.
std::string ChangeStream(Random& random, const ChunkInput& input, std::size_t most) {
  const std::size_t length = input.record_length(), count = LayerCount(input.coding->record);
  std::string chunk(input.bytes);
  if (count > 0 && chunk.size() >= length + (1 + count) * kNumberSize) {
    ChangeLayer(random, input, count, most, chunk);
    return chunk;
  }
  if (count > 0 || chunk.size() < length) return MutateBytes(chunk, most);
  return chunk.substr(0, length) + MutateBytes(chunk.substr(length), most - std::min(most, length));
}

// Such that most chunks can be decoded to their end: by their records, or by the bytes of their streams, whose sizes
// are then corrected.
std::string MutateLazChunk(std::string_view bytes, std::size_t most, Random& random) {
  if (bytes.size() <= kChunkHeadSize || random() % 8 == 0) return "";
  std::string head(bytes.substr(0, kChunkHeadSize));
  if (random() % 16 == 0) {
    head[random() % kChunkHeadSize] = static_cast<char>(random());
    return head + std::string(bytes.substr(kChunkHeadSize));
  }
  const ChunkInput input = ParseChunkInput(bytes);
  if (random() % kRecordsInEvery == 0) return OtherRecords(random, input, head);
  return head + ChangeStream(random, input, most - kChunkHeadSize);
}

std::string MutateLazRecords(std::string_view bytes, std::size_t most, Random& random) {
  if (bytes.size() < kChunkHeadSize || random() % 16 == 0) return "";
  const ChunkInput input = ParseChunkInput(bytes);
  const std::size_t length = input.record_length();
  const std::size_t count = std::min(kMostPoints, (most - kChunkHeadSize) / length);
  std::string records(input.bytes.substr(0, std::min(count, input.bytes.size() / length) * length));
  if (records.empty()) return "";
  ChangeRecords(random, input, count, records);
  return std::string(bytes.substr(0, kChunkHeadSize)) + records;
}

}  // namespace

const std::vector<Target> kTargets = {{"laz_chunk", LazChunkTarget, MutateLazChunk},
                                      {"laz_records", LazRecordsTarget, MutateLazRecords}};

}  // namespace albtpu::fuzz
