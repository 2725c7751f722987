#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "quality/surface/surface_part.h"

namespace albtpu::quality {
namespace {

// Files of one datum: one states it as a system, another one has the surveyor's name for it, a third nothing.
TEST(SurfaceMap, HasTheVerticalSystemOfWhicheverFileStatesIt) {
  const std::vector<std::pair<std::string, std::string>> files = {{"", ""}, {"NAVD88", ""}, {"NAVD88", "VERT_CS[...]"}};
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
    SurfaceMap map;
    for (const std::size_t i : order) map.TakeVertical(files[i].first, files[i].second);
    EXPECT_EQ(map.vertical_name, "NAVD88");
    EXPECT_EQ(map.vertical_wkt, "VERT_CS[...]");
  }
}

TEST(SurfaceMap, HasTheFirstNameWhereNoFileStatesASystem) {
  SurfaceMap map;
  map.TakeVertical("", "");
  map.TakeVertical("NAVD88", "");
  map.TakeVertical("chart datum", "");
  EXPECT_EQ(map.vertical_name, "NAVD88");
}

}  // namespace
}  // namespace albtpu::quality
