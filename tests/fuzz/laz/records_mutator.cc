// Mutates the records of laz_records_fuzz field by field; some inputs byte by byte.
#include <algorithm>
#include <cstring>
#include <random>
#include <string>

#include "tests/fuzz/laz/chunk_input.h"
#include "tests/fuzz/laz/record_mutation.h"
#include "tests/fuzz/mutation.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace albtpu::fuzz;
  std::minstd_rand random(seed);
  if (size < kChunkHeadSize || random() % 16 == 0) return LLVMFuzzerMutate(data, size, max_size);
  const ChunkInput input = ParseChunkInput({reinterpret_cast<const char*>(data), size});
  const std::size_t length = input.record_length();
  const std::size_t most = std::min(kMostPoints, (max_size - kChunkHeadSize) / length);
  std::string records(input.bytes.substr(0, std::min(most, input.bytes.size() / length) * length));
  if (records.empty()) return LLVMFuzzerMutate(data, size, max_size);
  for (std::size_t i = 0, changes = 1 + random() % 4; i < changes; ++i)
    ChangeRecords(random, input.coding->point_format, length, most, records);
  std::memcpy(data + kChunkHeadSize, records.data(), records.size());
  return kChunkHeadSize + records.size();
}
