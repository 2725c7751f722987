#include "generator/campaign/unit.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "generator/campaign/byte_stream.h"
#include "generator/math/instruction_set.h"
#include "tables/digest.h"
#include "tables/version.h"

namespace albtpu {
namespace {

constexpr std::string_view kMagic =
    "\x89"
    "ALBUNT\n";  // Not text, and changed by text-mode transfers.
constexpr std::uint64_t kFormatVersion = 1;
constexpr std::size_t kDigestSize = std::tuple_size_v<Sha256Digest>;

std::string KindName(UnitKind kind) {
  switch (kind) {
    case UnitKind::kSeaCase:
      return "encounter";
    case UnitKind::kPulse:
      return "pulse";
  }
  return "unknown";
}

Sha256Digest DigestOf(std::string_view bytes) {
  Sha256 sha;
  sha.Update(bytes);
  return sha.Finish();
}

absl::Status Other(const std::string& what) { return absl::FailedPreconditionError(what); }

}  // namespace

std::string Name(UnitId unit) { return absl::StrFormat("%s-%05d", KindName(unit.kind), unit.index); }

std::vector<UnitId> UnitsOf(const Campaign& campaign) {
  std::vector<UnitId> units;
  for (std::size_t i = 0; i < SeaCaseCount(campaign); ++i) units.push_back({UnitKind::kSeaCase, i});
  for (std::size_t i = 0; i < campaign.checked_pulses; ++i) units.push_back({UnitKind::kPulse, i});
  return units;
}

UnitOrigin OriginOf(const Campaign& campaign) {
  return {Hex(DigestOf(campaign.text)),
          absl::StrCat(std::string(Version()), " (", std::string(Commit()), ")"), InstructionSet()};
}

std::string SealUnit(UnitId unit, const UnitOrigin& origin, std::string_view content) {
  ByteWriter writer;
  writer(kFormatVersion, origin.campaign, origin.program, origin.instruction_set, KindName(unit.kind),
         unit.index, content);
  std::string bytes = std::string(kMagic) + std::move(writer).Take();
  const Sha256Digest digest = DigestOf(bytes);
  bytes.append(digest.begin(), digest.end());
  return bytes;
}

absl::StatusOr<std::string_view> OpenUnit(UnitId unit, const UnitOrigin& origin, std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) {
    return absl::DataLossError("is not a unit of albtpu-generate: delete it, and --resume computes it");
  }
  const absl::Status damaged = absl::DataLossError(
      "is damaged or truncated, its bytes do not have the SHA-256 at its end: delete it, and --resume "
      "computes "
      "it again");
  if (bytes.size() < kMagic.size() + kDigestSize) return damaged;
  const std::string_view seal = bytes.substr(bytes.size() - kDigestSize);
  bytes.remove_suffix(kDigestSize);
  const Sha256Digest digest = DigestOf(bytes);
  if (std::memcmp(seal.data(), digest.data(), kDigestSize) != 0) return damaged;

  ByteReader reader(bytes.substr(kMagic.size()));
  std::uint64_t version = 0, index = 0;
  std::string_view campaign, program, instruction_set, kind, content;
  reader(version);
  if (version != kFormatVersion) {
    return Other(absl::StrCat("is a unit of format ", version, ", this program reads format ", kFormatVersion,
                              ": finish with the program that began"));
  }
  reader(campaign, program, instruction_set, kind, index, content);
  if (!reader.ReadAll()) return damaged;
  if (campaign != origin.campaign) {
    return Other(absl::StrCat("is of another campaign, of SHA-256 ", std::string(campaign.substr(0, 12)),
                              "..., this one is ", origin.campaign.substr(0, 12),
                              "...: give each campaign a work folder of its own"));
  }
  if (program != origin.program) {
    return Other(absl::StrCat("was computed by albtpu-generate ", std::string(program), ", this is ",
                              origin.program, ": finish with that program, or begin in another work folder"));
  }
  if (instruction_set != origin.instruction_set) {
    return Other(absl::StrCat("was computed on a machine of instruction set ", std::string(instruction_set),
                              ", this one has ", origin.instruction_set,
                              ": go on with machines of one kind, or begin in another work folder"));
  }
  if (kind != KindName(unit.kind) || index != unit.index) {
    return Other(absl::StrCat("holds the unit ", std::string(kind), " ", index,
                              ": a unit's file keeps the name that it was given"));
  }
  return content;
}

}  // namespace albtpu
