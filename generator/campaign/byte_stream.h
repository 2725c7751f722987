// Converts values to bytes and back without loss, little-endian: integers with 64 bits, floating-point numbers as
// doubles. A text and a list begin with their size in 64 bits.
//
// A struct is supported by a function that names its fields (unit.cc has examples):
//   template <typename Stream, SameStruct<MyStruct> Self>
//   void Fields(Stream& stream, Self& self);  // calls stream(self.a, self.b, ...)
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace albtpu {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are in memory");

template <typename Self, typename Struct>
concept SameStruct = std::same_as<std::remove_const_t<Self>, Struct>;

class ByteWriter {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    (Write(values), ...);
  }

  std::string Take() && { return std::move(bytes_); }

 private:
  template <typename Number>
  void Append(Number number) {
    static_assert(sizeof number == 8);
    bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
  }

  void Write(std::string_view text) {
    Append(std::uint64_t{text.size()});
    bytes_.append(text);
  }
  template <typename Item>
  void Write(const std::vector<Item>& list) {
    Append(std::uint64_t{list.size()});
    for (const Item& item : list) Write(item);
  }
  template <typename Value>
  void Write(const Value& value) {
    if constexpr (std::floating_point<Value>) {
      Append(static_cast<double>(value));
    } else if constexpr (std::integral<Value>) {
      Append(static_cast<std::uint64_t>(value));
    } else if constexpr (std::convertible_to<Value, std::string_view>) {
      Write(std::string_view(value));
    } else {
      Fields(*this, value);
    }
  }

  std::string bytes_;
};

// Reads the output of a ByteWriter. When there are too few bytes, the remaining values are zeros, empty texts and empty
// lists.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <typename... Values>
  void operator()(Values&... values) {
    (Read(values), ...);
  }

  // Whether the values took up exactly all bytes.
  bool ReadAll() const { return enough_ && rest_.empty(); }

 private:
  template <typename Number>
  Number Next() {
    static_assert(sizeof(Number) == 8);
    Number number{};
    if (rest_.size() < sizeof number) return Short(), number;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }

  void Read(std::string_view& text) {  // refers to the bytes that are read
    std::uint64_t count = Next<std::uint64_t>();
    if (count > rest_.size()) Short(), count = 0;
    text = rest_.substr(0, count);
    rest_.remove_prefix(count);
  }
  template <typename Item>
  void Read(std::vector<Item>& list) {
    std::uint64_t count = Next<std::uint64_t>();
    if (count > rest_.size() / 8) Short(), count = 0;  // no item has less than 8 bytes
    list.resize(count);
    for (Item& item : list) Read(item);
  }
  template <typename Value>
  void Read(Value& value) {
    if constexpr (std::floating_point<Value>) {
      value = static_cast<Value>(Next<double>());
    } else if constexpr (std::integral<Value>) {
      value = static_cast<Value>(Next<std::uint64_t>());
    } else {
      Fields(*this, value);
    }
  }

  void Short() {
    enough_ = false;
    rest_ = {};
  }

  std::string_view rest_;
  bool enough_ = true;
};

}  // namespace albtpu
