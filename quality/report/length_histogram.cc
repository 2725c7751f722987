#include "quality/report/length_histogram.h"

#include <nlohmann/json.hpp>

namespace albtpu::quality {

nlohmann::ordered_json LengthHistogram::ToJson() const {
  std::size_t used = kSteps;
  while (used > 1 && counts[used - 1] == 0) --used;
  return {{"step", step}, {"counts", std::vector<std::uint64_t>(counts.begin(), counts.begin() + used)}};
}

}  // namespace albtpu::quality
