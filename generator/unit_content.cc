#include "generator/unit_content.h"

#include "generator/byte_stream.h"

namespace albtpu {

// Each struct is taken apart by name, so that one with a new field does not compile until it is named here.

template <typename Stream, SameStruct<Estimate> Self>
void Fields(Stream& stream, Self& self) {
  auto& [value, standard_error] = self;
  stream(value, standard_error);
}

template <typename Stream, SameStruct<BeamUncertainty> Self>
void Fields(Stream& stream, Self& self) {
  auto& [refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical] = self;
  stream(refraction_along_wind, refraction_cross_wind, thu, tvu, bias_along_beam, bias_vertical);
}

template <typename Stream, SameStruct<EncounterResult> Self>
void Fields(Stream& stream, Self& self) {
  auto& [beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction] = self;
  stream(beams, realizations, converged, rays, patch_length, spacing, footprint_slope_fraction,
         resolved_slope_fraction);
}

std::string EncodeResult(const EncounterResult& result) {
  ByteWriter writer;
  writer(result);
  return std::move(writer).Take();
}

absl::StatusOr<EncounterResult> DecodeResult(std::string_view bytes) {
  ByteReader reader(bytes);
  EncounterResult result;
  reader(result);
  if (!reader.ReadAll()) {
    return absl::DataLossError(
        "holds other fields than this program computes, as from another build of its commit: begin in "
        "another "
        "work folder");
  }
  return result;
}

}  // namespace albtpu
