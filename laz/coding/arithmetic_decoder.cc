#include "laz/coding/arithmetic_decoder.h"

#include <algorithm>

namespace albtpu::laz {
namespace {

// The number of zeros after the end that are given at a time.
constexpr std::size_t kZeros = 64;

}  // namespace

ByteWindow::Piece ByteWindow::Begin(const ByteSource& source, std::uint64_t begin, std::uint64_t end,
                                    std::size_t piece_size) {
  source_ = &source;
  piece_size_ = piece_size;
  end_ = end;
  status_ = absl::OkStatus();
  return PieceAt(begin);
}

ByteWindow::Piece ByteWindow::Continue(const std::uint8_t* next) { return PieceAt(position(next)); }

ByteWindow::Piece ByteWindow::PieceAt(std::uint64_t begin) {
  piece_begin_ = begin;
  const std::uint64_t left = begin < end_ && status_.ok() ? end_ - begin : 0;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(left, piece_size_));
  bytes_.resize(std::max(bytes_.size(), size + kZeros));
  if (size > 0) status_ = source_->ReadAt(begin, {reinterpret_cast<char*>(bytes_.data()), size});
  if (!status_.ok()) std::fill_n(bytes_.begin(), size, std::uint8_t{0});
  // More bytes follow, or zeros.
  const std::size_t zeros = size == left ? kZeros : 0;
  std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(size), zeros, std::uint8_t{0});
  return {bytes_.data(), bytes_.data() + size + zeros - kPeekSize};
}

}  // namespace albtpu::laz
