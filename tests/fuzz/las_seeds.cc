#include "tests/fuzz/seeds.h"
#include "tests/survey/las/las_builder.h"

namespace albtpu::fuzz {

using testing::ExtraBytesEntry;
using testing::LasSpec;

std::vector<std::string> LasSeeds() {
  std::vector<std::string> seeds;
  for (const auto& [version, format] : {std::pair(2, 0), {2, 3}, {3, 4}, {4, 1}, {4, 6}, {4, 10}}) {
    for (const std::size_t extra : {0, 6}) {
      LasSpec spec;
      spec.version_minor = version;
      spec.point_format = format;
      spec.extra_bytes = extra;
      spec.points = {{1, 2, -5000, 26, 12}, {3, 4, 100, 2, -3}, {5, 6, -800, 30, 0}};
      if (extra > 0) {
        const std::string geo_keys("\1\0\1\0\0\0\1\0\x04\x0c\0\0\1\0\x29\x23", 16);  // 3076: metre
        spec.vlrs = {{"LASF_Projection", 34735, geo_keys},
                     {"LASF_Spec", 4, ExtraBytesEntry(4, 0, "echo width")},
                     {"someone", 3, "last"}};
        spec.header_tail = "more";
        spec.gap = "between";
        if (version >= 3) spec.waveform_packet = "samples";
        if (version >= 4) spec.evlrs = {{"someone", 7, "behind"}, {"LASF_Projection", 2112, "UNIT[\"m\",1]"}};
      }
      seeds.push_back(BuildLas(spec));
    }
  }
  LasSpec feet;
  feet.points = {{1, 2, -5000, 26, 12}};
  feet.vlrs = {{"LASF_Projection", 2112, "PROJCS[\"x\",UNIT[\"US survey foot\",0.304800609601219]]"}};
  seeds.push_back(BuildLas(feet));
  return seeds;
}

}  // namespace albtpu::fuzz
