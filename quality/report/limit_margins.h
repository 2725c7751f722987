// By which factor the standard deviations of points may be multiplied until they are at a limit.
#pragma once

#include <cstdint>
#include <vector>

namespace albtpu::quality {

// Of many points, in one pass: how many would still be within a limit if a factor were applied to all of them, for any
// factor that is known later. Factors are right to 0.2 %, on the side of fewer points.
class LimitMargins {
 public:
  void Add(double margin);                    // 0 or more; ClassJudge::Margin.
  std::uint64_t Within(double factor) const;  // Points whose margin is at least `factor`.

 private:
  std::vector<std::uint64_t> bins_;  // Empty until the first point.
};

}  // namespace albtpu::quality
