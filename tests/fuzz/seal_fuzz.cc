// Arbitrary bytes as a table file, checked up to its seal, are rejected with a reason, or have a seal as in
// FORMAT.md. A sealed file with one bit changed is rejected.
#include <cstring>
#include <string>
#include <vector>

#include "tables/file/seal.h"
#include "tests/fuzz/fuzz_target.h"

namespace albtpu::fuzz {
namespace {

template <typename Integer>
Integer NumberAt(const std::string& file, std::size_t offset) {
  Integer number;
  std::memcpy(&number, file.data() + offset, sizeof number);  // The file is little-endian, like this machine.
  return number;
}

bool IsSealed(const std::string& file) {
  const absl::Status status = seal::Check(file);
  if (status.ok()) return true;
  ALBTPU_MUST(absl::IsDataLoss(status) || absl::IsInvalidArgument(status));
  ALBTPU_MUST(!status.message().empty());
  return false;
}

void SealTarget(std::string_view input) {
  std::string file(input);
  if (IsSealed(file)) {
    ALBTPU_MUST(input.size() >= seal::kSize && file.substr(0, seal::kMagic.size()) == seal::kMagic);
    ALBTPU_MUST(NumberAt<std::uint32_t>(file, seal::kVersionOffset) == seal::kFormatVersion);
    ALBTPU_MUST(NumberAt<std::uint64_t>(file, seal::kLengthOffset) == input.size());
  }
  if (input.size() < seal::kSize) return;
  // The input itself chooses the bit, so that it can be any of them and the same in every run.
  const std::size_t bit =
      (NumberAt<std::uint64_t>(file, seal::kDigestOffset) ^ static_cast<std::uint8_t>(input.back())) %
      (8 * input.size());
  seal::Apply(file);
  ALBTPU_MUST(IsSealed(file));
  file[bit / 8] = static_cast<char>(file[bit / 8] ^ (1 << bit % 8));
  ALBTPU_MUST(!IsSealed(file));
}

}  // namespace

const std::vector<Target> kTargets = {{"seal", SealTarget}};

}  // namespace albtpu::fuzz
