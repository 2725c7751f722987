// Writes a LAS file of busy or calm points: see busy_points.h.
//
// Usage: albtpu_busy_file OUT.las FORMAT EXTRA_BYTES POINTS busy|calm
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include "tests/laz/laz_bytes.h"

int main(int argc, char** argv) {
  using namespace albtpu::testing;
  const std::string_view mode = argc == 6 ? argv[5] : "";
  if (mode != "busy" && mode != "calm") {
    std::fputs("usage: albtpu_busy_file OUT.las FORMAT EXTRA_BYTES POINTS busy|calm\n", stderr);
    return 2;
  }
  const RecordLayout layout{std::atoi(argv[2]), static_cast<std::size_t>(std::atoi(argv[3]))};
  const auto count = static_cast<std::size_t>(std::atoll(argv[4]));
  const std::string file =
      AsLas(FileOf(layout, mode == "busy" ? BusyRecords(layout, count) : CalmRecords(layout, count)));
  std::ofstream out(argv[1], std::ios::binary);
  out.write(file.data(), static_cast<std::streamsize>(file.size()));
  return out.flush() ? 0 : 1;
}
