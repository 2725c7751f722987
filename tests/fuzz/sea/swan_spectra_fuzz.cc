// Arbitrary text as spectra of SWAN is rejected with a message, or is a sea.
#include <string_view>

#include "sea/files/swan_spectra.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::MustBeASea(ReadSwanSpectra(text), fuzz::IsDescribed(text));
  return 0;
}
