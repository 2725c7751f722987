#include "generator/campaign/unit.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "generator/campaign/water_cases.h"
#include "generator/math/random_stream.h"
#include "tables/digest.h"
#include "tables/version.h"

namespace albtpu {
// Each struct is unpacked by name, so that one with a new field does not compile until the field is added here.

template <typename Stream, SameStruct<Estimate> Self>
void Fields(Stream& stream, Self& self) {
  auto& [value, standard_error] = self;
  stream(value, standard_error);
}

template <typename Stream, SameStruct<BeamUncertainty> Self>
void Fields(Stream& stream, Self& self) {
  auto& [refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical, realizations] = self;
  stream(refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical, realizations);
}

template <typename Stream, SameStruct<SeaCaseResult> Self>
void Fields(Stream& stream, Self& self) {
  auto& [beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction] = self;
  stream(beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction);
}

namespace {

// Not text, so that a transfer in text mode is detected by its changes.
constexpr std::string_view kMagic =
    "\x89"
    "ALBUNT\n";
constexpr std::uint64_t kFormatVersion = 1;
constexpr std::size_t kDigestSize = std::tuple_size_v<Sha256Digest>;

std::string KindName(UnitKind kind) {
  switch (kind) {
    case UnitKind::kSeaCase:
      return "encounter";  // The name in files, kept from an earlier name in the code.
    case UnitKind::kWaterCase:
      return "water";
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

template <typename Content>
std::string Encode(const Content& content) {
  ByteWriter writer;
  writer(content);
  return std::move(writer).Take();
}

template <typename Content>
absl::StatusOr<Content> Decode(std::string_view bytes) {
  ByteReader reader(bytes);
  Content content;
  reader(content);
  if (!reader.ReadAll()) {
    return absl::DataLossError(
        "holds other fields than this program computes (made by another build of the same commit); "
        "start in another work folder");
  }
  return content;
}

}  // namespace

std::string Name(UnitId unit) { return absl::StrFormat("%s-%05d", KindName(unit.kind), unit.index); }

std::vector<UnitId> UnitsOf(const Campaign& campaign) {
  std::vector<UnitId> units;
  const std::size_t cases = campaign.water ? WaterCaseCount(campaign) : SeaCaseCount(campaign);
  const UnitKind kind = campaign.water ? UnitKind::kWaterCase : UnitKind::kSeaCase;
  for (std::size_t i = 0; i < cases; ++i) units.push_back({kind, i});
  for (std::size_t i = 0; i < campaign.checked_pulses; ++i) units.push_back({UnitKind::kPulse, i});
  return units;
}

UnitOrigin OriginOf(const Campaign& campaign) {
  return {Hex(DigestOf(campaign.text)), absl::StrCat(std::string(Version()), " (", std::string(Commit()), ")"),
          InstructionSet()};
}

std::string EncodeResult(const SeaCaseResult& result) { return Encode(result); }

absl::StatusOr<SeaCaseResult> DecodeResult(std::string_view bytes) { return Decode<SeaCaseResult>(bytes); }

std::string EncodeEstimates(const std::vector<Estimate>& estimates) { return Encode(estimates); }

absl::StatusOr<std::vector<Estimate>> DecodeEstimates(std::string_view bytes) {
  return Decode<std::vector<Estimate>>(bytes);
}

std::string SealUnit(UnitId unit, const UnitOrigin& origin, std::string_view content) {
  ByteWriter writer;
  writer(kFormatVersion, origin.campaign, origin.program, origin.instruction_set, KindName(unit.kind), unit.index,
         content);
  std::string bytes = std::string(kMagic) + std::move(writer).Take();
  const Sha256Digest digest = DigestOf(bytes);
  bytes.append(digest.begin(), digest.end());
  return bytes;
}

absl::StatusOr<std::string_view> OpenUnit(UnitId unit, const UnitOrigin& origin, std::string_view bytes) {
  if (!bytes.starts_with(kMagic))
    return absl::DataLossError("is not a unit of albtpu-generate; delete it, and --resume computes it");
  const absl::Status damaged = absl::DataLossError(
      "is damaged or truncated (its bytes do not match the SHA-256 at its end); "
      "delete it, and --resume computes it again");
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
    return absl::FailedPreconditionError(absl::StrCat("is a unit of format ", version, " (this program reads format ",
                                                      kFormatVersion, "); finish with the program that began"));
  }
  reader(campaign, program, instruction_set, kind, index, content);
  if (!reader.ReadAll()) return damaged;
  if (campaign != origin.campaign) {
    return absl::FailedPreconditionError(
        absl::StrCat("is of another campaign (SHA-256 ", std::string(campaign.substr(0, 12)), "..., this one has ",
                     origin.campaign.substr(0, 12), "...); give each campaign its own work folder"));
  }
  if (program != origin.program) {
    return absl::FailedPreconditionError(absl::StrCat("was computed by albtpu-generate ", std::string(program),
                                                      ", this is ", origin.program,
                                                      "; finish with that program, or start in another work folder"));
  }
  if (instruction_set != origin.instruction_set) {
    return absl::FailedPreconditionError(
        absl::StrCat("was computed on a machine of instruction set ", std::string(instruction_set), ", this one has ",
                     origin.instruction_set, "; continue on machines of one kind, or start in another work folder"));
  }
  if (kind != KindName(unit.kind) || index != unit.index) {
    return absl::FailedPreconditionError(
        absl::StrCat("holds the unit ", std::string(kind), " ", index,
                     " (the file was renamed or copied); a unit needs the name that it was written with"));
  }
  return content;
}

}  // namespace albtpu
