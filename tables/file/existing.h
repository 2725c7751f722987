// The treatment of an existing file with the name of an output.
#pragma once

namespace albtpu {

enum class Existing {
  kKeep,     // Fail with AlreadyExists.
  kReplace,  // Replace it once the new file is complete.
};

}  // namespace albtpu
