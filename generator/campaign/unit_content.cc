#include "generator/campaign/unit_content.h"

#include "generator/campaign/byte_stream.h"

namespace albtpu {

// Each struct is taken apart by name, so that one with a new field does not compile until it is named here.

template <typename Stream, SameStruct<Estimate> Self>
void Fields(Stream& stream, Self& self) {
  auto& [value, standard_error] = self;
  stream(value, standard_error);
}

template <typename Stream, SameStruct<BeamUncertainty> Self>
void Fields(Stream& stream, Self& self) {
  auto& [refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical,
         realizations] = self;
  stream(refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical,
         realizations);
}

template <typename Stream, SameStruct<SeaCaseResult> Self>
void Fields(Stream& stream, Self& self) {
  auto& [beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction] = self;
  stream(beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction);
}

namespace {

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
        "holds other fields than this program computes, as from another build of its commit: begin in "
        "another work "
        "folder");
  }
  return content;
}

}  // namespace

std::string EncodeResult(const SeaCaseResult& result) { return Encode(result); }

absl::StatusOr<SeaCaseResult> DecodeResult(std::string_view bytes) { return Decode<SeaCaseResult>(bytes); }

std::string EncodeAnswers(const std::vector<Estimate>& answers) { return Encode(answers); }

absl::StatusOr<std::vector<Estimate>> DecodeAnswers(std::string_view bytes) {
  return Decode<std::vector<Estimate>>(bytes);
}

}  // namespace albtpu
