// Arbitrary bytes as an SBET are rejected with the name of the file and a reason; or its records have finite positions
// on the globe at increasing times, and velocities that agree with them.
#include <optional>
#include <vector>

#include "formats/files/file_access.h"
#include "formats/trajectories/ascii_motion.h"
#include "formats/trajectories/sbet_file.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/trajectory_promises.h"

using namespace albtpu;
using namespace albtpu::formats;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<char> bytes(data, data + size);  // A copy, aligned, beyond which sanitizers detect reads.
  const auto trajectory = SbetFile::Parse("file", MappedFile::View({bytes.data(), bytes.size()}));
  if (!trajectory.ok()) {
    fuzz::MustExplain(trajectory.status(), "file");
    return 0;
  }
  ALBTPU_MUST((*trajectory)->size() * sizeof(SbetRecord) == size);
  fuzz::MustKeepPromises(**trajectory);
  const std::optional<double> difference = VelocityDifference(**trajectory);
  ALBTPU_MUST(!difference.has_value() || *difference <= kLargestVelocityDifference);
  return 0;
}
