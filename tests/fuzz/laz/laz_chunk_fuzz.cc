// Arbitrary bytes as a chunk of a LAZ file are rejected with a reason, or decoded from no byte that is not the chunk's:
// to the same records in steps of any size. The records survive coding.
#include <functional>
#include <string_view>

#include "formats/laz/items/point14_fields.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/laz/chunk_decoding.h"
#include "tests/fuzz/laz/chunk_input.h"

namespace {

using namespace albtpu;
using namespace albtpu::fuzz;

constexpr std::size_t kComparedInEvery = 8;  // Inputs: each coding takes as long as the first.

DecodedChunk Decode(const ChunkInput& chunk, std::string_view bytes, std::size_t step, bool exact) {
  return DecodeChunk(*chunk.coding->decoder, bytes, chunk.record_length(), chunk.points, chunk.decoded, step, exact);
}

// The fields of WantedFields::kReturns are the same in both.
bool HaveSameReturns(std::string_view one, std::string_view other, std::size_t record_length) {
  const auto same = [&](std::size_t begin, std::size_t size) {
    return one.substr(begin, size) == other.substr(begin, size);
  };
  const auto channel = [](char flags) { return laz::ScannerChannel(static_cast<std::uint8_t>(flags)); };
  for (std::size_t at = 0; at < one.size(); at += record_length) {
    const std::size_t flags = at + laz::kFlagsOffset;
    if (!same(at + laz::kXOffset, 12) || !same(at + laz::kReturnsOffset, 1) || !same(at + laz::kClassOffset, 1) ||
        !same(at + laz::kTimeOffset, 8) || channel(one[flags]) != channel(other[flags]))
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
  MustSurviveCoding(*chunk.coding->encoded, whole.records);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < kChunkHeadSize) return 0;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const ChunkInput chunk = ParseChunkInput(input);
  const DecodedChunk whole = Decode(chunk, chunk.bytes, kMostPoints, chunk.exact);
  if (whole.status.ok())
    ALBTPU_MUST(whole.position == chunk.bytes.size() || !chunk.exact || chunk.decoded < chunk.points);
  else
    ALBTPU_MUST(absl::IsDataLoss(whole.status) && whole.status.message().size() > 20);
  if (std::hash<std::string_view>()(input) % kComparedInEvery == 0) Compare(chunk, whole);
  return 0;
}
