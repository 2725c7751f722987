#include "formats/laz/items/pointwise_decoder.h"

#include <cassert>
#include <cstring>

#include "formats/laz/coding/damage.h"

namespace albtpu::laz {

absl::Status PointwiseDecoder::Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                     [[maybe_unused]] std::uint64_t points) {
  assert(points > 0 && begin <= end && end <= source.size());
  begin_ = begin;
  end_ = end;
  if (end - begin < record_length_) {
    return Damaged("it has ", end - begin, " bytes (expected ", record_length_, " and more for its points)");
  }
  first_.resize(record_length_);
  if (absl::Status status = source.ReadAt(begin, first_); !status.ok()) return status;
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

}  // namespace albtpu::laz
