// What to do if a file already has the name of an output.
#pragma once

namespace albtpu {

enum class Existing {
  kKeep,     // Fail with AlreadyExists.
  kReplace,  // Replace it once the new file is complete.
};

}  // namespace albtpu
