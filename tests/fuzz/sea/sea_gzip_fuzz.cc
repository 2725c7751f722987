// Arbitrary bytes as gzip's are rejected with a message, or inflate to no more than the limit.
#include <string_view>

#include "sea/files/sea_csv.h"
#include "tests/fuzz/fuzz_target.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMost = 100'000;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto text = Inflated(bytes, kMost);
  ALBTPU_MUST(text.ok() ? text->size() <= kMost : text.status().message().size() > 10);
  ALBTPU_MUST(!text.ok() || IsGzip(bytes));
  return 0;
}
