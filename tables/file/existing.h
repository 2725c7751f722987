// What to do about a file that exists under the name of an output.
#pragma once

namespace albtpu {

enum class Existing {
  kKeep,     // Refuse to write, with AlreadyExists.
  kReplace,  // Replace it when the new file is whole.
};

}  // namespace albtpu
