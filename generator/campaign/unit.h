// A unit of work: the smallest part of a campaign, computed independently of all others. Its result is a sealed string
// of bytes, the same in memory, between ranks and on disk, so that a table has the same numbers however it is computed.
#pragma once

#include <bit>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"

namespace albtpu {

enum class UnitKind {
  kSeaCase,    // `index` counts the sea cases of the campaign
  kWaterCase,  // the same for a campaign of the water column
  kPulse,      // `index` counts the pulses at which the table is checked (provenance.h)
};

struct UnitId {
  UnitKind kind = UnitKind::kSeaCase;
  std::size_t index = 0;

  auto operator<=>(const UnitId&) const = default;
};

std::string Name(UnitId unit);  // "encounter-00012", "water-00001", "pulse-00003"

// All units of a campaign, in the order in which they are computed.
std::vector<UnitId> UnitsOf(const Campaign& campaign);

// Everything on which the last bit of a unit depends. All units of a table have the same origin.
struct UnitOrigin {
  std::string campaign;  // SHA-256 of its text, in hexadecimal digits
  std::string program;   // version and commit
  std::string instruction_set;
};
UnitOrigin OriginOf(const Campaign& campaign);  // when computed by this program on this machine

// Results as bytes, with every number exactly as it was computed. Decoding fails with DataLoss when the bytes are not a
// result in the format of this program.
std::string EncodeResult(const SeaCaseResult& result);
absl::StatusOr<SeaCaseResult> DecodeResult(std::string_view bytes);

// The same for the results of ComputeDirectly (provenance.h, water_cases.h) and of water cases.
std::string EncodeEstimates(const std::vector<Estimate>& estimates);
absl::StatusOr<std::vector<Estimate>> DecodeEstimates(std::string_view bytes);

// The bytes of a unit. Integers are little-endian with 64 bits; a text is its number of bytes, then the bytes:
//   8 bytes magic, integer format version, text campaign, text program, text instruction set, text kind,
//   integer index, text content, 32 bytes SHA-256 of everything before.
std::string SealUnit(UnitId unit, const UnitOrigin& origin, std::string_view content);

// The content of a sealed unit, a part of `bytes`. DataLoss: not a unit, or damaged. FailedPrecondition: of another
// format, campaign, program or instruction set, or a unit other than `unit`. Messages continue a sentence that begins
// with the name of a file and a colon.
absl::StatusOr<std::string_view> OpenUnit(UnitId unit, const UnitOrigin& origin, std::string_view bytes);

// Converts values to bytes and back without loss, little-endian: integers with 64 bits, floating-point numbers as
// doubles. A text and a list begin with their size in 64 bits.
//
// A struct is supported by a function that names its fields (unit.cc has examples):
//   template <typename Stream, SameStruct<MyStruct> Self>
//   void Fields(Stream& stream, Self& self);  // calls stream(self.a, self.b, ...)

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
    if constexpr (std::floating_point<Value>)
      Append(static_cast<double>(value));
    else if constexpr (std::integral<Value>)
      Append(static_cast<std::uint64_t>(value));
    else if constexpr (std::convertible_to<Value, std::string_view>)
      Write(std::string_view(value));
    else
      Fields(*this, value);
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
    if constexpr (std::floating_point<Value>)
      value = static_cast<Value>(Next<double>());
    else if constexpr (std::integral<Value>)
      value = static_cast<Value>(Next<std::uint64_t>());
    else
      Fields(*this, value);
  }

  void Short() {
    enough_ = false;
    rest_ = {};
  }

  std::string_view rest_;
  bool enough_ = true;
};

}  // namespace albtpu
