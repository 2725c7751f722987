#include "tests/formats/laz/busy_file.h"

#include "tests/formats/las/las_builder.h"

namespace albtpu::testing {

LasParts FileOf(const RecordLayout& layout, const std::string& records) {
  LasSpec spec;
  spec.point_format = layout.point_format;
  spec.version_minor = layout.point_format < 4 ? 2 : layout.point_format < 6 ? 3 : 4;
  spec.extra_bytes = layout.extra_bytes;
  spec.points.resize(records.size() / RecordLength(layout));
  spec.vlrs = {{"a test", 7, "something"}, {"laszip encoded", 7, "of the same user"}};
  spec.gap = "gap";
  if (spec.version_minor >= 3) spec.waveform_packet = "waveforms";
  if (spec.version_minor >= 4) spec.evlrs = {{"a test", 8, "something else"}};
  LasParts parts = *TakeApart(BuildLas(spec));
  parts.points = records;
  return parts;
}

}  // namespace albtpu::testing
