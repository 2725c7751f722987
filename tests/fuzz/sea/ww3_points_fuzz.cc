// Arbitrary text as point output of WAVEWATCH III is rejected with a message, or is a sea.
#include <string_view>

#include "sea/files/ww3_points.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::MustBeASea(ReadWw3Points(text), fuzz::IsDescribed(text));
  return 0;
}
