// A unit of work: the smallest part of a campaign, computed independently of all others. Its result is a sealed string
// of bytes, the same in memory, between ranks and on disk, so that a table has the same numbers however it is computed.
#pragma once

#include <compare>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "generator/campaign/campaign.h"
#include "generator/math/statistics.h"
#include "generator/monte_carlo/monte_carlo.h"

namespace albtpu {

enum class UnitKind {
  kSeaCase,    // `index` counts the sea cases of the campaign
  kWaterCase,  // the same for a campaign of the water column
  kPulse,      // `index` counts the pulses at which the table is checked (interpolation_check.h)
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
  std::string campaign;  // SHA-256 of its text, and of the sea of a file, in hexadecimal digits
  std::string program;   // version and commit
  std::string instruction_set;
};
UnitOrigin OriginOf(const Campaign& campaign);  // when computed by this program on this machine

// Results as bytes, with every number exactly as it was computed. Decoding fails with DataLoss when the bytes are not a
// result in the format of this program.
std::string EncodeResult(const SeaCaseResult& result);
absl::StatusOr<SeaCaseResult> DecodeResult(std::string_view bytes);

// The same for the results of ComputeDirectly (interpolation_check.h, water_cases.h) and of water cases.
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

}  // namespace albtpu
