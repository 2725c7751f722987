#include "laz/items/chunk_decoder.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string_view>

#include "laz/coding/little_endian.h"
#include "status/status_macros.h"

namespace albtpu::laz {
absl::Status PointwiseDecoder::Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                     [[maybe_unused]] std::uint64_t points) {
  assert(points > 0 && begin <= end && end <= source.size());
  begin_ = begin;
  end_ = end;
  if (end - begin < record_length_)
    return Damaged("it has ", end - begin, " bytes (expected ", record_length_, " and more for its points)");
  first_.resize(record_length_);
  RETURN_IF_ERROR(source.ReadAt(begin, first_));
  items_.Begin(first_.data());
  decoder_.Begin(window_, source, begin + record_length_, end);
  return CheckBytes();
}

absl::Status PointwiseDecoder::Decode(std::span<char> records) {
  assert(records.size() % record_length_ == 0);
  char* record = records.data();
  char* const end = record + records.size();
  if (!first_.empty() && record != end) {
    std::memcpy(record, first_.data(), record_length_);
    first_.clear();
    record += record_length_;
  }
  ArithmeticDecoder decoder = decoder_;  // Its state stays in registers here.
  for (; record != end; record += record_length_) items_.Code(decoder, record);
  decoder_ = decoder;
  return CheckBytes();
}

absl::Status PointwiseDecoder::End(bool exact) {
  if (absl::Status status = CheckBytes(); !status.ok() || !exact || position() == end_) return status;
  return Damaged("its points end after ", position() - begin_, " of its ", end_ - begin_, " bytes");
}

absl::Status PointwiseDecoder::CheckBytes() const {
  if (!decoder_.status().ok() || decoder_.missing() == 0) return decoder_.status();
  return Damaged("its ", end_ - begin_, " bytes end before its points");
}

namespace {

constexpr std::size_t kNumberSize = sizeof(std::uint32_t);  // Of points, and of bytes of a layer.

// The memory of all layers, except for records of thousands of bytes, each of which has a layer.
constexpr std::size_t kPieceBytes = 16 << 20, kMinPieceSize = 1 << 10;

}  // namespace

LayeredDecoder::LayeredDecoder(const LaszipRecord& record, WantedFields wanted)
    : point_(record),
      wanted_(wanted),
      record_length_(record.record_length()),
      head_(record_length_ + kNumberSize * (1 + point_.streams().size())),
      windows_(point_.streams().size()),
      stream_ends_(point_.streams().size()),
      piece_size_(std::clamp(kPieceBytes / point_.streams().size(), kMinPieceSize, ByteWindow::kPieceSize)) {}

absl::Status LayeredDecoder::Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                   std::uint64_t points) {
  assert(begin <= end && end <= source.size() && points > 0);
  if (end - begin < head_.size())
    return Damaged("it has ", end - begin, " bytes (at least ", head_.size(), " begin a chunk)");
  RETURN_IF_ERROR(source.ReadAt(begin, head_));
  const std::string_view head(head_.data(), head_.size());
  const auto stated = Load<std::uint32_t>(head, record_length_);
  if (stated != points) return Damaged("it states ", stated, " points (expected ", points, ")");
  std::uint64_t layer = begin + head_.size();
  const auto streams = point_.streams();
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const auto size = Load<std::uint32_t>(head, record_length_ + kNumberSize * (1 + i));
    if (size > end - layer) return Damaged("its layer ", i + 1, " ends ", size - (end - layer), " bytes behind it");
    streams[i].present = size > 0 && (wanted_ == WantedFields::kAll || point_.TellsReturns(i));
    if (streams[i].present) streams[i].coder.Begin(windows_[i], source, layer, layer + size, piece_size_);
    stream_ends_[i] = layer += size;
  }
  if (points > 1 && !streams[0].present) return Damaged("it has no layer of coordinates");
  layers_end_ = layer;
  end_ = end;
  point_.Begin(head_.data());
  first_is_next_ = true;
  return absl::OkStatus();
}

absl::Status LayeredDecoder::Decode(std::span<char> records) {
  assert(records.size() % record_length_ == 0);
  char* next = records.data();
  std::size_t left = records.size() / record_length_;
  if (first_is_next_ && left > 0) {
    next = std::copy_n(head_.data(), record_length_, next);
    first_is_next_ = false;
    --left;
  }
  while (left > 0) {
    const std::size_t batch = std::min(left, kBatchPoints);
    point_.Code({next, record_length_, batch});
    RETURN_IF_ERROR(CheckStreams());
    next += batch * record_length_;
    left -= batch;
  }
  return absl::OkStatus();
}

absl::Status LayeredDecoder::CheckStreams() {
  const auto streams = point_.streams();
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (!streams[i].present) continue;
    if (!streams[i].coder.status().ok()) return streams[i].coder.status();
    if (streams[i].coder.missing() > 0) return Damaged("its layer ", i + 1, " ends before its points");
  }
  return absl::OkStatus();
}

absl::Status LayeredDecoder::End(bool exact) {
  RETURN_IF_ERROR(CheckStreams());
  const auto streams = point_.streams();
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (streams[i].present && streams[i].coder.position() != stream_ends_[i]) {
      return Damaged("its layer ", i + 1, " has ", stream_ends_[i] - streams[i].coder.position(),
                     " bytes after its last point");
    }
  }
  if (exact && layers_end_ != end_) return Damaged("it has ", end_ - layers_end_, " bytes after its last layer");
  return absl::OkStatus();
}

}  // namespace albtpu::laz
