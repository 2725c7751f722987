#include "tests/fuzz/seeds.h"

namespace albtpu::fuzz {

std::vector<std::string> CampaignSeeds() {
  const std::string axes = R"([axes]
wind_speed = [3, 6]
fetch = [1000, inf]
incidence = [0, 20]
azimuth = [0, 90]
footprint = [0.1, 1]
depth = [0, 10]
)";
  return {"id = \"small\"\nversion = \"1\"\ntitle = \"Two seas\"\nseed = 7\n" + axes +
              "[effort]\nrealizations = 50\n",
          "id = \"a\"\nversion = \"1\"\ntitle = \"b\"\n" + axes + R"([beam]
profile = "gaussian"
source_height = 4.0
[water]
refractive_index = 1.34
[sea]
spectrum = "elfouhaily"
corrected_above = 30
[effort]
realizations = 100
most_realizations = 1000
relative_error = 0.02
estimator = "plain"
rays = 1000
[interpolation]
nodes = "balanced"
checked_pulses = 4
)",
          "id = \"s\"\nversion = \"1\"\ntitle = \"t\"\n" + axes + "[sea]\nspreading = 2\n",
          "axes.wind_speed = [1, 2, nan]\naxes.fetch = [-inf, 1e400]\nid = 'x'\n"};
}

std::vector<std::string> CsvSeeds() {
  const std::string header = "wind_speed,fetch,incidence,azimuth,footprint,depth";
  return {header + "\n5,inf,12,40,0.5,8\n6,1e4,0,,0.25,0\n",
          "fetch,incidence,footprint,depth,name\r\n1000,12.5, 0.5 ,8,\"a \"\"b\"\", c\"\r\n\r\n,1,1,1,x\r\n",
          "\xEF\xBB\xBF\"depth\",\"footprint\",incidence\n\"1\",nan,-1e99\n3,0x10,4",
          header + ",note\n1,2,3,4,5,6,\"over\ntwo lines\"\n1,2,3,4,5,6,\n",
          "a;b;c\n1;2;3\n",
          "incidence,footprint,depth,thu\n1,2,3,4\n",
          "incidence,footprint,depth\n1,\"2\"x,3\n\"open"};
}

}  // namespace albtpu::fuzz
