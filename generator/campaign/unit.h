// A unit of work: what can be computed alone, anywhere, and is whole or not there. Its result is sealed
// bytes, in memory, between ranks and on disk alike, so that every way to a table goes through the same
// numbers.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"

namespace albtpu {

enum class UnitKind {
  kSeaCase,  // `index` counts the sea cases of the campaign
  kPulse,    // `index` counts the pulses that the table is held to (interpolation_check.h)
};

struct UnitId {
  UnitKind kind = UnitKind::kSeaCase;
  std::size_t index = 0;

  auto operator<=>(const UnitId&) const = default;
};

std::string Name(UnitId unit);  // "encounter-00012"

// All units of a campaign, in the order in which they are worked off.
std::vector<UnitId> UnitsOf(const Campaign& campaign);

// What a unit's last bit depends on: units of one table have one origin.
struct UnitOrigin {
  std::string campaign;  // SHA-256 of its text, in hexadecimal digits
  std::string program;   // version and commit
  std::string instruction_set;
};
UnitOrigin OriginOf(const Campaign& campaign);  // worked off by this program on this machine

// The bytes of a unit. Integers are little-endian and of 64 bits, a text is the count of its bytes and its
// bytes:
//   8 bytes magic, integer format version, text campaign, program, instruction set, kind, integer index,
//   text content, 32 bytes SHA-256 of all before.
std::string SealUnit(UnitId unit, const UnitOrigin& origin, std::string_view content);

// The content of a sealed unit, a part of `bytes`. DataLoss: foreign or damaged. FailedPrecondition: of
// another format, campaign, program, instruction set, or another unit than `unit`. Messages say what is wrong
// and what would be right, as after the name of a file and a colon.
absl::StatusOr<std::string_view> OpenUnit(UnitId unit, const UnitOrigin& origin, std::string_view bytes);

}  // namespace albtpu
