// Arbitrary records of every point format are the same after they have been encoded and decoded.
#include <algorithm>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/laz/chunk_decoding.h"
#include "tests/fuzz/laz/chunk_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace albtpu::fuzz;
  if (size < kChunkHeadSize) return 0;
  const ChunkInput input = ParseChunkInput({reinterpret_cast<const char*>(data), size});
  const std::size_t points = std::min(kMostPoints, input.bytes.size() / input.record_length());
  if (points > 0) MustSurviveCoding(*input.coding->encoded, input.bytes.substr(0, points * input.record_length()));
  return 0;
}
