// A run of bytes of a source, read front to back through a window of bounded size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "absl/status/status.h"
#include "formats/laz/coding/byte_source.h"

namespace albtpu::laz {

// Zeros follow the last byte without end, and follow a failure to read. The reader keeps its place in the window.
class ByteWindow {
 public:
  static constexpr std::size_t kPeekSize = 4;
  static constexpr std::size_t kPieceSize = 1 << 18;  // Holds the layers of common chunks whole.

  // A part of the bytes, in memory. At least kPeekSize bytes follow `next` as long as it is not behind `last`.
  struct Piece {
    const std::uint8_t *next = nullptr, *last = nullptr;
  };

  // The bytes from `begin` to `end`, which must lie in the source, at most `piece_size` at a time. `source` must
  // outlive the reading.
  Piece Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end, std::size_t piece_size);

  // The bytes from `next` on, where `next` is at most kPeekSize bytes behind the last of the piece before.
  Piece Continue(const std::uint8_t* next);

  // The position of `next` in the source, even beyond its end.
  std::uint64_t position(const std::uint8_t* next) const {
    return piece_begin_ + static_cast<std::uint64_t>(next - bytes_.data());
  }
  std::uint64_t end() const { return end_; }
  const absl::Status& status() const { return status_; }

 private:
  Piece PieceAt(std::uint64_t begin);

  std::vector<std::uint8_t> bytes_;
  const ByteSource* source_ = nullptr;
  std::size_t piece_size_ = kPieceSize;
  std::uint64_t piece_begin_ = 0, end_ = 0;
  absl::Status status_;
};

}  // namespace albtpu::laz
