// Arbitrary text as a file of a sea, for the reader ALBTPU_READER, is rejected with a message, or is a sea.
#include <string_view>

#include "sea/files/ndbc_bulk.h"
#include "sea/files/sea_csv.h"
#include "sea/files/sea_file.h"
#include "sea/files/swan_spectra.h"
#include "sea/files/ww3_points.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  fuzz::MustBeASea(ALBTPU_READER(text), fuzz::IsDescribed(text));
  return 0;
}
