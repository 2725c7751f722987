// Mutates the chunks of laz_chunk_fuzz such that most of them can be decoded to their end: by their records, or by the
// bytes of their streams, whose sizes are then corrected. Some inputs are mutated byte by byte.
#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "tests/fuzz/laz/chunk_decoding.h"
#include "tests/fuzz/laz/chunk_input.h"
#include "tests/fuzz/laz/record_mutation.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace albtpu;
using namespace albtpu::fuzz;

std::string Mutated(std::string bytes, std::size_t most) {
  const std::size_t size = bytes.size();
  if (size >= most) return bytes.substr(0, most);
  bytes.resize(most);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, most));
  return bytes;
}

// The chunk of other records. Empty if the input cannot be decoded.
std::string OtherRecords(std::minstd_rand& random, const ChunkInput& input, std::string head) {
  const std::size_t length = input.record_length();
  std::string records = DecodeChunk(*input.coding->decoder, input.bytes, length, input.points, input.decoded,
                                    kMostPoints, input.exact)
                            .records;
  if (records.empty()) return "";
  for (std::size_t i = 0, changes = 1 + random() % 4; i < changes; ++i) {
    ChangeRecords(random, input.coding->point_format, length, kMostPoints, records);
  }
  std::string bytes;
  input.coding->encoder->Encode(records, bytes);
  return WithPoints(head, records.size() / length) + bytes;
}

struct Layers {
  std::string first_record;
  std::uint32_t points = 0;
  std::vector<std::string> streams;
};

Layers Split(std::string_view bytes, std::size_t record_length, std::size_t count) {
  Layers layers;
  layers.first_record = bytes.substr(0, record_length);
  bytes.remove_prefix(record_length);
  std::vector<std::uint32_t> sizes(1 + count);  // The number of points first.
  std::memcpy(sizes.data(), bytes.data(), sizes.size() * sizeof sizes[0]);
  bytes.remove_prefix(sizes.size() * sizeof sizes[0]);
  layers.points = sizes[0];
  for (std::size_t i = 1; i <= count; ++i) {
    layers.streams.emplace_back(bytes.substr(0, sizes[i]));
    bytes.remove_prefix(layers.streams.back().size());
  }
  return layers;
}

std::string Join(const Layers& layers) {
  std::string sizes(reinterpret_cast<const char*>(&layers.points), sizeof layers.points), streams;
  for (const std::string& stream : layers.streams) {
    const auto size = static_cast<std::uint32_t>(stream.size());
    sizes.append(reinterpret_cast<const char*>(&size), sizeof size);
    streams += stream;
  }
  return layers.first_record + sizes + streams;
}

std::string OtherStreams(std::minstd_rand& random, const ChunkInput& input, std::size_t most) {
  const std::size_t length = input.record_length(), count = LayerCount(input.coding->record);
  const std::size_t fixed = length + (count > 0 ? (1 + count) * sizeof(std::uint32_t) : 0);
  if (input.bytes.size() < fixed) return Mutated(std::string(input.bytes), most);
  if (count == 0) {
    return std::string(input.bytes.substr(0, length)) +
           Mutated(std::string(input.bytes.substr(length)), most - std::min(most, length));
  }
  Layers layers = Split(input.bytes, length, count);
  layers.points = static_cast<std::uint32_t>(input.points);
  std::string& stream = layers.streams[random() % count];
  const std::size_t others =
      std::accumulate(layers.streams.begin(), layers.streams.end(), fixed - stream.size(),
                      [](std::size_t sum, const std::string& each) { return sum + each.size(); });
  if (random() % 8 == 0) {
    stream = layers.streams[random() % count];
  } else {
    stream = Mutated(stream, most - std::min(most, others));
  }
  return Join(layers);
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
  const std::string head(reinterpret_cast<const char*>(data), kChunkHeadSize);
  const std::string changed = random() % 4 == 0
                                  ? OtherRecords(random, input, head)
                                  : head + OtherStreams(random, input, max_size - kChunkHeadSize);
  if (changed.empty() || changed.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, changed.data(), changed.size());
  return changed.size();
}
