// Arbitrary texts as NDBC's files of energy, r2 and alpha2, divided by zero bytes, are rejected with a message, or are
// a sea.
#include <string>
#include <string_view>
#include <vector>

#include "sea/files/ndbc_spectra.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/sea/sea_promises.h"

using namespace albtpu;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  std::vector<std::string> texts;  // Copies: sanitizers see reads beyond each.
  std::size_t begin = 0;
  for (std::size_t end = 0; end != input.npos; begin = end + 1) {
    end = texts.size() < 2 ? input.find('\0', begin) : input.npos;
    texts.emplace_back(input.substr(begin, end - begin));
  }
  NdbcTexts files{.energy = texts[0]};
  if (texts.size() > 1) files.spread = texts[1];
  if (texts.size() > 2) files.direction = texts[2];
  fuzz::MustBeASea(ReadNdbcSpectra(files), fuzz::IsDescribed(input));
  return 0;
}
