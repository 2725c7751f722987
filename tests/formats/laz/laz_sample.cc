#include "tests/formats/laz/laz_sample.h"

#include <zlib.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace albtpu::testing {

std::string SampleBytes(const std::string& name) {
  const std::string path = std::string(ALBTPU_LAZ_SAMPLES) + "/" + name;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  std::string bytes;
  if (!file) return bytes;
  std::vector<char> piece(1 << 20);
  for (int size = 0; (size = gzread(file.get(), piece.data(), 1 << 20)) > 0;)
    bytes.append(piece.data(), static_cast<std::size_t>(size));
  return bytes;
}

}  // namespace albtpu::testing
