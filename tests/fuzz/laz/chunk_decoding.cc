#include "tests/fuzz/laz/chunk_decoding.h"

#include <algorithm>
#include <cstring>

#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

constexpr std::uint64_t kBegin = 1000;  // Of the chunk in its source.

// A chunk amid a file whose other bytes must not be read.
class ChunkSource final : public laz::ByteSource {
 public:
  explicit ChunkSource(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return kBegin + bytes_.size() + 1000; }
  absl::Status ReadAt(std::uint64_t offset, std::span<char> to) const override {
    ALBTPU_MUST(offset >= kBegin && offset <= kBegin + bytes_.size());
    ALBTPU_MUST(to.size() <= kBegin + bytes_.size() - offset);
    std::memcpy(to.data(), bytes_.data() + (offset - kBegin), to.size());
    return absl::OkStatus();
  }

 private:
  std::string_view bytes_;
};

}  // namespace

DecodedChunk DecodeChunk(laz::ChunkDecoder& decoder, std::string_view bytes, std::size_t record_length,
                         std::uint64_t points, std::size_t decoded, std::size_t step, bool exact) {
  const ChunkSource source(bytes);
  DecodedChunk chunk;
  chunk.status = decoder.Begin(source, kBegin, kBegin + bytes.size(), points);
  if (!chunk.status.ok()) return chunk;
  chunk.records.resize(decoded * record_length);
  for (std::size_t i = 0; i < decoded && chunk.status.ok(); i += step) {
    const std::size_t count = std::min(step, decoded - i);
    chunk.status = decoder.Decode({chunk.records.data() + i * record_length, count * record_length});
  }
  if (!chunk.status.ok() || decoded < points) return chunk;
  chunk.status = decoder.End(exact);
  if (!chunk.status.ok()) return chunk;
  ALBTPU_MUST(decoder.position() > kBegin && decoder.position() <= kBegin + bytes.size());
  chunk.position = decoder.position() - kBegin;
  return chunk;
}

void MustSurviveCoding(ChunkCoding& coding, std::string_view records) {
  const std::size_t record_length = coding.record.record_length(), points = records.size() / record_length;
  std::string bytes;
  coding.encoder->Encode(records, bytes);
  const DecodedChunk again = DecodeChunk(*coding.decoder, bytes, record_length, points, points, points, true);
  ALBTPU_MUST(again.status.ok());
  ALBTPU_MUST(again.records == records);
  ALBTPU_MUST(again.position == bytes.size());
}

}  // namespace albtpu::fuzz
