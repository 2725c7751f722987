#include "tests/fuzz/laz/chunk_input.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>

#include "absl/status/statusor.h"
#include "tests/formats/las/las_builder.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

using laz::LaszipRecord;

constexpr int kFormats = 11, kFirstLayeredFormat = 6;
constexpr std::size_t kExtraBytes[] = {0, 1, 2, 7};  // Choices, to keep few decoders.
enum Flag : std::uint8_t { kVersion4 = 1, kExactEnd = 2 };

// Numbers of points that no chunk of an input has.
constexpr std::uint64_t kManyPoints[] = {241, 50000, 0x7FFFFFFF, 0xFFFFFFFF, std::uint64_t{1} << 32};
constexpr std::uint8_t kMostInByte = 240;

LaszipRecord OfVersion4(LaszipRecord record, int point_format) {
  for (laz::Item& item : record.items) item.version = 4;
  const absl::StatusOr<LaszipRecord> parsed =
      laz::ParseLaszipRecord(laz::LaszipRecordData(record), point_format, record.record_length());
  ALBTPU_MUST(parsed.ok());
  return *parsed;
}

// The codings of all formats are megabytes of models, of which few stay in a cache: so none is made twice.
ChunkCoding& CodingFor(int point_format, std::size_t extra, bool version4) {
  static std::array<ChunkCoding, kFormats * std::size(kExtraBytes) * 2> all;
  ChunkCoding& coding = all[(static_cast<std::size_t>(point_format) * std::size(kExtraBytes) + extra) * 2 + version4];
  if (coding.decoder == nullptr) {
    coding.point_format = point_format;
    coding.record =
        laz::RecordFor(point_format, testing::PointSize(point_format) + kExtraBytes[extra], laz::kCommonChunkSize);
    if (version4) {
      coding.record = OfVersion4(coding.record, point_format);
      coding.encoded = &CodingFor(point_format, extra, false);
    } else {
      coding.encoder = laz::ChunkEncoder::For(coding.record);
      coding.encoded = &coding;
    }
    coding.decoder = laz::ChunkDecoder::For(coding.record);
    if (point_format >= kFirstLayeredFormat)
      coding.returns_decoder = laz::ChunkDecoder::For(coding.record, laz::WantedFields::kReturns);
  }
  return coding;
}

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

ChunkInput ParseChunkInput(std::string_view input) {
  const auto head = [&](std::size_t i) { return static_cast<std::uint8_t>(input[i]); };
  const int point_format = head(0) % kFormats;
  const bool version4 = point_format >= kFirstLayeredFormat && (head(2) & kVersion4) != 0;
  ChunkInput chunk;
  chunk.coding = &CodingFor(point_format, head(1) % std::size(kExtraBytes), version4);
  chunk.exact = head(2) & kExactEnd;
  chunk.points = head(3) <= kMostInByte ? std::max<std::uint64_t>(head(3), 1)
                                        : kManyPoints[(head(3) - kMostInByte) % std::size(kManyPoints)];
  chunk.decoded = static_cast<std::size_t>(std::min<std::uint64_t>(chunk.points, kMostPoints));
  chunk.step = 1 + head(4) % kMostPoints;
  chunk.bytes = input.substr(kChunkHeadSize);
  return chunk;
}

std::string WithPoints(std::string head, std::size_t points) {
  ALBTPU_MUST(points >= 1 && points <= kMostInByte);
  head[3] = static_cast<char>(points);
  return head;
}

std::size_t LayerCount(const LaszipRecord& record) {
  std::size_t count = 0;
  for (const laz::Item& item : record.items) {
    switch (item.type) {
      case laz::ItemType::kPoint14:
        count += 9;  // Place, height, class, flags, intensity, scan angle, user data, source, time.
        break;
      case laz::ItemType::kRgbNir14:
        count += 2;
        break;
      case laz::ItemType::kRgb14:
      case laz::ItemType::kWavePacket14:
        count += 1;
        break;
      case laz::ItemType::kByte14:
        count += item.size;
        break;
      default:  // Items of chunks that are not layered.
        break;
    }
  }
  return count;
}

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

void MustSurviveCoding(ChunkCoding& coding, std::string_view records, std::span<const std::string_view> known) {
  const std::size_t record_length = coding.record.record_length(), points = records.size() / record_length;
  std::string bytes;
  coding.encoder->Encode(records, bytes, known);
  const DecodedChunk again = DecodeChunk(*coding.decoder, bytes, record_length, points, points, points, true);
  ALBTPU_MUST(again.status.ok());
  ALBTPU_MUST(again.records == records);
  ALBTPU_MUST(again.position == bytes.size());
}

}  // namespace albtpu::fuzz
