// The seal of a table file: a user block of 512 bytes before the HDF5 part. It shows whether the file is a table and
// whether all of its bytes are unchanged. FORMAT.md, "User block", specifies it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace albtpu::seal {

// All integers are little-endian.
//   offset  bytes
//        0      8  magic
//        8      4  format version
//       12      4  zero
//       16      8  length of the whole file in bytes
//       24     32  SHA-256 over all bytes of the file but these 32
//       56    456  zero
inline constexpr std::size_t kSize = 512;  // The smallest user block that HDF5 allows.
inline constexpr std::string_view kMagic =
    "\x89"
    "ALBTPU\n";  // Not text, and altered by transfers in text mode.
inline constexpr std::uint32_t kFormatVersion = 1;
inline constexpr std::size_t kVersionOffset = 8;
inline constexpr std::size_t kLengthOffset = 16;
inline constexpr std::size_t kDigestOffset = 24;
inline constexpr std::size_t kDigestSize = 32;

// Fills the first kSize bytes of `file`, which is otherwise complete. Requires file.size() >= kSize.
void Apply(std::string& file);

// Whether the first bytes of a file (as many as there are, up to kSize) and its length are those of a table, so
// that the rest is worth reading. DataLoss if the file is empty, truncated or not a table, InvalidArgument if it
// has another version.
absl::Status CheckHeader(absl::string_view head, std::uint64_t file_length);

// CheckHeader, then DataLoss if any byte of the file has changed since Apply.
absl::Status Check(absl::string_view file);

}  // namespace albtpu::seal
