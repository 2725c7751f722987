// albtpu_sea_states FILE
//
// Prints for each record of a file of the sea its time in s since 1970 and, in hexadecimal digits, the SeaState that
// the C++ client sends of it.
#include <cstdio>

#include "sea/files/sea_file.h"
#include "service/client/wire.h"
#include "service/seas/known_sea.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "albtpu_sea_states: no file; give one\n"), 2;
  const absl::StatusOr<albtpu::SeaSeries> series = albtpu::ReadSeaFile(argv[1]);
  if (!series.ok()) return std::fprintf(stderr, "%s\n", series.status().ToString().c_str()), 1;
  for (const albtpu::SeaRecord& record : series->records) {
    const albtpu::KnownSea sea = albtpu::KnownSeaOf(record, {}, series->record_length);
    std::printf("%.0f ", record.time.value_or(0));
    for (const char byte : albtpu::client::ToWire(sea).SerializeAsString())
      std::printf("%02x", static_cast<unsigned char>(byte));
    std::printf("\n");
  }
}
