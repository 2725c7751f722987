#include "tables/file/seal.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "absl/strings/match.h"
#include "absl/strings/str_format.h"
#include "status/status_macros.h"
#include "tables/digest.h"

namespace albtpu::seal {
namespace {

constexpr absl::string_view kHdf5Magic = "\x89HDF\r\n\x1a\n";

absl::string_view Magic() { return {kMagic.data(), kMagic.size()}; }

template <typename Integer>
void PutLittleEndian(std::string& file, std::size_t offset, Integer value) {
  for (std::size_t i = 0; i < sizeof value; ++i)
    file[offset + i] = static_cast<char>(static_cast<std::uint8_t>(value >> (8 * i)));
}

template <typename Integer>
Integer GetLittleEndian(absl::string_view file, std::size_t offset) {
  Integer value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i)
    value |= static_cast<Integer>(static_cast<std::uint8_t>(file[offset + i])) << (8 * i);
  return value;
}

Sha256Digest DigestOf(absl::string_view file) {
  Sha256 sha;
  sha.Update(file.data(), kDigestOffset);
  const absl::string_view rest = file.substr(kDigestOffset + kDigestSize);
  sha.Update(rest.data(), rest.size());
  return sha.Finish();
}

}  // namespace

void Apply(std::string& file) {
  assert(file.size() >= kSize);
  std::fill_n(file.begin(), kSize, '\0');
  std::copy(kMagic.begin(), kMagic.end(), file.begin());
  PutLittleEndian(file, kVersionOffset, kFormatVersion);
  PutLittleEndian(file, kLengthOffset, std::uint64_t{file.size()});
  const Sha256Digest digest = DigestOf(file);
  std::memcpy(file.data() + kDigestOffset, digest.data(), digest.size());
}

absl::Status CheckHeader(absl::string_view head, std::uint64_t file_length) {
  if (file_length == 0) return absl::DataLossError("is empty: not a table");
  if (!absl::StartsWith(head, Magic().substr(0, head.size()))) {
    if (absl::StartsWith(head, kHdf5Magic)) {
      return absl::DataLossError(
          "is an HDF5 file without the seal of albtpu: it is not a table, or it has lost its first 512 "
          "bytes");
    }
    return absl::DataLossError("is not a table of albtpu: it does not begin with its seal");
  }
  if (head.size() < kSize) {
    return absl::DataLossError(
        absl::StrFormat("is truncated: it has %d bytes, and a table has more than %d", file_length, kSize));
  }
  const auto version = GetLittleEndian<std::uint32_t>(head, kVersionOffset);
  if (version != kFormatVersion) {
    return absl::InvalidArgumentError(
        absl::StrFormat("has format version %d: this program reads version %d", version, kFormatVersion));
  }
  const auto length = GetLittleEndian<std::uint64_t>(head, kLengthOffset);
  if (file_length < length)
    return absl::DataLossError(absl::StrFormat("is truncated: it has %d of its %d bytes", file_length, length));
  if (file_length > length) {
    return absl::DataLossError(
        absl::StrFormat("is damaged: it has %d bytes, and its seal says %d", file_length, length));
  }
  return absl::OkStatus();
}

absl::Status Check(absl::string_view file) {
  RETURN_IF_ERROR(CheckHeader(file.substr(0, kSize), file.size()));
  const Sha256Digest digest = DigestOf(file);
  if (std::memcmp(file.data() + kDigestOffset, digest.data(), kDigestSize) != 0)
    return absl::DataLossError("is damaged: its bytes do not have the SHA-256 of its seal");
  return absl::OkStatus();
}

}  // namespace albtpu::seal
