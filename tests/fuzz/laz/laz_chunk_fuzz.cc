// Arbitrary bytes as a chunk of a LAZ file are rejected with a reason, or decoded to the same records in steps of any
// size, from no byte that is not the chunk's. The records survive coding.
#include <string_view>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/laz/chunk_decoding.h"
#include "tests/fuzz/laz/chunk_input.h"

namespace {

using namespace albtpu;
using namespace albtpu::fuzz;

DecodedChunk Decode(const ChunkInput& chunk, std::string_view bytes, std::size_t step, bool exact) {
  return DecodeChunk(*chunk.coding->decoder, bytes, chunk.record_length(), chunk.points, chunk.decoded, step,
                     exact);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kChunkHeadSize) return 0;
  const ChunkInput chunk = ParseChunkInput({reinterpret_cast<const char*>(data), size});
  const DecodedChunk whole = Decode(chunk, chunk.bytes, kMostPoints, chunk.exact);
  const DecodedChunk again = Decode(chunk, chunk.bytes, chunk.step, chunk.exact);
  ALBTPU_MUST(whole.status.ok() == again.status.ok());
  if (!whole.status.ok()) {
    ALBTPU_MUST(absl::IsDataLoss(whole.status));
    ALBTPU_MUST(whole.status.message().size() > 20);
    return 0;
  }
  ALBTPU_MUST(whole.records == again.records && whole.position == again.position);
  ALBTPU_MUST(whole.position == chunk.bytes.size() || !chunk.exact || chunk.decoded < chunk.points);
  if (!chunk.exact && chunk.decoded == chunk.points) {
    // A chunk whose end was not known is the same when it is known.
    const DecodedChunk cut = Decode(chunk, chunk.bytes.substr(0, whole.position), chunk.step, true);
    ALBTPU_MUST(cut.status.ok() && cut.records == whole.records && cut.position == whole.position);
  }
  if (chunk.code_again) MustSurviveCoding(*chunk.coding, whole.records);
  return 0;
}
