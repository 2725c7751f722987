// Reads and writes numbers in the bytes of LAS and LAZ files, which are little-endian, packed and unaligned.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace albtpu::laz {

static_assert(std::endian::native == std::endian::little, "fields are copied as they lie in memory");

// Requires that `bytes` extends to the end of the number.
template <typename Number>
Number Load(std::string_view bytes, std::size_t offset) {
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof number);
  return number;
}

template <typename Number>
void Store(Number number, char* destination) {
  std::memcpy(destination, &number, sizeof number);
}

}  // namespace albtpu::laz
