// Arbitrary texts as NDBC's files of energy, r2 and alpha2, divided by zero bytes, are rejected with a message, or are
// a sea.
#include <string>
#include <vector>

#include "sea/files/ndbc_spectra.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> texts(1);
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] == 0 && texts.size() < 3) {
      texts.emplace_back();
    } else {
      texts.back() += static_cast<char>(data[i]);
    }
  }
  NdbcTexts files{.energy = texts[0]};
  if (texts.size() > 1) files.spread = texts[1];
  if (texts.size() > 2) files.direction = texts[2];
  fuzz::MustBeASea(ReadNdbcSpectra(files), fuzz::IsDescribed(size));
  return 0;
}
