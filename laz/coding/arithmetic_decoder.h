// Decoding of compressed bytes: their source, the window through which it is read, the arithmetic decoder of LASzip
// files, and errors of damaged bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "laz/coding/symbol_model.h"

namespace albtpu::laz {

// A source of compressed bytes: a file, or memory.

// Any number of threads may read at a time.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  // Requires offset + bytes.size() <= size(). Fails when the file cannot be read.
  virtual absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const = 0;
};

// Bytes that are in memory already, and stay there.
class MemorySource : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  absl::Status ReadAt(std::uint64_t offset, std::span<char> bytes) const override {
    std::memcpy(bytes.data(), bytes_.data() + offset, bytes.size());
    return absl::OkStatus();
  }

 private:
  std::string_view bytes_;
};

// A run of bytes of a source, read front to back through a window of bounded size.

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

// The arithmetic decoder of LASzip files (A. Said, HPL-2004-76, section 2.3; an interval of 32 bits that is
// renormalized bytewise).
//
// Invariant: value_ < length_ for any bytes, so that no bytes lead outside of a model.
//
// Each symbol depends on the one before it. Hot loops therefore work on a local copy, whose members stay in registers
// as long as all functions that use it are inlined, and store the copy at the end.
class ArithmeticDecoder {
 public:
  static constexpr bool kEncodes = false;
  template <int kMost>
  using Model = SymbolModel<kMost, true>;

  // Decodes the bytes from `begin` to `end` of the source through the window, both of which must outlive the decoding.
  // Has at most `piece_size` of them in memory.
  void Begin(ByteWindow& window, const ByteSource& source, std::uint64_t begin, std::uint64_t end,
             std::size_t piece_size = ByteWindow::kPieceSize) {
    window_ = &window;
    Take(window.Begin(source, begin, end, piece_size));
    length_ = 0xFFFFFFFFu;
    value_ = Peek();
    Skip(4);
    value_ -= value_ == length_;
  }

  // Like Symbol() of the encoder: each returns the symbol, so that one function describes both directions.
  template <int kMost>
  [[gnu::always_inline]] std::uint32_t Symbol(SymbolModel<kMost, true>& model,
                                              std::uint32_t /*known when encoding*/ = 0) {
    model.Prepare();
    const std::uint32_t part = length_ >> kProbabilityBits;
    const std::uint32_t symbol = model.SymbolAt(value_ / part);
    const std::uint32_t below = model.Below(symbol) * part;
    value_ -= below;
    // The last symbol has the rest of the interval. No branch: which symbol it is cannot be predicted.
    std::uint32_t above = model.Below(symbol + 1) * part;
    above = symbol == model.last_symbol() ? length_ : above;
    length_ = above - below;
    Renormalize();
    model.Count(symbol);
    return symbol;
  }

  [[gnu::always_inline]] bool Bit(BitModel& model) {
    const std::uint32_t zero = model.zero() * (length_ >> BitModel::kProbabilityBits);
    const bool bit = value_ >= zero;
    value_ -= bit ? zero : 0;
    length_ = bit ? length_ - zero : zero;
    Renormalize();
    model.Count(bit);
    return bit;
  }

  // 1 to 32 bits of equal probabilities, which damaged bytes may exceed by some.
  [[gnu::always_inline]] std::uint32_t Bits(int count, std::uint32_t /*known when encoding*/ = 0) {
    std::uint32_t low = 0;
    int low_count = 0;
    if (count > 19) {
      low_count = 16;
      low = FewBits(low_count) & 0xFFFF;
    }
    return FewBits(count - low_count) << low_count | low;
  }

  std::uint64_t Bits64(std::uint64_t /*known when encoding*/ = 0) {
    const std::uint64_t low = Bits(32);
    return std::uint64_t{Bits(32)} << 32 | low;
  }

  // Behind the last byte that was read, in the source.
  std::uint64_t position() const { return window_->position(next_); }
  // Bytes that were missing at the end.
  std::uint64_t missing() const { return position() > window_->end() ? position() - window_->end() : 0; }
  const absl::Status& status() const { return window_->status(); }

 private:
  [[gnu::always_inline]] std::uint32_t FewBits(int count) {
    const std::uint32_t bits = value_ / (length_ >>= count);
    value_ -= bits * length_;
    Renormalize();
    return bits;
  }

  // Shifts bytes into the interval until it is at least 2^24 long. Requires that it is not empty.
  [[gnu::always_inline]] void Renormalize() {
    const int bits = __builtin_clz(length_) & 24;  // std::countl_zero() would look whether it is 0.
    value_ = static_cast<std::uint32_t>(((std::uint64_t{value_} << 32) | Peek()) << bits >> 32);
    length_ <<= bits;
    Skip(static_cast<std::uint32_t>(bits) / 8);
  }

  // The next four bytes, of which the first is the most significant.
  std::uint32_t Peek() const {
    std::uint32_t bytes;
    std::memcpy(&bytes, next_, sizeof bytes);
    return __builtin_bswap32(bytes);
  }

  void Skip(std::uint32_t count) {
    next_ += count;
    if (next_ > last_) [[unlikely]]
      Take(window_->Continue(next_));
  }

  void Take(const ByteWindow::Piece& piece) {
    next_ = piece.next;
    last_ = piece.last;
  }

  std::uint32_t value_ = 0, length_ = 0xFFFFFFFFu;
  const std::uint8_t *next_ = nullptr, *last_ = nullptr;  // As in ByteWindow::Piece.
  ByteWindow* window_ = nullptr;
};

// Errors about bytes that contradict each other.

inline constexpr char kGetAnotherCopy[] = "; get another copy of the file";

// DataLoss; `problem` in pieces, as for StrCat().
template <typename... Pieces>
absl::Status Damaged(const Pieces&... problem) {
  return absl::DataLossError(absl::StrCat(problem..., kGetAnotherCopy));
}

}  // namespace albtpu::laz
