// Arbitrary text as an ASCII trajectory is rejected with a message that names the file; or its records keep what a
// trajectory promises, there is one for each line of numbers, and reading it again gives the same.
#include <cmath>
#include <string>

#include "formats/trajectories/ascii_trajectory.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trajectory_promises.h"

using namespace albtpu;
using namespace albtpu::formats;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data),
                         size);  // A copy: sanitizers detect reads beyond it.
  const auto trajectory = AsciiTrajectory::Parse("file", text);
  if (!trajectory.ok()) {
    fuzz::MustExplain(trajectory.status(), "file");
    return 0;
  }
  ALBTPU_MUST(AsciiTrajectory::Recognizes(text));
  const std::size_t columns = (*trajectory)->columns();
  ALBTPU_MUST(columns == 15 || columns == 20);
  ALBTPU_MUST((*trajectory)->size() <= size / (2 * columns) + 1);  // A digit and a separator for each number.
  fuzz::MustKeepPromises(**trajectory);
  for (std::size_t i = 0; i < (*trajectory)->size(); ++i) {
    const TrajectoryRecord record = (*trajectory)->Record(i);
    ALBTPU_MUST(std::isfinite(record.velocity_north) == (columns == 20));
    const auto grid = (*trajectory)->GridPositionAt(i);
    ALBTPU_MUST(!grid.has_value() || (std::isfinite(grid->x) && std::isfinite(grid->y)));
  }
  return 0;
}
