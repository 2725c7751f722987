// Reads and writes numbers in the bytes of a LAS file, which are little-endian, packed and unaligned.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace albtpu::client {

static_assert(std::endian::native == std::endian::little, "LAS fields are copied as they lie in memory");

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

}  // namespace albtpu::client
