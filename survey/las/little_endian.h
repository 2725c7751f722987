// Numbers in the bytes of a LAS file, which is little-endian, unaligned and packed.
#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace albtpu::client {

static_assert(std::endian::native == std::endian::little, "LAS fields are copied as they lie in memory");

// Requires that the bytes are there.
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
