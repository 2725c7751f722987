// Point records of one length that lie one after the other: a decoder fills them, and an encoder reads them.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace albtpu::laz {

template <typename Coder>
class RecordRun {
 public:
  using Byte = std::conditional_t<Coder::kEncodes, const char, char>;

  RecordRun(Byte* first, std::size_t record_length, std::size_t count)
      : first_(first), record_length_(record_length), count_(count) {}

  std::size_t count() const { return count_; }
  std::size_t record_length() const { return record_length_; }
  Byte* operator[](std::size_t i) const { return first_ + i * record_length_; }

  // Whether the condition holds for one of the records, up to which they are looked at.
  template <typename Condition>
  bool Any(const Condition& holds) const {
    for (std::size_t i = 0; i < count_; ++i)
      if (holds((*this)[i])) return true;
    return false;
  }

  // The number at `offset` of a record, for an encoder to write; 0 for a decoder.
  template <typename Number>
  Number Known(std::size_t i, std::size_t offset) const {
    Number number{};
    if constexpr (Coder::kEncodes) std::memcpy(&number, (*this)[i] + offset, sizeof number);
    return number;
  }

  // Stores what a decoder has read. Does nothing for an encoder.
  template <typename Number>
  void Set(std::size_t i, std::size_t offset, Number number) const {
    if constexpr (!Coder::kEncodes) std::memcpy((*this)[i] + offset, &number, sizeof number);
  }

 private:
  Byte* first_;
  std::size_t record_length_, count_;
};

}  // namespace albtpu::laz
