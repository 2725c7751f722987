// The place of an item after the first in the records of formats 6 to 10, and the prediction of its points.
#pragma once

#include <cstddef>

#include "formats/laz/items/point_contexts.h"

namespace albtpu::laz {

struct ItemPlace {
  std::size_t offset = 0;
  bool version3 = true;  // Else 4.

  const ChannelRuns& Runs(const PointContexts& contexts) const {
    return version3 ? contexts.version3_runs : contexts.runs;
  }
};

}  // namespace albtpu::laz
