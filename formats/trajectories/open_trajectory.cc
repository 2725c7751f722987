#include "formats/trajectories/open_trajectory.h"

#include <cstddef>

#include "formats/files/mapped_file.h"
#include "formats/trajectories/ascii_trajectory.h"
#include "formats/trajectories/sbet_file.h"

namespace albtpu::formats {
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

}  // namespace albtpu::formats
