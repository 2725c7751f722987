// Changes what a table file holds, by HDF5 or byte by byte, and seals it again, so that the decoder behind
// the seal is reached; where only the content digest would refuse the file, that is made right too. Some stay
// unsealed.
#include <cstring>
#include <random>
#include <string>

#include "tables/file/seal.h"
#include "tables/file/table_encoding.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/table_editor.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using namespace albtpu;

std::string MutateBytes(std::string file, std::size_t max_size) {
  const std::size_t size = file.size();
  file.resize(max_size);
  auto* content = reinterpret_cast<std::uint8_t*>(file.data()) + seal::kSize;
  file.resize(seal::kSize + LLVMFuzzerMutate(content, size - seal::kSize, max_size - seal::kSize));
  return file;
}

// The digest that the content has, out of the message that refuses another.
std::string DigestOf(const std::string& file) {
  const std::string message(DecodeTable(file).status().message());
  const std::string words = "the content has '";
  const std::size_t at = message.find(words);
  return at == std::string::npos ? "" : message.substr(at + words.size(), 64);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::mt19937 random(seed);
  if (size <= seal::kSize || random() % 32 == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string file(reinterpret_cast<const char*>(data), size);
  if (random() % 4 == 0) {
    file = MutateBytes(std::move(file), max_size);
    seal::Apply(file);
  } else {
    file = fuzz::EditTable(file, random);
    const std::string digest = DigestOf(file);
    if (!digest.empty()) file = fuzz::WithDigest(file, digest);
  }
  if (file.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, file.data(), file.size());
  return file.size();
}
