// Mutates the chunks of laz_chunk_fuzz such that most of them can be decoded to their end: by their records, or by the
// bytes of their streams, whose sizes are then corrected. Some inputs are mutated byte by byte.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include "formats/laz/coding/little_endian.h"
#include "tests/fuzz/laz/chunk_decoding.h"
#include "tests/fuzz/laz/chunk_input.h"
#include "tests/fuzz/laz/record_mutation.h"
#include "tests/fuzz/mutation.h"

namespace {

using namespace albtpu;
using namespace albtpu::fuzz;

constexpr std::size_t kNumberSize = sizeof(std::uint32_t);  // In the head of a layered chunk.
constexpr unsigned int kRecordsInEvery = 32;                // Mutations: two codings take as long as two inputs.

void Mutate(std::string& bytes, std::size_t most) {
  const std::size_t size = std::min(bytes.size(), most);
  bytes.resize(most);
  if (most > 0) bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, most));
}

// The chunk of other records, behind its head. Empty if the input cannot be decoded.
std::string OtherRecords(std::minstd_rand& random, const ChunkInput& input, std::string head) {
  const std::size_t length = input.record_length();
  std::string records =
      DecodeChunk(*input.coding->decoder, input.bytes, length, input.points, input.decoded, kMostPoints, input.exact)
          .records;
  if (records.empty()) return "";
  for (std::size_t i = 0, changes = 1 + random() % 4; i < changes; ++i)
    ChangeRecords(random, input.coding->point_format, length, kMostPoints, records);
  std::string bytes;
  input.coding->encoded->encoder->Encode(records, bytes);
  return WithPoints(head, records.size() / length) + bytes;
}

// Changes one stream of a layered chunk, and states in its head what then follows. `chunk` must reach behind the head.
void ChangeLayer(std::minstd_rand& random, const ChunkInput& input, std::size_t count, std::size_t most,
                 std::string& chunk) {
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

  static std::string bytes;
  if (random() % 8 == 0) {
    bytes.assign(chunk, copied.begin, copied.size);
  } else {
    bytes.assign(chunk, layer.begin, layer.size);
    Mutate(bytes, most - std::min(most, chunk.size() - layer.size));
  }
  chunk.replace(layer.begin, layer.size, bytes);
  laz::Store(static_cast<std::uint32_t>(bytes.size()), &chunk[layer.size_offset]);
}

// Changes a stream behind the first record, or any bytes of a chunk that is too short to have one.
void ChangeStream(std::minstd_rand& random, const ChunkInput& input, std::size_t most, std::string& chunk) {
  const std::size_t length = input.record_length(), count = LayerCount(input.coding->record);
  chunk = input.bytes;
  if (count > 0 && chunk.size() >= length + (1 + count) * kNumberSize)
    return ChangeLayer(random, input, count, most, chunk);
  if (count > 0 || chunk.size() < length) return Mutate(chunk, most);
  static std::string stream;
  stream.assign(chunk, length);
  Mutate(stream, most - std::min(most, length));
  chunk.replace(length, chunk.npos, stream);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  if (size <= kChunkHeadSize || random() % 8 == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (random() % 16 == 0) {
    data[random() % kChunkHeadSize] = static_cast<std::uint8_t>(random());
    return size;
  }
  const ChunkInput input = ParseChunkInput({reinterpret_cast<const char*>(data), size});
  if (random() % kRecordsInEvery == 0) {
    const std::string head(reinterpret_cast<const char*>(data), kChunkHeadSize);
    return Replace(OtherRecords(random, input, head), data, size, max_size);
  }
  static std::string chunk;  // Memory that is used again.
  ChangeStream(random, input, max_size - kChunkHeadSize, chunk);
  if (chunk.size() > max_size - kChunkHeadSize) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data + kChunkHeadSize, chunk.data(), chunk.size());
  return kChunkHeadSize + chunk.size();
}
