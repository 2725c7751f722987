#include "survey/trajectories/formats/open_trajectory.h"

#include <cstddef>

#include "survey/trajectories/formats/ascii_trajectory.h"
#include "survey/trajectories/formats/mapped_file.h"
#include "survey/trajectories/formats/sbet_file.h"

namespace albtpu::client {
namespace {

constexpr std::size_t kBeginning = 4096;  // Bytes. An SBET has bytes there that no text has, such as zeros.

}  // namespace

absl::StatusOr<std::unique_ptr<Trajectory>> OpenTrajectory(const std::filesystem::path& path) {
  bool is_text = false;
  {
    const absl::StatusOr<MappedFile> file = MappedFile::Open(path, "a trajectory");
    if (!file.ok()) return file.status();
    is_text = AsciiTrajectory::Recognizes(file->bytes().substr(0, kBeginning));
  }
  if (is_text) return AsciiTrajectory::Open(path);
  return SbetFile::Open(path);
}

}  // namespace albtpu::client
